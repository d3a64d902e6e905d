"""Bag files of ROS 1: read, write, record, play."""

from gazelle.ros.bags.bag import (
    Bag,
    BagMessage,
    BagMessageWithConnectionHeader,
    Compression,
)
from gazelle.ros.bags.errors import BagError, BagFormatError, BagUnindexedError

__all__ = [
    "Bag",
    "BagError",
    "BagFormatError",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "BagUnindexedError",
    "Compression",
]
