"""genpy's interface on Gazelle's messages and times."""

import struct

from gazelle.ros.compat.genpy import dynamic, message, rostime
from gazelle.ros.messages import (
    DeserializationError,
    Message,
    MessageException,
    SerializationError,
)
from gazelle.ros.time import Duration, Time, TVal

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
