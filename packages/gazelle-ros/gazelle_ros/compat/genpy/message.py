"""Messages and their texts, where genpy keeps them."""

from __future__ import annotations

from typing import Any

from gazelle_ros.messages import (
    DeserializationError,
    Message,
    MessageException,
    SerializationError,
    UnknownTypeError,
    load_message,
    load_service,
)
from gazelle_ros.messages.checking import check_type
from gazelle_ros.messages.yaml import (
    fill_message_args,
    get_printable_message_args,
    strify_message,
)
from gazelle_ros.time import Duration, Time, TVal

__all__ = [
    "DeserializationError",
    "Duration",
    "Message",
    "MessageException",
    "SerializationError",
    "TVal",
    "Time",
    "check_type",
    "fill_message_args",
    "get_message_class",
    "get_printable_message_args",
    "get_service_class",
    "strify_message",
]


def get_message_class(message_type: str, reload_on_error: bool = False) -> Any:  # noqa: FBT001, FBT002  # genpy's interface
    """Return the class of a message type, such as ``std_msgs/String``; None if it is not known."""
    del reload_on_error
    try:
        return load_message(message_type)
    except UnknownTypeError:
        return None


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:  # noqa: FBT001, FBT002  # genpy's interface
    """Return the class of a service type; None if it is not known."""
    del reload_on_error
    try:
        return load_service(service_type)
    except UnknownTypeError:
        return None
