"""Specification of a message or service: its fields and constants, in order."""

from __future__ import annotations

import keyword
from dataclasses import dataclass, field

INTEGER_BITS = {
    "int8": 8,
    "uint8": 8,
    "int16": 16,
    "uint16": 16,
    "int32": 32,
    "uint32": 32,
    "int64": 64,
    "uint64": 64,
    "byte": 8,
    "char": 8,
}
"""Width of each integer type [bit]; ``byte`` is signed and ``char`` is not."""

UNSIGNED = frozenset({"uint8", "uint16", "uint32", "uint64", "char"})
FLOATS = frozenset({"float32", "float64"})
OCTETS = frozenset({"uint8", "char"})
"""Types with arrays that are ``bytes`` in Python."""

SCALARS = frozenset(INTEGER_BITS) | FLOATS | {"bool"}
CONSTANT_TYPES = SCALARS | {"string"}
TIMES = frozenset({"time", "duration"})
BUILTIN = CONSTANT_TYPES | TIMES

STRUCT_CODES = {
    "bool": "B",
    "int8": "b",
    "byte": "b",
    "uint8": "B",
    "char": "B",
    "int16": "h",
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}
"""Codes of `struct`, little endian, as the wire has them."""


@dataclass(frozen=True, slots=True)
class Field:
    """One field.

    Attributes:
        type: Full type with brackets, such as ``geometry_msgs/Point[]`` or ``float64[36]``.
        name: Name in the definition.
        base: The type without brackets.
        is_array: Whether it is an array.
        length: Number of elements of an array of fixed length.
    """

    type: str
    name: str
    base: str = field(init=False)
    is_array: bool = field(init=False)
    length: int | None = field(init=False)

    def __post_init__(self) -> None:
        base, bracket, rest = self.type.partition("[")
        object.__setattr__(self, "base", base)
        object.__setattr__(self, "is_array", bool(bracket))
        digits = rest[:-1]
        object.__setattr__(self, "length", int(digits) if digits else None)

    @property
    def attribute(self) -> str:
        """Name in Python: words that Python reserves get an underscore."""
        return python_name(self.name)

    @property
    def is_message(self) -> bool:
        """True if its elements are messages."""
        return self.base not in BUILTIN


@dataclass(frozen=True, slots=True)
class Constant:
    """One constant: type, name, value in Python, and the value as written."""

    type: str
    name: str
    value: bool | int | float | str
    text: str


@dataclass(frozen=True, slots=True)
class MessageSpec:
    """A parsed message definition.

    Attributes:
        full_name: Such as ``std_msgs/String``.
        fields: The fields in order.
        constants: The constants in order.
        text: The definition as it was written.
    """

    full_name: str
    fields: tuple[Field, ...]
    constants: tuple[Constant, ...]
    text: str

    @property
    def package(self) -> str:
        """The package it belongs to."""
        return self.full_name.partition("/")[0]

    @property
    def short_name(self) -> str:
        """The name without its package."""
        return self.full_name.partition("/")[2]

    @property
    def has_header(self) -> bool:
        """True if it begins with ``Header header``."""
        first = self.fields[0] if self.fields else None
        return first is not None and (first.type, first.name) == ("std_msgs/Header", "header")

    @property
    def depends(self) -> tuple[str, ...]:
        """The message types of its fields, in order, with repetitions."""
        return tuple(each.base for each in self.fields if each.is_message)


@dataclass(frozen=True, slots=True)
class ServiceSpec:
    """A parsed service definition: the request and the response as messages."""

    full_name: str
    request: MessageSpec
    response: MessageSpec
    text: str


def python_name(name: str) -> str:
    """Return a field's or constant's name, changed where Python reserves the word."""
    return f"{name}_" if keyword.iskeyword(name) or name == "self" else name
