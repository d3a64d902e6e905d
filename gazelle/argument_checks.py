"""Check of the arguments of functions that people call, before anything is computed with them.

An annotation says float, and NaN is one; it says str, and no name holds a null. What makes no sense
anywhere is refused here, in one place; ranges of their own are the functions' own business.
"""

from __future__ import annotations

import contextlib
import functools
import inspect
import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields, is_dataclass
from numbers import Integral, Real
from pathlib import Path
from typing import Any, TypeGuard, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Indices, Worlds
from gazelle.errors import Error
from gazelle.native.index_order import order_of
from gazelle_ros.base.argument_types import MOST_INT
from gazelle_ros.base.characters import can_be_written
from gazelle_ros.base.path_texts import can_be_path
from gazelle_ros.base.real_numbers import real

Decorated = TypeVar("Decorated", bound=Callable[..., Any])

MOST = 1e15
"""Greatest magnitude of a float: its square and cube are numbers, too."""
_DEEPEST = 4
_INDEX = np.dtype(np.intp)
_CHECKED: set[type] = set()
"""Classes with instances checked at creation."""
_WRAPPED: set[Any] = set()
"""Functions that check their arguments: a class that is checked leaves them as they are."""
_TRUSTED = {"from_dict", "restore"}
"""Methods that get what their own class made, such as a state with infinite costs."""
_ARRAY = re.compile(r"\b(ArrayLike|Floats\d*|Bools|Indices|Ints\d*)\b")
_TAKES_ARRAYS = re.compile(rf"{_ARRAY.pattern}|\b(Worlds|Picture|UInts\d*|NDArray|Bytes)\b")
_OF_SHAPES = (IndexError, OverflowError, TypeError, ValueError)
"""Errors of NumPy about arrays that do not fit."""
_OF_VALUES = (ArithmeticError, IndexError, MemoryError, TypeError, ValueError)
"""Errors that a wrong value leads to in functions that compute first."""
_LENGTHS = {"Vector3": 3, "Vector": 3, "Range": 2, "Color": 4, "Quaternion": 4}
"""Numbers in a value of these annotations."""
_MORE = re.compile(r"ArrayLike|\bPath(Like)?\b")
_ROWS = re.compile(r"(?:Sequence|Iterable|list|tuple)\[(tuple\[.*?\])(?:, \.\.\.)?\]")
_ROW = re.compile(r"tuple\[((?:float|int)(?:, (?:float|int))*)\]")


def checked(
    error: type[Error], *, most: float = MOST, after: bool = False
) -> Callable[[Decorated], Decorated]:
    """Return a decorator of a function, or of what a class has in public, that refuses arguments.

    Floats, also those in tuples, lists, mappings, arrays, poses and dataclasses, must be finite and
    not huge, unless the default is infinite; ints of 64 bits; texts without nulls
    and surrogates; vectors of as many numbers as their annotation says.

    Args:
        error: Raised for such an argument, and for arrays of shapes that do not fit.
        most: Greatest magnitude of a float.
        after: Look at the arguments only after the call has failed, for what is called each step:
            that takes 0.1 us. Numbers pass that can be computed with, such as NaN. Constructors
            check first nevertheless, but for those of measurements.
    """

    def checking(function: Any, *, first: bool = False) -> Any:
        return _checking(function, error, most, first=first or not after, after=after)

    def decorate(decorated: Decorated) -> Decorated:
        if isinstance(decorated, type):
            _decorate_members(decorated, checking)
            if not after:
                _CHECKED.add(decorated)
            return decorated
        function: Decorated = checking(decorated)
        return function

    return decorate


def world_indices(worlds: Any, nworld: int, error: type[Error]) -> Worlds:
    """Return indices of worlds, shape (n,).

    Args:
        worlds: Given by a user.
        nworld: Number of worlds.
        error: Class of the error.

    Raises:
        Error: There is no such world, or they are not ints; of the given class.
    """
    return indices("worlds", worlds, nworld, error)


