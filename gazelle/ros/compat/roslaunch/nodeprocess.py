"""How long nodes may take to end, where roslaunch keeps it."""

from gazelle.ros.launch.process import StopTimeouts

DEFAULT_TIMEOUT_SIGINT = StopTimeouts().interrupt
"""Seconds after SIGINT."""
DEFAULT_TIMEOUT_SIGTERM = StopTimeouts().terminate
"""Seconds after SIGTERM."""
