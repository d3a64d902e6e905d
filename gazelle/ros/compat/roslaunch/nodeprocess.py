"""How long nodes may take to end, where roslaunch keeps it."""

from gazelle.ros.launch.process import Patience

DEFAULT_TIMEOUT_SIGINT = Patience().interrupt
"""Seconds after SIGINT."""
DEFAULT_TIMEOUT_SIGTERM = Patience().terminate
"""Seconds after SIGTERM."""
