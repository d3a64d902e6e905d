"""Check of the numbers of a recipe by what its fields are declared to be."""

from __future__ import annotations

import dataclasses
import math
import operator
from collections.abc import Mapping
from typing import Any

from gazelle.errors import TaskError

_MOST = 2**53
"""More is not a number that JSON keeps."""
MAX_WIDTH = 2**16
"""Neurons of a hidden layer."""
MAX_LAYERS = 100
_FROM_ZERO = frozenset({"learning_starts", "angles"})
"""Whole numbers that may be 0."""


def check_numbers(values: Any) -> None:
    """Check the fields of a dataclass.

    Raises:
        TaskError: One is not a number where it must be, is negative, or is too large.
    """
    for each in dataclasses.fields(values):
        value, kind = getattr(values, each.name), str(each.type)
        if value is None and kind.endswith("| None"):
            continue
        kind = kind.removesuffix(" | None")
        if kind == "int":
            _check_integer(each.name, value, _MOST)
        elif kind == "float":
            _check_real(each.name, value)
        elif kind == "str" and not isinstance(value, str):
            raise TaskError(f"{each.name} must be text, not {value!r:.60}")
        elif kind == "bool" and not isinstance(value, bool):
            raise TaskError(f"{each.name} must be true or false, not {value!r}")
        elif kind == "tuple[int, ...]":
            _check_sizes(each.name, value)
        elif kind.startswith("Mapping") and not isinstance(value, Mapping):
            raise TaskError(f"{each.name} must be names with values, not {value!r}")


def _check_integer(name: str, value: Any, most: int) -> None:
    least = 0 if name in _FROM_ZERO else 1
    try:
        fits = not isinstance(value, bool) and least <= operator.index(value) <= most
    except TypeError:
        fits = False
    if not fits:
        raise TaskError(f"{name} must be an int from {least} to {most}, not {value!r:.60}")


def _check_real(name: str, value: Any) -> None:
    try:
        fits = not isinstance(value, bool | str) and 0.0 <= float(value) < math.inf
    except (TypeError, ValueError, OverflowError):
        fits = False
    if not fits:
        raise TaskError(f"{name} must be a finite number, 0 or more, not {value!r:.60}")


def _check_sizes(name: str, values: Any) -> None:
    if not isinstance(values, tuple) or len(values) > MAX_LAYERS:
        raise TaskError(f"{name} must be up to {MAX_LAYERS} ints, not {values!r:.60}")
    for value in values:
        _check_integer(name, value, MAX_WIDTH)
