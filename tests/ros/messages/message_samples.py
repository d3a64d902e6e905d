"""Random messages of any type, the peers' copies of them, and a type with every kind of field."""

import io
import random
import struct
from typing import Any

from hypothesis import strategies as st

from gazelle_ros.messages import Message
from gazelle_ros.messages.spec import FLOATS, INTEGER_BITS, OCTETS, UNSIGNED, Field
from gazelle_ros.time import Duration, Time

INNER = """
float64 x
bool on
time when
"""
VARYING = """
string label
uint8[] raw
"""
ALL_KINDS = """
# every kind of field
Header header
bool a_bool
int8 an_int8
uint8 an_uint8
byte a_byte
char a_char
int16 an_int16
uint16 an_uint16
int32 an_int32
uint32 an_uint32
int64 an_int64
uint64 an_uint64
float32 a_float32
float64 a_float64
string a_string
time a_time
duration a_duration
bool[] bools
bool[3] three_bools
byte[] bytes_
int16[] int16s
int32[4] four_int32s
uint64[] uint64s
float32[] float32s
float64[2] two_float64s
uint8[] octets
uint8[5] five_octets
char[] chars
char[2] two_chars
string[] strings
string[2] two_strings
time[] times
time[2] two_times
duration[] durations
Inner inner
Inner[] inners
Inner[2] two_inners
Varying varying
Varying[] varyings
Varying[2] two_varyings
Hollow hollow
Hollow[] hollows
int32 lambda
int32 self
int32 FIRST=-3
uint8 SECOND = 7  # the seventh
string TEXT= a # b "c" 'd'
float32 RATIO=1.5e3
bool YES=True
"""
SAMPLE_TYPES = {"Inner": INNER, "Varying": VARYING, "Hollow": "\n", "AllKinds": ALL_KINDS}


def dumps(message: Any) -> bytes:
    """Serialise a message of any maker with genpy's interface."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def fields_of(made: type[Message]) -> list[Field]:
    """Return the fields of a class, by the names they have in Python."""
    return [
        Field(type_, name) for type_, name in zip(made._slot_types, made.__slots__, strict=True)
    ]


def random_message(made: type[Message], rng: random.Random, longest: int = 3) -> Message:
    """Return a message with random fields.

    Arrays that may vary have up to ``longest`` elements.
    """
    message = made.__new__(made)
    for field in fields_of(made):
        if not field.is_array:
            value = _random_value(field.base, made, rng, longest)
        else:
            count = rng.randint(0, longest) if field.length is None else field.length
            if field.base in OCTETS:
                value = rng.randbytes(count)
            else:
                value = [_random_value(field.base, made, rng, longest) for _ in range(count)]
        setattr(message, field.name, value)
    return message


def _random_value(base: str, made: type[Message], rng: random.Random, longest: int) -> Any:
    if base in INTEGER_BITS:
        bits = INTEGER_BITS[base]
        value = rng.choice([0, 1, (1 << bits) - 1, rng.getrandbits(bits)])
        return value if base in UNSIGNED else value - (1 << bits - 1)
    if base in FLOATS:
        value = rng.choice([0.0, 1.0, rng.uniform(-1e6, 1e6), float("inf")])
        return struct.unpack("<f", struct.pack("<f", value))[0] if base == "float32" else value
    if base == "bool":
        return rng.random() < 0.5
    if base == "string":
        return "".join(rng.choices("abc xyz\n\x00'\"\\:#é→😀", k=rng.randint(0, 9)))
    if base == "time":
        return Time(rng.randrange(1 << 32), rng.randrange(10**9))
    if base == "duration":
        return Duration(rng.randrange(-(1 << 31), 1 << 31), rng.randrange(10**9))
    return random_message(made._known[base], rng, longest)


def messages(made: type[Message]) -> st.SearchStrategy[Message]:
    """Return messages of a type, as a strategy."""
    return st.tuples(*(_values(field, made) for field in fields_of(made))).map(
        lambda values: made(*values)
    )


def _values(field: Field, made: type[Message]) -> st.SearchStrategy[Any]:
    if field.is_array:
        low, high = (0, 3) if field.length is None else (field.length, field.length)
        if field.base in OCTETS:
            return st.binary(min_size=low, max_size=high)
        return st.lists(_elements(field.base, made), min_size=low, max_size=high)
    return _elements(field.base, made)


def _elements(base: str, made: type[Message]) -> st.SearchStrategy[Any]:
    if base in INTEGER_BITS:
        bits = INTEGER_BITS[base]
        low = 0 if base in UNSIGNED else -(1 << bits - 1)
        return st.integers(low, low + (1 << bits) - 1)
    if base in FLOATS:
        return st.floats(width=32 if base == "float32" else 64, allow_nan=False)
    if base == "bool":
        return st.booleans()
    if base == "string":
        return st.text(max_size=8)
    if base == "time":
        return st.builds(Time, st.integers(0, 2**32 - 1), st.integers(0, 10**9 - 1))
    if base == "duration":
        return st.builds(Duration, st.integers(-(2**31), 2**31 - 1), st.integers(0, 10**9 - 1))
    return messages(made._known[base])
