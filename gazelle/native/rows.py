"""Rows of arrays, for loops that compilers make one for several numbers at a time.

Compiled modules take what ``rows.pxd`` says, which are addresses: a typed memory view takes four
lines of a processor's cache, an address an eighth of one. This is the same for Python that runs
sources. ``first_of_run`` is for both. Keep the array as long as its address.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterable
from typing import Any

import numpy as np

from gazelle.array_types import Floats


def start(array: Floats) -> Any:
    """Return the numbers of an array with two axes, row after row."""
    return array.reshape(-1)


block_start = start
"""The same of an array with three axes."""


def column(array: Floats) -> Any:
    """Return the numbers of an array with one axis."""
    return array


def offset(numbers: Any, first: int) -> Any:
    """Return numbers from one of them on."""
    if isinstance(numbers, np.ndarray):
        return numbers[first:]
    address = ctypes.addressof(numbers.contents) + 8 * first
    return ctypes.cast(address, ctypes.POINTER(ctypes.c_double))


bytes_start, bytes_offset, places_column = start, offset, column
"""The same of flags and of indices."""


def first_of_run(columns: Iterable[int]) -> int:
    """Return the first of some columns if they lie side by side in order; else -1."""
    places = [int(each) for each in columns]
    return places[0] if places and places == [*range(places[0], places[0] + len(places))] else -1
