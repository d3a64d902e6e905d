"""tf2_ros's interface on Gazelle's frames."""

from gazelle_ros.compat.tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from gazelle_ros.compat.tf2_ros.buffer import DEFAULT_CAN_TRANSFORM_POLLING_SCALE, Buffer
from gazelle_ros.compat.tf2_ros.buffer_client import BufferClient
from gazelle_ros.compat.tf2_ros.buffer_interface import (
    BufferInterface,
    ConvertRegistration,
    NotImplementedException,
    Stamped,
    TransformRegistration,
    TypeException,
    convert,
)
from gazelle_ros.compat.tf2_ros.buffer_server import BufferServer
from gazelle_ros.compat.tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster
from gazelle_ros.compat.tf2_ros.transform_broadcaster import TransformBroadcaster
from gazelle_ros.compat.tf2_ros.transform_listener import TransformListener
from gazelle_ros.msgs import geometry_msgs, std_msgs, tf2_msgs

# The real module gives these names, too, and programs import them from here.
Header = std_msgs.msg.Header
TFMessage = tf2_msgs.msg.TFMessage
TransformStamped = geometry_msgs.msg.TransformStamped

__all__ = [
    "DEFAULT_CAN_TRANSFORM_POLLING_SCALE",
    "Buffer",
    "BufferClient",
    "BufferCore",
    "BufferInterface",
    "BufferServer",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "Header",
    "InvalidArgumentException",
    "LookupException",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "TFMessage",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TransformStamped",
    "TypeException",
    "convert",
]
