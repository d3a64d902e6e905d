"""Messages of any type, as bytes."""

from __future__ import annotations

from typing import Any, ClassVar, Self


class RawMessage:
    """A message of any type: subscribe with it and get the bytes.

    Attributes:
        _buff: The serialised message.
        _connection_header: Of the connection it came by; says what it is.
    """

    __slots__ = ("_buff", "_connection_header")
    _type: ClassVar[str] = "*"
    _md5sum: ClassVar[str] = "*"
    _full_text: ClassVar[str] = ""
    _has_header: ClassVar[bool] = False
    _slot_types: ClassVar[list[str]] = []

    def __init__(self, data: bytes = b"") -> None:
        self._buff = data
        self._connection_header: dict[str, str] = {}

    def serialize(self, buff: Any) -> None:
        """Write the bytes."""
        buff.write(self._buff)

    def deserialize(self, data: bytes) -> Self:
        """Set the bytes."""
        self._buff = data
        return self


_made: dict[Any, type[RawMessage]] = {}


def raw_class(message_class: Any) -> type[RawMessage]:
    """Return a class with the identity of `message_class` and messages kept as bytes."""
    if issubclass(message_class, RawMessage):
        return message_class  # type: ignore[no-any-return]
    found = _made.get(message_class)
    if found is None:
        identity = ("_type", "_md5sum", "_full_text")
        fields = {name: getattr(message_class, name) for name in identity}
        found = type(message_class.__name__, (RawMessage,), {"__slots__": (), **fields})
        _made[message_class] = found
    return found
