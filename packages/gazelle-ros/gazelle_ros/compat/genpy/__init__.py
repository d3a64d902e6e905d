"""genpy's interface on Gazelle's messages and times."""

import struct

from gazelle_ros.compat.genpy import dynamic, message, rostime
from gazelle_ros.messages import (
    DeserializationError,
    Message,
    MessageException,
    SerializationError,
)
from gazelle_ros.time import Duration, Time, TVal

struct_I = struct.Struct("<I")  # noqa: N816  # genpy's name

__all__ = [
    "DeserializationError",
    "Duration",
    "Message",
    "MessageException",
    "SerializationError",
    "TVal",
    "Time",
    "dynamic",
    "message",
    "rostime",
    "struct_I",
]
