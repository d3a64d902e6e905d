"""Types of values in kernels: numbers, truth values, arrays and tuples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np

from gazelle.errors import EngineError

REAL: Final = "double"  # numbers go by the names that LLVM has for them
WHOLE: Final = "i64"
TRUTH: Final = "i1"
BITS: Final = "u64"  # 64 bits without a sign, the same to LLVM as WHOLE
RESULTS: Final = 8  # numbers that a kernel hands to Python at most
WIDTH: Final = 64  # bits of whole numbers


@dataclass(frozen=True, slots=True)
class Array:
    """A contiguous array: what its elements are in memory, and how many axes it has."""

    element: str
    axes: int


@dataclass(frozen=True, slots=True)
class Group:
    """A tuple of values."""

    parts: tuple[Kind, ...]


Kind: TypeAlias = str | Array | Group

UNSIGNED: Final = ("uint8",)  # of those that become whole numbers

_MOST_AXES: Final = 4

# Elements of arrays: what they are in memory, and what they become when they are read.
ELEMENTS: Final = {
    "float64": ("double", REAL),
    "float32": ("float", REAL),
    "int64": ("i64", WHOLE),
    "int32": ("i32", WHOLE),
    "int8": ("i8", WHOLE),
    "uint8": ("i8", WHOLE),
    "uint64": ("i64", BITS),
    "bool": ("i8", TRUTH),
}

_ARRAYS: Final = {
    (np.dtype(name), axes): Array(name, axes)
    for name in ELEMENTS
    for axes in range(1, _MOST_AXES + 1)
}


@dataclass(frozen=True, slots=True)
class Value:
    """A value in code that is being made.

    Attributes:
        kind: Its type.
        text: How LLVM's language writes it; the address of an array's first element.
        sizes: Of an array, along each axis.
        parts: Of a tuple.
        known: What it is, if that is known.
    """

    kind: Kind
    text: str = ""
    sizes: tuple[str, ...] = ()
    parts: tuple[Value, ...] = ()
    known: Any = None


def low(kind: Kind) -> str:
    """What LLVM calls a number's type."""
    return WHOLE if kind == BITS else str(kind)


def kind_of(value: Any) -> Kind:
    """The type of something that a kernel is called with.

    Raises:
        EngineError: Kernels do not take such values.
    """
    if isinstance(value, np.ndarray):
        kind = _ARRAYS.get((value.dtype, value.ndim))
        if kind is None or not value.flags.c_contiguous:
            raise EngineError(
                f"kernels take contiguous arrays, not {value.dtype} of {value.ndim} axes"
            )
        return kind
    if isinstance(value, tuple):
        return Group(tuple(kind_of(each) for each in value))
    if isinstance(value, (bool, np.bool_)):
        return TRUTH
    if isinstance(value, np.uint64):
        return BITS
    if isinstance(value, (int, np.integer)):
        return WHOLE
    if isinstance(value, (float, np.floating)):
        return REAL
    raise EngineError(f"kernels take numbers and arrays, not {type(value).__name__}")


def flat(kind: Kind) -> list[str]:
    """What a value of a type is handed over as: an array as its address and its sizes."""
    if isinstance(kind, Array):
        return ["ptr", *[WHOLE] * kind.axes]
    if isinstance(kind, Group):
        return [each for part in kind.parts for each in flat(part)]
    return [low(kind)]


def joined(one: Kind, other: Kind) -> Kind | None:
    """The type that holds both; None if none does."""
    if one == other:
        return one
    if isinstance(one, Group) and isinstance(other, Group) and len(one.parts) == len(other.parts):
        parts = [joined(a, b) for a, b in zip(one.parts, other.parts, strict=True)]
        return None if None in parts else Group(tuple(part for part in parts if part is not None))
    numbers = [TRUTH, WHOLE, REAL]
    if one in numbers and other in numbers:
        return numbers[max(numbers.index(str(one)), numbers.index(str(other)))]
    return None
