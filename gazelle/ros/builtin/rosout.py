"""``rosout``: copies what all nodes log to ``/rosout_agg``, for roslaunch's core.

It is run as ``python -m gazelle.ros.builtin.rosout``, which need not look for other nodes.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence

from gazelle.ros.builtin.arguments import NodeArguments, parse_arguments, spin
from gazelle.ros.clock import WallClock
from gazelle.ros.errors import MasterUnreachableError, NoMasterError
from gazelle.ros.master.rosout import RosoutAggregator
from gazelle.ros.node import Node
from gazelle.ros.process_name import call_process

_WAIT_S = 30.0
"""The master is started at the same time, and may be a little later."""
_LOOK_S = 0.01


def main(arguments: Sequence[str]) -> int:
    """Copy until the node ends; returns the exit code."""
    call_process("rosout")
    node = _start(parse_arguments(arguments, "rosout"))
    RosoutAggregator(node)
    return spin(node)


def _start(found: NodeArguments) -> Node:
    deadline = time.monotonic() + _WAIT_S
    while True:
        try:
            return found.start(clock=WallClock())
        except NoMasterError:
            raise
        except MasterUnreachableError:
            if time.monotonic() > deadline:
                raise
            time.sleep(_LOOK_S)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
