"""Coordinate frames over time, as in tf2."""

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
