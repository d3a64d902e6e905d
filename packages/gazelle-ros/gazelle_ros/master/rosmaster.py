"""``python -m gazelle_ros.master.rosmaster``: the master of a launch, as a process of its own."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from gazelle_ros import net
from gazelle_ros.base.argument_types import port_number
from gazelle_ros.base.interrupts import interruptible, stopping
from gazelle_ros.errors import RosError
from gazelle_ros.master.server import run_master
from gazelle_ros.process_name import call_process


def main(arguments: Sequence[str]) -> int:
    """Run a master until SIGINT, SIGTERM or a call of ``shutdown``; returns the exit code."""
    parser = argparse.ArgumentParser(prog="rosmaster")
    parser.add_argument("--core", action="store_true", help="started by roslaunch")
    parser.add_argument("-p", "--port", type=port_number, default=net.DEFAULT_MASTER_PORT)
    parser.add_argument("--host", default=net.default_host(), help="name nodes reach it by")
    parser.add_argument("--run-id", default="", help="what /run_id is to be")
    parsed = parser.parse_args([word for word in arguments if ":=" not in word])
    call_process("rosmaster")
    try:
        with interruptible(ends_process=True), stopping() as end:
            run_master(parsed.host, parsed.port, rosout=False, run_id=parsed.run_id, end=end)
    except RosError as error:
        sys.stderr.write(f"[rosmaster] {error}\n")
        return 1
    except KeyboardInterrupt:
        return 0  # shut down during its start
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