def indices(what: str, selection: Any, count: int, error: type[Error]) -> Indices:
    """Return indices of things, shape (n,).

    Args:
        what: Name of the items, for the message.
        selection: Indices of a user.
        count: Number of items.
        error: Class of the error.

    Raises:
        Error: There is no such thing, or they are not ints; of the given class.
    """
    if are_indices(selection) and order_of(selection, count):
        return selection
    rows: NDArray[Any] = np.zeros((0, 0))
    with contextlib.suppress(ValueError):  # of rows of different lengths
        rows = np.asarray(selection)
    if rows.ndim != 1 or (rows.size and rows.dtype.kind not in "iu"):
        raise error(f"{what} must be ints, not {selection!r:.60}")
    if rows.size and not 0 <= rows.min() <= rows.max() < count:
        raise error(f"{what} must be from 0 to {count - 1}, not {selection!r:.60}")
    return rows.astype(np.intp, copy=False)


def are_indices(selection: Any) -> TypeGuard[Indices]:
    """Return whether a selection is an array of indices, shape (n,), maybe of things that are not there."""
    return type(selection) is np.ndarray and selection.dtype is _INDEX and selection.ndim == 1


def _decorate_members(kind: type, checking: Callable[..., Any]) -> None:
    given = not _has_arrays(kind)
    for name, member in list(vars(kind).items()):
        if name not in ("__init__", "__getitem__") and (name[0] == "_" or name in _TRUSTED):
            continue
        if hasattr(member, "__code__") and member not in _WRAPPED:  # compiled ones too
            setattr(kind, name, checking(member, first=given and name == "__init__"))
        elif isinstance(member, classmethod | staticmethod):
            setattr(kind, name, type(member)(checking(member.__func__)))
        elif isinstance(member, property) and member.fset is not None:
            setattr(kind, name, member.setter(checking(member.fset)))


def _checking(function: Any, error: type[Error], most: float, *, first: bool, after: bool) -> Any:
    """Return the function with a check of its arguments; see `checked`.

    Args:
        function: Function to wrap.
        error: Raised for an invalid argument.
        most: Largest magnitude of a number.
        first: Whether to check before the call, rather than only when it fails.
        after: Whether to turn Python's errors for wrong values into ``error``.
    """
    parameters = inspect.signature(function).parameters
    passed = {"seed", "self"}
    if function.__name__ == "__init__":
        passed |= {n for n, each in parameters.items() if each.annotation == "Values"}
    look = _look_at(parameters, error, most, passed)
    arrays = any(_TAKES_ARRAYS.search(str(each.annotation)) for each in parameters.values())
    failures: tuple[type[Exception], ...] = _OF_VALUES if after else _OF_SHAPES if arrays else ()

    @functools.wraps(function)
    def call(*positional: Any, **named: Any) -> Any:
        if first:
            look(positional, named)
        try:
            return function(*positional, **named)
        except Error:
            raise
        except failures as failure:
            if not first:
                look(positional, named)
            raise _explained(function, failure, error) from failure

    _WRAPPED.add(call)
    return call


def _look_at(
    parameters: Mapping[str, inspect.Parameter], error: type[Error], most: float, passed: set[str]
) -> Callable[..., None]:
    """Return a function that raises an error if one of its arguments is invalid.

    It skips ``passed``: a seed, which may have 128 bits, the object of a method, and parameters of a
    constructor that its settings check.
    """
    order = [name for name, each in parameters.items() if each.kind != each.KEYWORD_ONLY]
    rules = {
        name: (
            math.inf if _is_endless(each.default) else most,
            _kind_of(str(each.annotation).removesuffix(" | None")),
        )
        for name, each in parameters.items()
    }
    rest = (most, "")  # of a keyword that goes into ``**options``

    def look(positional: tuple[Any, ...], named: Mapping[str, Any]) -> None:
        for name, value in (*zip(order, positional, strict=False), *named.items()):
            if value is None or name in passed:
                continue
            limit, kind = rules.get(name, rest)
            fault = _fault(value, limit) or (_fault_of(kind, value) if kind else None)
            if fault is not None:
                raise error(f"'{name}' must be {fault}, not {value!r:.60}")

    return look


def _explained(function: Any, failure: Exception, error: type[Error]) -> Exception:
    """Return an error for what Python or NumPy says of values."""
    if failure.__traceback__ is None or failure.__traceback__.tb_next is None:
        return TypeError(str(failure))  # the call itself did not fit
    return error(f"{function.__name__} cannot take these values: {failure}")


def _kind_of(annotation: str) -> str:
    """Return an annotation, if it says more of a value than that it is finite; else nothing."""
    rows = _ROWS.fullmatch(annotation)
    vector = _length(rows[1] if rows else annotation) is not None
    return annotation if vector or _MORE.search(annotation) else ""


