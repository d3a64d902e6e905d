"""Bag files of ROS 1: read, write, record, play."""

from gazelle.ros.bags.answers import BagMessage, BagMessageWithConnectionHeader
from gazelle.ros.bags.bag import Bag, Compression
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
