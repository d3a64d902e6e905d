"""tf's interface, the older one, on Gazelle's frames."""

from gazelle_ros.compat.tf import transformations
from gazelle_ros.compat.tf.broadcaster import TransformBroadcaster
from gazelle_ros.compat.tf.listener import Transformer, TransformerROS, TransformListener
from gazelle_ros.compat.tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    LookupException,
)
from gazelle_ros.compat.tf2_py import TransformException as Exception  # noqa: A004  # tf's name

__all__ = [
    "ConnectivityException",
    "Exception",
    "ExtrapolationException",
    "LookupException",
    "TransformBroadcaster",
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "transformations",
]
