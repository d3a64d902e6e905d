"""Timeouts for the end of nodes, under the path that roslaunch uses."""

from gazelle_ros.launch.process import StopTimeouts

DEFAULT_TIMEOUT_SIGINT = StopTimeouts().interrupt
"""Seconds after SIGINT."""
DEFAULT_TIMEOUT_SIGTERM = StopTimeouts().terminate
"""Seconds after SIGTERM."""
