"""rosbag's interface; see `gazelle.ros.bags`."""

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
]
