"""Messages as JSON values and back, as rosbridge has them.

``uint8[]`` and ``char[]`` are base64, times are objects with ``secs`` and ``nsecs``, and a float
that is not finite is ``null``, for JSON has none.
"""

from __future__ import annotations

import base64
import binascii
import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.messages import MessageException, load_message
from gazelle_ros.messages.spec import FLOATS, INTEGER_BITS, OCTETS, SCALARS, TIMES, UNSIGNED
from gazelle_ros.time import Duration, Time

Convert = Callable[[Any], Any]
HEADERS = frozenset({"std_msgs/Header", "Header", "roslib/Header"})


def json_values(message: Any) -> dict[str, Any]:
    """Return the fields of a message, ready for `json.dumps`."""
    kind: Any = type(message)
    return {name: convert(getattr(message, name)) for name, convert in _writers(kind)}


def fill_message(message: Any, values: Any, now: Time) -> Any:
    """Set the fields of a message from JSON values; other fields keep their defaults.

    Args:
        message: Of any type; it is returned.
        values: A JSON object.
        now: Stamp of headers that have none, and of times that are ``"now"``.

    Raises:
        MessageException: A field is not there, or a value does not fit its type.
    """
    _Filler(message._type, now).fill(message, values, ())
    return message


def split_type(kind: str) -> tuple[str, bool, int | None]:
    """Return the base of a field's type, whether it is an array, and its fixed length."""
    base, bracket, length = kind.partition("[")
    length = length.rstrip("]")
    return base, bool(bracket), int(length) if length else None


# Out ---------------------------------------------------------------------------------------


@functools.cache
def _writers(message_class: Any) -> tuple[tuple[str, Convert], ...]:
    names, kinds = message_class.__slots__, message_class._slot_types
    fields = [name for name in names if name != "_connection_header"]
    return tuple((name, _writer(kind)) for name, kind in zip(fields, kinds, strict=True))


def _writer(kind: str) -> Convert:
    base, is_array, _ = split_type(kind)
    if is_array:
        if base in OCTETS:
            return octets_as_text
        if base in FLOATS:
            return _floats
        if base in SCALARS:
            return _plain_list
        one = _writer(base)
        return lambda values: [one(value) for value in values]
    if base in FLOATS:
        return _float
    if base in TIMES:
        return time_values
    if base == "string":
        return text_of
    return _same if base in SCALARS else json_values


def octets_as_text(value: Any) -> str:
    """Return bytes as base64."""
    data = bytes(value) if isinstance(value, (list, tuple)) else value
    return base64.b64encode(data).decode("ascii")


def text_of(value: Any) -> str:
    """Return a string; invalid UTF-8 in it is replaced, for JSON and CBOR have only text."""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def time_values(value: Any) -> dict[str, int]:
    """Return the fields of a time or duration."""
    return {"secs": int(value.secs), "nsecs": int(value.nsecs)}


def _same(value: Any) -> Any:
    return value


def _float(value: Any) -> float | None:
    return float(value) if math.isfinite(value) else None


def _plain_list(values: Any) -> list[Any]:
    return values.tolist() if hasattr(values, "tolist") else list(values)


def _floats(values: Any) -> list[float | None]:
    numbers = _plain_list(values)
    if all(map(math.isfinite, numbers)):
        return numbers
    return [number if math.isfinite(number) else None for number in numbers]


# In ----------------------------------------------------------------------------------------


