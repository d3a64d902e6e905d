"""The entry point of the command ``gazelle``."""

from __future__ import annotations

import contextlib
import logging
import sys
from collections.abc import Iterator, Sequence

from gazelle import __version__
from gazelle.cli.commands import COMMANDS
from gazelle_ros.cli.main import CommandLine
from gazelle_ros.cli.main import main as run_program


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line.

    Args:
        argv: The arguments after ``gazelle``; by default those of this process.

    Returns:
        0 done, 1 the work failed, 2 the command line was wrong, 130 Ctrl-C, 143 SIGTERM.
    """
    return run_program(argv, GAZELLE)


@contextlib.contextmanager
def _prepared() -> Iterator[None]:
    """Set the threads of BLAS, and report long work on stderr: the log of mesh processing."""
    # Read by BLAS libraries when numpy is first imported, so set before the command is.
    from gazelle.training.threads import claim_environment

    claim_environment()
    log = logging.getLogger("gazelle.geometry.convex_decomposition")
    handler = logging.StreamHandler()
    handler.setFormatter(logging.Formatter("gazelle: %(message)s"))
    before = log.level
    log.addHandler(handler)
    log.setLevel(logging.INFO)
    try:
        yield
    finally:
        log.setLevel(before)
        log.removeHandler(handler)


GAZELLE = CommandLine(
    "gazelle",
    __version__,
    "Simulate robots from their Gazebo, URDF and ROS 1 files, and train policies.",
    COMMANDS,
    _prepared,
)

if __name__ == "__main__":
    sys.exit(main())
