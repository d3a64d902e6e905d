"""Message classes by name, where roslib keeps them."""

from gazelle_ros.compat.genpy.message import (
    Message,
    MessageException,
    check_type,
    fill_message_args,
    get_message_class,
    get_printable_message_args,
    get_service_class,
    strify_message,
)
from gazelle_ros.time import Duration, Time

__all__ = [
    "Duration",
    "Message",
    "MessageException",
    "Time",
    "check_type",
    "fill_message_args",
    "get_message_class",
    "get_printable_message_args",
    "get_service_class",
    "strify_message",
]