class _Filler:
    """Fills one message; knows its type for errors, and the time."""

    def __init__(self, root: str, now: Time) -> None:
        self._root, self._now = root, now

    def fill(self, message: Any, values: Any, path: tuple[str, ...]) -> None:
        if not isinstance(values, Mapping):
            raise self._type_error(path, "JSON object", values)
        message_class: Any = type(message)
        kinds = _kinds(message_class)
        for name, value in values.items():
            if name not in kinds:
                raise MessageException(
                    f"Message type {self._root} does not have a field {'.'.join((*path, name))}",
                    hint=did_you_mean(str(name), kinds),
                )
            default = getattr(message, name)
            setattr(message, name, self._value(kinds[name], value, default, (*path, name)))
        if message._type in HEADERS and "stamp" not in values:
            message.stamp = self._time("time", "now", path)
        if not path and getattr(message, "_has_header", False) and "header" not in values:
            message.header.stamp = self._time("time", "now", path)

    def _value(self, kind: str, value: Any, default: Any, path: tuple[str, ...]) -> Any:
        base, is_array, length = split_type(kind)
        if is_array:
            return self._array(base, length, value, path)
        if base in FLOATS:
            return self._float(base, value, path)
        if base in INTEGER_BITS:
            return self._integer(base, value, path)
        if base in TIMES:
            return self._time(base, value, path)
        if base in {"string", "bool"}:
            if not isinstance(value, str if base == "string" else bool):
                raise self._type_error(path, base, value)
            return value
        message = load_message(base)() if default is None else default
        self.fill(message, value, path)
        return message

    def _array(self, base: str, length: int | None, value: Any, path: tuple[str, ...]) -> Any:
        array_type = f"{base}[{'' if length is None else length}]"
        if base in OCTETS and isinstance(value, str):
            found: Any = self._decoded(array_type, value, path)
        elif isinstance(value, Sequence) and not isinstance(value, (str, bytes)):
            found = [
                self._value(base, each, None, (*path[:-1], f"{path[-1]}[{index}]"))
                for index, each in enumerate(value)
            ]
        else:
            raise self._type_error(path, array_type, value)
        if length is not None and len(found) != length:
            raise MessageException(
                f"{self._root} message requires {length} items for field {'.'.join(path)}, "
                f"but got {len(found)}"
            )
        return bytes(found) if base in OCTETS else found

    def _decoded(self, type_name: str, value: str, path: tuple[str, ...]) -> bytes:
        try:
            return base64.b64decode(value, validate=True)
        except (binascii.Error, ValueError):
            raise self._type_error(path, f"{type_name} as base64 or list", value) from None

    def _float(self, base: str, value: Any, path: tuple[str, ...]) -> float:
        if value is None:
            return math.nan  # what is not finite comes back as it went out
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise self._type_error(path, base, value)
        try:
            return float(value)
        except OverflowError:
            raise self._type_error(path, base, value) from None

    def _integer(self, base: str, value: Any, path: tuple[str, ...]) -> int:
        if isinstance(value, bool) or not isinstance(value, int):
            raise self._type_error(path, base, value)
        unsigned = base in UNSIGNED
        high = 1 << (INTEGER_BITS[base] - (not unsigned))
        if not (0 if unsigned else -high) <= value < high:
            raise MessageException(
                f"{self._root} message has a {base} for field {'.'.join(path)}; "
                f"{str(value)[:40]} does not fit into it"
            )
        return value

    def _time(self, base: str, value: Any, path: tuple[str, ...]) -> Any:
        if base == "time" and value == "now":
            return Time(self._now.secs, self._now.nsecs)
        if not isinstance(value, Mapping):
            raise self._type_error(path, f"{base} (an object with secs and nsecs)", value)
        integer = "uint32" if base == "time" else "int32"
        parts = []
        for known, old in (("secs", "sec"), ("nsecs", "nanosec")):
            each = value.get(known, value.get(old, 0))
            parts.append(self._integer(integer, each, (*path, known)))
        unknown = set(value) - {"secs", "nsecs", "sec", "nanosec"}
        if unknown:
            raise self._type_error(path, f"{base} (an object with secs and nsecs)", value)
        made: Any = Time(*parts) if base == "time" else Duration(*parts)
        return made

    def _type_error(self, path: tuple[str, ...], expected: str, value: Any) -> MessageException:
        if not path:
            return MessageException(
                f"Expected a JSON object for type {self._root} but received a "
                f"{type(value).__name__}"
            )
        return MessageException(
            f"{self._root} message requires a {expected} for field {'.'.join(path)}, "
            f"but got a {type(value).__name__}: {str(value)[:60]}"
        )


@functools.cache
def _kinds(message_class: Any) -> dict[str, str]:
    fields = [name for name in message_class.__slots__ if name != "_connection_header"]
    return dict(zip(fields, message_class._slot_types, strict=True))
