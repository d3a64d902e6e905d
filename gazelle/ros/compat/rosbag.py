"""rosbag's interface; see `gazelle.ros.bags`."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.ros.bags import (
    Bag,
    BagMessage,
    BagMessageWithConnectionHeader,
    Compression,
)
from gazelle.ros.bags import BagError as ROSBagException
from gazelle.ros.bags import BagFormatError as ROSBagFormatException
from gazelle.ros.bags import BagUnindexedError as ROSBagUnindexedException

__all__ = [
    "Bag",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "Compression",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
    "rosbagmain",
]


def rosbagmain(argv: Sequence[str] | None = None) -> None:
    """Run the command ``rosbag`` with a command line, by default this process's, and end it."""
    import sys

    from gazelle.ros.builtin.commands import call_command

    sys.exit(call_command("bag", (sys.argv if argv is None else argv)[1:]))
