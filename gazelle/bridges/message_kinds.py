"""Ports whose kind is a ROS message itself, for plugins that speak ROS: it goes over as it is.

An output gives one message for all worlds, or a sequence of one a world.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle_ros.messages import Message


def name_of(kind: Any) -> str | None:
    """Return the ROS type of a message class, such as ``std_msgs/String``.

    None for other kinds.
    """
    name = getattr(kind, "_type", None)
    return name if isinstance(name, str) and hasattr(kind, "_md5sum") else None


def service_name_of(request: Any, response: Any) -> str | None:
    """Return the ROS type of a service's two classes; None for other kinds."""
    request_name, response_name = name_of(request), name_of(response)
    if request_name is None or response_name is None:
        return None
    name = request_name.removesuffix("Request")
    return name if response_name.removesuffix("Response") == name else None


def fill(message: Message, value: Any, view: Any) -> None:
    """Copy a message, or that of the graph's world."""
    item = value[view.world] if isinstance(value, Sequence) else value
    for slot, content in slots_of(item).items():
        setattr(message, slot, content)


def slots_of(message: Message) -> dict[str, Any]:
    """Return the fields of a message by name."""
    return {slot: getattr(message, slot) for slot in message.__slots__}


def same(message: Message) -> Any:
    """Return the message."""
    return message
