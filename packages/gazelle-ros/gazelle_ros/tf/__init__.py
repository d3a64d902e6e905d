"""Coordinate frames over time: what tf2 does, without its server."""

from gazelle_ros.tf.core import FrameTree, StampedTransform
from gazelle_ros.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from gazelle_ros.tf.taking import take_transforms

__all__ = [
    "ConnectivityException",
    "ExtrapolationException",
    "FrameTree",
    "InvalidArgumentException",
    "LookupException",
    "StampedTransform",
    "TimeoutException",
    "TransformException",
    "take_transforms",
]
