"""Bag files of ROS 1: read, write, record, play."""

from gazelle_ros.bags.answers import BagMessage, BagMessageWithConnectionHeader
from gazelle_ros.bags.bag import Bag, Compression
from gazelle_ros.bags.errors import BagError, BagFormatError, BagUnindexedError

__all__ = [
    "Bag",
    "BagError",
    "BagFormatError",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "BagUnindexedError",
    "Compression",
]
