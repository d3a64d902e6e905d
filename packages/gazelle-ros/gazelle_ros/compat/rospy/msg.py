"""Messages of any type, and messages from the arguments of a call."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from typing import Any

from gazelle_ros.messages import Message
from gazelle_ros.raw import RawMessage
from gazelle_ros.tcpros.frames import frame

_LENGTH = struct.Struct("<I")


class AnyMsg(RawMessage):
    """A message of any type: subscribe with it, and find the bytes in ``_buff``."""

    __slots__ = ()

    def serialize(self, buff: Any) -> None:
        """Write the bytes.

        Raises:
            ROSException: There are none.
        """
        if not self._buff:
            from gazelle_ros.compat.rospy.exceptions import ROSException

            raise ROSException("AnyMsg is not initialized")
        super().serialize(buff)


def is_message_class(kind: Any) -> bool:
    """Return whether something is a message class, of ours or of the user's."""
    return isinstance(kind, type) and (
        issubclass(kind, (Message, RawMessage))
        or (hasattr(kind, "_md5sum") and hasattr(kind, "serialize"))
    )


def args_kwds_to_message(data_class: Any, args: Sequence[Any], kwds: Mapping[str, Any]) -> Any:
    """Return the message of a call's arguments.

    Args:
        data_class: Its class.
        args: One message, or its fields in order.
        kwds: Or its fields by name.

    Raises:
        TypeError: Both are given, or a message of another type.
    """
    if args and kwds:
        raise TypeError("publish() can be called with arguments or keywords, but not both.")
    if kwds:
        return data_class(**kwds)
    if len(args) != 1:
        return data_class(*args)
    message = args[0]
    if isinstance(message, data_class):
        return message
    if isinstance(message, (Message, RawMessage)) or hasattr(message, "_md5sum"):
        if data_class._md5sum in {message._md5sum, "*"}:
            return message
        types = data_class._slot_types
        if not types or types[0] != message._type:
            expected = types[0] if types else "[]"
            raise TypeError(f"expected [{expected}] but got [{message._type}]")
    return data_class(message)


def serialize_message(b: Any, seq: int, msg: Any) -> None:
    """Append a message to a buffer as it goes over the wire, with its length in front."""
    if getattr(msg, "_has_header", False):
        msg.header.seq = seq
    b.write(frame(msg))


def deserialize_messages(
    b: Any,
    msg_queue: list[Any],
    data_class: Any,
    queue_size: int | None = None,
    max_msgs: int | None = None,
    start: int = 0,
) -> None:
    """Deserialise whole messages of a buffer.

    Args:
        b: The buffer, from `start` to its position; what is left stays in it.
        msg_queue: Gets the messages.
        data_class: Their class.
        queue_size: Keep this many at most, the oldest dropped.
        max_msgs: Take this many at most.
        start: Start of the first message.
    """
    data = b.getvalue()[: b.tell()]
    position, taken = start, 0
    while position + 4 <= len(data) and (max_msgs is None or taken < max_msgs):
        (length,) = _LENGTH.unpack_from(data, position)
        if position + 4 + length > len(data):
            break
        message = data_class()
        message.deserialize(data[position + 4 : position + 4 + length])
        msg_queue.append(message)
        position += 4 + length
        taken += 1
    if queue_size is not None:
        del msg_queue[: max(0, len(msg_queue) - queue_size)]
    b.seek(0)
    b.truncate(0)
    b.write(data[position:])
