"""rosbag's interface; see `gazelle_ros.bags`."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle_ros.bags import (
    Bag,
    BagMessage,
    BagMessageWithConnectionHeader,
    Compression,
)
from gazelle_ros.bags import BagError as ROSBagException
from gazelle_ros.bags import BagFormatError as ROSBagFormatException
from gazelle_ros.bags import BagUnindexedError as ROSBagUnindexedException
from gazelle_ros.compat import commands

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
    """Run ``rosbag`` with a command line, by default this process's.

    Raises:
        SystemExit: It failed.
    """
    commands.run("bag", argv)
