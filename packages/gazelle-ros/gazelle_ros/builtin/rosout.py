"""``rosout``: copies what all nodes log to ``/rosout_agg``, for roslaunch's core.

It is run as ``python -m gazelle_ros.builtin.rosout``, which need not look for other nodes.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.clock import WallClock
from gazelle_ros.master.rosout import RosoutAggregator
from gazelle_ros.process_name import call_process


def main(arguments: Sequence[str]) -> int:
    """Copy until the node ends; returns the exit code."""
    call_process("rosout")
    # What it says itself would come back to it.
    node = parse_arguments(arguments, "rosout").start(rosout=False, clock=WallClock())
    RosoutAggregator(node)
    return spin(node)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