def _is_endless(default: Any) -> bool:
    values = default if isinstance(default, tuple) else (default,)
    return any(isinstance(each, float) and math.isinf(each) for each in values)


def _fault(value: Any, most: float, depth: int = 0) -> str | None:
    """Return what a value would have to be; None for one that can be."""
    kind = type(value)
    if value is None or kind is bool or kind in _CHECKED:
        return None
    if kind is float:  # as most are; the classes of numbers below are slow to ask
        return None if abs(value) <= most else _limited(most, many=depth > 0)
    if isinstance(value, str | Path):
        return None if can_be_written(str(value)) else "text of characters"
    if isinstance(value, np.ndarray):
        return None if _is_within(value, most) else _limited(most, many=True)
    if kind is int or isinstance(value, Integral):
        return None if abs(int(value)) <= MOST_INT else "less than 2^63"
    if isinstance(value, Real):
        number = real(value)
        good = number is not None and abs(number) <= most
        return None if good else _limited(most, many=depth > 0)
    if depth < _DEEPEST:
        inner = _inside(value)
        return next((f for each in inner if (f := _fault(each, most, depth + 1))), None)
    return None


def _is_within(array: Any, most: float) -> bool:
    if array.dtype.kind != "f" or not array.size:
        return True
    if array.dtype == np.float64 and np.vdot(array, array) <= most * most:
        return True  # one pass, as most arrays are
    return bool(np.abs(array).max() <= most)


def _limited(most: float, *, many: bool) -> str:
    if math.isinf(most):
        return "numbers" if many else "a number"
    return f"{'finite numbers' if many else 'a finite number'} up to {most:g} in magnitude"


def _inside(value: Any) -> Iterable[Any]:
    """Return the items of a container that have to be checked too."""
    if isinstance(value, tuple | list):
        return value
    if isinstance(value, Mapping):
        return value.values()
    kind: Any = type(value)
    return [getattr(value, name) for name in _number_fields(kind)]


@functools.cache
def _number_fields(kind: type) -> tuple[str, ...]:
    """Return the attributes of a class that may not hold infinite numbers.

    Those are numbers of poses and of dataclasses without arrays. With arrays it is a measurement,
    such as a scan, with infinite ranges where nothing is near.
    """
    if isinstance(getattr(kind, "numbers", None), property):
        return ("numbers",)
    if not is_dataclass(kind) or _has_arrays(kind):
        return ()
    return tuple(each.name for each in fields(kind) if not _is_endless(each.default))


def _has_arrays(kind: type) -> bool:
    members = fields(kind) if is_dataclass(kind) else ()
    return any(_ARRAY.search(str(each.type)) for each in members)


def _fault_of(kind: str, value: Any) -> str | None:
    """Return what a value of an annotation would have to be, besides."""
    if value is None:  # in a sequence
        return None
    row = _row_of(kind)
    if row and isinstance(value, tuple | list):
        fault = next((f for each in value if (f := _fault_of(row, each))), None)
        return fault and f"rows of {fault}"
    length = _length(kind)
    if length is not None:
        good = isinstance(value, tuple | list | np.ndarray) and len(value) == length
        return None if good and _is_floats(value) else f"{length} numbers"
    if "Path" in kind and isinstance(value, str | Path):
        return None if can_be_path(value) else "a path that a file can have"
    named = ("Mapping" in kind and isinstance(value, Mapping)) or (
        "str" in kind and isinstance(value, str)
    )
    if "ArrayLike" in kind and not named and not _is_floats(value):
        return "an array of numbers"
    return None


@functools.cache
def _row_of(kind: str) -> str | None:
    """Return the annotation of a row; None where it is not one of rows."""
    rows = _ROWS.fullmatch(kind)
    return rows and rows[1]


@functools.cache
def _length(kind: str) -> int | None:
    """Return the numbers in a value of an annotation; None where it is not a vector."""
    row = _ROW.fullmatch(kind)
    return _LENGTHS.get(kind) if row is None else len(row[1].split(","))


def _is_floats(value: Any) -> bool:
    if type(value) is tuple and all(type(each) is float for each in value):
        return True
    try:
        array = np.asarray(value)
        if array.dtype.kind == "O":
            array = array.astype(float)
    except (TypeError, ValueError, OverflowError):
        return False
    return array.dtype.kind in "biuf"
