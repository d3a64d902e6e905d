"""Messages as CBOR (RFC 8949), arrays of numbers as typed arrays (RFC 8746), little endian."""

from __future__ import annotations

import functools
from typing import Any

from gazelle_ros.messages.arrays import DTYPES
from gazelle_ros.messages.spec import FLOATS, INTEGER_BITS, OCTETS, TIMES
from gazelle_ros.rosbridge.values import Convert, split_type, text_of, time_values

_TAGS = {
    "uint16": 69,
    "uint32": 70,
    "uint64": 71,
    "byte": 72,
    "int8": 72,
    "int16": 77,
    "int32": 78,
    "int64": 79,
    "float32": 85,
    "float64": 86,
}


def cbor_values(message: Any) -> dict[str, Any]:
    """Return the fields of a message, ready for `cbor2.dumps`."""
    kind: Any = type(message)
    return {name: convert(getattr(message, name)) for name, convert in _packers(kind)}


@functools.cache
def _packers(message_class: Any) -> tuple[tuple[str, Convert], ...]:
    names, kinds = message_class.__slots__, message_class._slot_types
    fields = [name for name in names if name != "_connection_header"]
    return tuple((name, _packer(kind)) for name, kind in zip(fields, kinds, strict=True))


def _packer(kind: str) -> Convert:
    base, is_array, _ = split_type(kind)
    if is_array:
        if base in OCTETS:
            return bytes
        if base in _TAGS:
            return functools.partial(_typed_array, base)
        one = _packer(base)
        return lambda values: [one(value) for value in values]
    if base in TIMES:
        return time_values
    if base in INTEGER_BITS:
        return int
    if base in FLOATS:
        return float
    if base == "string":
        return text_of
    return bool if base == "bool" else cbor_values


def _typed_array(base: str, values: Any) -> Any:
    import cbor2
    import numpy as np

    return cbor2.CBORTag(_TAGS[base], np.ascontiguousarray(values, dtype=DTYPES[base]).tobytes())
