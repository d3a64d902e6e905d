"""Arrays of numbers on their way into and out of bytes.

numpy is imported only when a message needs it.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, NoReturn

from gazelle_ros.messages.spec import STRUCT_CODES

DTYPES = {
    "bool": "?",
    "int8": "i1",
    "byte": "i1",
    "uint8": "u1",
    "char": "u1",
    "int16": "<i2",
    "uint16": "<u2",
    "int32": "<i4",
    "uint32": "<u4",
    "int64": "<i8",
    "uint64": "<u8",
    "float32": "<f4",
    "float64": "<f8",
}
_MOST_LENGTHS = 512


class StructMethods(dict[int, Callable[..., Any]]):
    """Methods of the structs for arrays of one type, by the number of elements.

    Args:
        pattern: The struct's codes, with ``{}`` for the number.
        method: The method.
    """

    def __init__(self, pattern: str, method: str) -> None:
        super().__init__()
        self._pattern = pattern
        self._method = method

    def __missing__(self, count: int) -> Callable[..., Any]:
        if len(self) >= _MOST_LENGTHS:
            self.clear()
        made: Callable[..., Any] = getattr(struct.Struct(self._pattern.format(count)), self._method)
        self[count] = made
        return made


def shared_names() -> dict[str, Any]:
    """Return the names that all compiled encoders and decoders refer to."""
    names: dict[str, Any] = {}
    for code in "?" + "".join(sorted(set(STRUCT_CODES.values()))):
        names[f"_unpackers_{code}".replace("?", "bool")] = StructMethods(
            f"<{{}}{code}", "unpack_from"
        )
        names[f"_packers_{code}".replace("?", "bool")] = StructMethods(f"<I{{}}{code}", "pack")
    return names | {
        "_octets": octets,
        "_numbers": numbers,
        "_view": view,
        "_too_short": too_short,
        "_too_many": too_many,
        "_wrong_length": wrong_length,
        "_list": list,
        "_tuple": tuple,
    }


def octets(value: Any, count: int | None) -> bytes | bytearray | memoryview:
    """Return the bytes of a ``uint8[]`` that is not given as ``bytes``.

    Raises:
        TypeError: It is no sequence of bytes.
        struct.error: A number in it is no byte, or there are not ``count`` of them.
    """
    if isinstance(value, (list, tuple)):
        return struct.pack(f"{len(value) if count is None else count}B", *value)
    if isinstance(value, bytearray):
        return value
    if isinstance(value, str):
        raise TypeError("argument for 's' must be a bytes object")
    data = memoryview(value)
    if data.itemsize != 1:
        raise TypeError(f"an array of bytes is needed, not of items of {data.itemsize} bytes")
    if count is not None and data.nbytes != count:
        raise TypeError(f"expecting {count} bytes, but found {data.nbytes}")
    # A struct takes no memoryview, and an empty one cannot be cast.
    if count is not None or not data.c_contiguous or not data.nbytes:
        return data.tobytes()
    return data.cast("B")


def numbers(value: Any, base: str, count: int | None) -> bytes:
    """Encode an array of numbers that is not a list or tuple, with its length if that varies.

    Args:
        value: A numpy array of any shape (taken row by row), or another sequence.
        base: Type of the elements.
        count: Number of elements, if it is fixed.

    Raises:
        TypeError: The elements are of another kind, or not ``count``.
        struct.error: An element does not fit the type.
        OverflowError: A number in a numpy array does not fit.
    """
    size = value.size if hasattr(value, "dtype") else len(value)
    if count is not None and size != count:
        raise TypeError(f"expecting {count} items but found {size}")
    if hasattr(value, "dtype"):
        data = _numpy_bytes(value, base)
    else:
        data = struct.pack(f"<{size}{STRUCT_CODES[base]}", *value)
    return data if count is not None else struct.pack("<I", size) + data


def _numpy_bytes(value: Any, base: str) -> bytes:
    import numpy as np

    expected = np.dtype(DTYPES[base])
    if value.size and not np.can_cast(value.dtype, expected, "same_kind"):
        _check_unlike(value, expected)
    if value.dtype != expected and expected.kind in "iu" and value.size:
        limits = np.iinfo(expected)
        if int(value.min()) < limits.min or int(value.max()) > limits.max:
            raise OverflowError(f"a number in the array does not fit into {base}")
    data: bytes = np.ascontiguousarray(value, dtype=expected).tobytes()
    return data


def _check_unlike(value: Any, expected: Any) -> None:
    """Check that kinds are compatible: integers of either sign are, and bools with numbers.

    Raises:
        TypeError: The kinds are too far apart.
    """
    if not (value.dtype.kind in "iub" and expected.kind in "iub"):
        raise TypeError(f"an array of {value.dtype} cannot be sent as {expected}")


def view(data: bytes, base: str, count: int, offset: int) -> Any:
    """Return a numpy array on top of the bytes of a message, without a copy."""
    import numpy as np

    return np.ndarray((count,), DTYPES[base], data, offset)


def too_short(needed: int, size: int) -> NoReturn:
    """Report that a message ends early.

    Raises:
        struct.error: Always.
    """
    raise struct.error(f"the message needs at least {needed} bytes, but has {size}")


def too_many(count: int) -> NoReturn:
    """Report an array of implausibly many empty messages.

    Raises:
        struct.error: Always.
    """
    raise struct.error(f"an array of {count} empty messages is not plausible")


def wrong_length(expected: int, value: Any) -> NoReturn:
    """Report an array of fixed length that has another one.

    Raises:
        TypeError: Always.
    """
    raise TypeError(f"Expecting {expected} items but found {len(value)}")
