"""The base of all message and service classes."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, Self, cast

from gazelle_ros.messages.errors import MessageException, SerializationError

if TYPE_CHECKING:
    from gazelle_ros.messages.spec import MessageSpec


class Sink(Protocol):
    """Target that a message is written to: a binary file or `io.BytesIO`."""

    def write(self, data: Any, /) -> object:
        """Append bytes."""


class Message:
    """A message: a value with the fields of its type.

    The classes are made from definitions and behave as genpy's do. A message is made with no
    arguments (all defaults), with all fields in order, or with some by keyword. A keyword that is
    ``None`` means the default.

    Attributes:
        _type: Full name, such as ``geometry_msgs/Twist``.
        _md5sum: MD5 sum of the definition on the wire.
        _full_text: The definition and all it depends on.
        _has_header: Whether the first field is ``Header header``.
        _slot_types: Type of each field, in the order of ``__slots__``.
        _connection_header: Header of the connection it came from, on received messages.

    Raises:
        TypeError: Arguments of both kinds, or not one for each field.
        AttributeError: A keyword is not a field.
    """

    __slots__ = ["_connection_header"]

    _type: ClassVar[str] = ""
    _md5sum: ClassVar[str] = ""
    _full_text: ClassVar[str] = ""
    _has_header: ClassVar[bool] = False
    _slot_types: ClassVar[list[str]] = []
    _spec: ClassVar[MessageSpec]
    _connection_header: dict[str, str]

    # Code is compiled when a class is first used; these compile it and call it.

    def __init__(self, *args: Any, **kwds: Any) -> None:
        _compile(self, "__init__")(self, *args, **kwds)

    def serialize(self, buff: Sink) -> None:
        """Write the message as bytes.

        Raises:
            SerializationError: A field holds a value outside its type.
        """
        _compile(self, "serialize")(self, buff)

    def deserialize(self, data: bytes, numpy: bool = False) -> Self:  # noqa: FBT001, FBT002  # brief for callers
        """Set the fields from bytes; bytes left over are ignored.

        Args:
            data: The serialised message.
            numpy: Whether numeric arrays, ``uint8[]`` too, shall be numpy arrays: read-only views
                of ``data``, without a copy. Otherwise they are tuples, and ``uint8[]`` is bytes.

        Raises:
            DeserializationError: The bytes are too few, or lengths in them are impossible.
        """
        return cast("Self", _compile(self, "deserialize")(self, data, numpy))

    def serialize_numpy(self, buff: Sink, numpy: Any) -> None:
        """Write the message as bytes; as `serialize`, which takes numpy arrays as well."""
        del numpy
        self.serialize(buff)

    def deserialize_numpy(self, data: bytes, numpy: Any) -> Self:
        """Set the fields from bytes, numeric arrays as numpy arrays.

        As genpy does, and unlike ``deserialize(data, numpy=True)``, this leaves ``uint8[]`` bytes.
        """
        del numpy
        return self._decode_numpy(data)

    def _decode_numpy(self, data: bytes) -> Self:
        return cast("Self", _compile(self, "_decode_numpy")(self, data))

    def _decode_arrays(self, data: bytes) -> Self:
        return cast("Self", _compile(self, "_decode_arrays")(self, data))

    def _decode_lossy(self, data: bytes) -> Self:
        return cast("Self", _compile(self, "_decode_lossy")(self, data))

    def _get_types(self) -> list[str]:
        return self._slot_types

    def _check_types(self, exc: BaseException | None = None) -> None:
        """Raise an error that names the field with a wrong value.

        Raises:
            SerializationError: One does, or ``exc`` is given.
        """
        from gazelle_ros.messages.checking import check_type

        for name, type_ in zip(self.__slots__, self._get_types(), strict=True):
            check_type(name, type_, getattr(self, name))
        if exc:
            raise SerializationError(str(exc)) from exc

    def __getstate__(self) -> list[Any]:
        return [getattr(self, name) for name in self.__slots__]

    def __setstate__(self, state: list[Any]) -> None:
        for name, value in zip(self.__slots__, state, strict=True):
            setattr(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        if "_spec" not in type(self).__dict__:  # a subclass, which can be imported by its name
            return cast("tuple[Any, ...]", super().__reduce_ex__(2))
        from gazelle_ros.messages.pickling import blank, recipe

        return blank, recipe(type(self)), self.__getstate__()

    def __repr__(self) -> str:
        from gazelle_ros.messages.yaml import strify_message

        return strify_message(self)

    __str__ = __repr__

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, self.__class__):
            return False
        for name in self.__slots__:
            try:
                mine, theirs = getattr(self, name), getattr(other, name)
            except AttributeError:
                return False
            if not _equal(mine, theirs):
                return False
        return True

    __hash__ = None  # type: ignore[assignment]  # messages are mutable values


class ServiceDefinition:
    """A service type: it names the classes of the request and of the response."""

    _type: ClassVar[str] = ""
    _md5sum: ClassVar[str] = ""
    _full_text: ClassVar[str] = ""
    _request_class: ClassVar[type[Message]]
    _response_class: ClassVar[type[Message]]


def _compile(message: Message, method: str) -> Any:
    from gazelle_ros.messages.compile import compiled

    owner = next((each for each in type(message).__mro__ if "_spec" in each.__dict__), None)
    if owner is None:
        raise MessageException("a message is of a class with a definition; load_message has those")
    return compiled(owner, method)


def _equal(mine: Any, theirs: Any) -> bool:
    kinds = type(mine), type(theirs)
    if kinds[0] in _SEQUENCES and kinds[1] in _SEQUENCES:
        return tuple(mine) == tuple(theirs)
    if getattr(mine, "ndim", 0) or getattr(theirs, "ndim", 0):
        return bool(_listed(mine) == _listed(theirs))
    return bool(mine == theirs)


def _listed(value: Any) -> Any:
    """Return a numpy array, or its counterpart in a comparison, as a list."""
    if hasattr(value, "tolist"):
        return value.tolist()
    return list(value) if isinstance(value, (list, tuple, bytes, bytearray)) else value


_SEQUENCES = frozenset({list, tuple})
STRUCT_ERRORS = (struct.error, TypeError, OverflowError)
