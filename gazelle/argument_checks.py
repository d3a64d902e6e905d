"""Check of the arguments of functions that people call, before anything is computed with them.

An annotation says float, and NaN is one; it says str, and no name holds a null. What makes no sense
anywhere is refused here, in one place; ranges of their own are the functions' own business.
"""

from __future__ import annotations

import functools
import inspect
import math
import re
from collections.abc import Callable, Mapping
from numbers import Integral, Real
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from gazelle.characters import can_be_written
from gazelle.errors import Error

Decorated = TypeVar("Decorated", bound=Callable[..., Any])

MOST = 1e15
"""Greatest magnitude of a float: its square and cube are numbers, too."""
MOST_INT = 2**53
_DEEPEST = 4
_TRUSTED = {"restore"}
"""Methods that get what their own class made, such as a state with infinite costs."""
_ARRAY = re.compile(r"\b(ArrayLike|Floats|Bools|Indices|Ints\d*)\b")
_LENGTHS = {"Vector3": 3, "Vector": 3, "tuple[float, float]": 2, "tuple[int, int]": 2, "Range": 2}
"""Numbers in a value of these annotations."""


def checked(error: type[Error], *, most: float = MOST) -> Callable[[Decorated], Decorated]:
    """Return a decorator of a function, or of what a class has in public, that refuses arguments.

    Floats, also those in tuples, lists, mappings and arrays, must be finite and not huge, unless the
    default is infinite; ints less than 2^53 in magnitude; texts without nulls and surrogates;
    vectors of as many numbers as their annotation says.

    Args:
        error: Raised for such an argument, and for arrays of shapes that do not fit.
        most: Greatest magnitude of a float.
    """

    def decorate(decorated: Decorated) -> Decorated:
        if isinstance(decorated, type):
            for name, member in list(vars(decorated).items()):
                public = name == "__init__" or (name[0] != "_" and name not in _TRUSTED)
                if inspect.isfunction(member) and public:
                    setattr(decorated, name, _checking(member, error, most))
            return decorated
        made: Decorated = _checking(decorated, error, most)
        return made

    return decorate


def _checking(function: Any, error: type[Error], most: float) -> Any:
    parameters = inspect.signature(function).parameters
    order = [name for name, each in parameters.items() if each.kind != each.KEYWORD_ONLY]
    limits = dict.fromkeys(parameters, most) | {
        name: math.inf for name, each in parameters.items() if _is_endless(each.default)
    }
    kinds = {
        name: str(each.annotation).removesuffix(" | None") for name, each in parameters.items()
    }

    @functools.wraps(function)
    def call(*positional: Any, **named: Any) -> Any:
        for name, value in (*zip(order, positional, strict=False), *named.items()):
            if name == "seed":  # any int, also one of 128 bits
                continue
            fault = _fault(value, limits.get(name, most)) or _fault_of(kinds.get(name, ""), value)
            if fault is not None:
                raise error(f"'{name}' must be {fault}, not {value!r:.60}")
        return function(*positional, **named)

    if not any(map(_ARRAY.search, kinds.values())):
        return call

    @functools.wraps(function)
    def call_with_arrays(*positional: Any, **named: Any) -> Any:
        try:
            return call(*positional, **named)
        except Error:
            raise
        except (IndexError, TypeError, ValueError) as fault:  # what NumPy says of shapes
            raise error(f"{function.__name__} cannot take these arrays: {fault}") from fault

    return call_with_arrays


def _is_endless(default: Any) -> bool:
    values = default if isinstance(default, tuple) else (default,)
    return any(isinstance(each, float) and math.isinf(each) for each in values)


def _fault(value: Any, most: float, depth: int = 0) -> str | None:
    """Return what a value would have to be; None for one that can be."""
    if value is None or isinstance(value, bool):
        return None
    if isinstance(value, Integral):
        return None if abs(int(value)) <= MOST_INT else "less than 2^53"
    if isinstance(value, Real):
        number = float(value)
        return None if abs(number) <= most else f"a finite number up to {most:g}"
    if isinstance(value, str | Path):
        return None if can_be_written(str(value)) else "text of characters"
    if isinstance(value, np.ndarray):
        good = value.dtype.kind != "f" or not value.size or bool(np.abs(value).max() <= most)
        return None if good else f"finite numbers up to {most:g}"
    if isinstance(value, tuple | list | Mapping) and depth < _DEEPEST:
        inner = value.values() if isinstance(value, Mapping) else value
        return next((f for each in inner if (f := _fault(each, most, depth + 1))), None)
    return None


def _fault_of(kind: str, value: Any) -> str | None:
    """Return what a value of an annotation would have to be, besides."""
    if value is None:
        return None
    if kind in _LENGTHS:
        good = isinstance(value, tuple | list | np.ndarray) and len(value) == _LENGTHS[kind]
        return None if good and _is_floats(value) else f"{_LENGTHS[kind]} numbers"
    if "ArrayLike" in kind and not _is_floats(value):
        return "an array of numbers"
    return None


def _is_floats(value: Any) -> bool:
    try:
        array = np.asarray(value)
        if array.dtype.kind == "O":
            array = array.astype(float)
    except (TypeError, ValueError, OverflowError):
        return False
    return array.dtype.kind in "biuf"
