"""The node ``gzclient`` of the package ``gazebo_ros``: there is no window, and nothing breaks."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle_ros.builtin.arguments import parse_arguments, spin


def main(arguments: Sequence[str]) -> int:
    """Log that there is no window, and run until shutdown: launch files may require the node."""
    sys.stderr.write("gzclient: there is no window; the simulation goes on without\n")
    return spin(parse_arguments(arguments, "gazebo_gui").start())
