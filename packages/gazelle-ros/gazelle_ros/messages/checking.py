"""Find the field of a message that holds a wrong value."""

from __future__ import annotations

import numbers
from collections.abc import Callable
from typing import Any

from gazelle_ros.messages.base import Message
from gazelle_ros.messages.errors import SerializationError
from gazelle_ros.messages.spec import INTEGER_BITS, OCTETS, UNSIGNED
from gazelle_ros.time import Duration, Time

_ARRAYS = frozenset({"ndarray", "array", "memoryview", "bytearray"})


def check_type(field_name: str, field_type: str, field_val: Any) -> None:
    """Check a value against the type of its field; slow, and meant to explain an error.

    Args:
        field_name: Name for the error.
        field_type: Type of the field, such as ``float64[]``.
        field_val: The value.

    Raises:
        SerializationError: The value does not fit the type.
    """
    if field_type.endswith("]"):
        _check_array(field_name, field_type.partition("[")[0], field_val)
    elif field_type in INTEGER_BITS:
        _check_integer(field_name, field_type, field_val)
    elif field_type in _SIMPLE:
        fits, expected = _SIMPLE[field_type]
        if not fits(field_val):
            raise SerializationError(f"field {field_name} {expected}")
    else:
        _check_message(field_name, field_type, field_val)


def _is_float(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def _is_bool(value: Any) -> bool:
    return isinstance(value, numbers.Integral) or "bool" in type(value).__name__


_SIMPLE: dict[str, tuple[Callable[[Any], bool], str]] = {
    "float32": (_is_float, "must be float type"),
    "float64": (_is_float, "must be float type"),
    "bool": (_is_bool, "is not a bool"),
    # Bytes are left to the error of the encoder, as in genpy.
    "string": (lambda value: isinstance(value, (str, bytes)), "must be of type str"),
    "time": (lambda value: isinstance(value, Time), "must be of type Time"),
    "duration": (lambda value: isinstance(value, Duration), "must be of type Duration"),
}


def _check_integer(name: str, type_: str, value: Any) -> None:
    unsigned = type_ in UNSIGNED
    if not isinstance(value, numbers.Integral):
        kind = "unsigned integer" if unsigned else "an integer"
        raise SerializationError(f"field {name} must be {kind} type")
    if unsigned and value < 0:
        raise SerializationError(f"field {name} must be unsigned integer type")
    high = 1 << INTEGER_BITS[type_] - (not unsigned)
    if not (0 if unsigned else -high) <= int(value) < high:
        raise SerializationError(f"field {name} exceeds specified width [{type_}]")


def _check_array(name: str, base: str, value: Any) -> None:
    if isinstance(value, (bytes, str)):
        if base not in OCTETS:
            raise SerializationError(
                f"field {name} must be a list or tuple type. Only uint8[] can be a string"
            )
        return
    if type(value).__name__ in _ARRAYS:
        return
    if not isinstance(value, (list, tuple)):
        raise SerializationError(f"field {name} must be a list or tuple type")
    for each in value:
        check_type(f"{name}[]", base, each)


def _check_message(name: str, type_: str, value: Any) -> None:
    if not isinstance(value, Message):
        raise SerializationError(f"field {name} must be of type [{type_}]")
    if value._type != type_:
        raise SerializationError(f"field {name} must be of type {type_} instead of {value._type}")
    for each, each_type in zip(value.__slots__, value._slot_types, strict=True):
        check_type(f"{name}.{each}", each_type, getattr(value, each))
