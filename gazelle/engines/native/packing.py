"""Values of a call as a row of words of 64 bits, which is what machine code reads."""

from __future__ import annotations

import ctypes
from itertools import accumulate
from operator import is_
from typing import Any

import numpy as np

from gazelle.engines.native.kinds import BITS, REAL, RESULTS, TRUTH, Array, Group, Kind, kind_of
from gazelle.errors import EngineError


def spread(values: tuple[Any, ...]) -> list[Any]:
    """Values with what is in tuples in the place of the tuples."""
    if tuple not in map(type, values):
        return list(values)
    row: list[Any] = []
    for value in values:
        if type(value) is tuple:
            row.extend(spread(value))
        else:
            row.append(value)
    return row


class Words:
    """The words of a call, kept for the next one: most of its values will be the same.

    Args:
        values: Of the call.

    Attributes:
        address: Of the words.
        kinds: Of the values.
    """

    def __init__(self, values: tuple[Any, ...]) -> None:
        self.kinds: tuple[Kind, ...] = tuple(kind_of(value) for value in values)
        self._given, self._values = values, spread(values)
        sizes = [len(spread((value,))) for value in values]
        self._ranges = list(accumulate(sizes, initial=0))
        self._kinds = [kind_of(value) for value in self._values]
        self._places, size = [], 0
        for kind in self._kinds:
            self._places.append(size)
            size += 1 + kind.axes if isinstance(kind, Array) else 1
        self._results = size
        size += RESULTS  # words after the values, for what comes out
        self._wholes = (ctypes.c_int64 * size)()
        self._reals = (ctypes.c_double * size).from_buffer(self._wholes)
        self.address = ctypes.addressof(self._wholes)
        for place, kind, value in zip(self._places, self._kinds, self._values, strict=True):
            self._write(place, kind, value)

    def take(self, values: tuple[Any, ...]) -> bool:
        """Change to other values; False if they are of other kinds."""
        if len(values) != len(self._given):
            return False
        for number, same in enumerate(map(is_, self._given, values)):
            if not same and not self._put(number, values[number]):
                return False
        self._given = values
        return True

    def _put(self, number: int, value: Any) -> bool:
        """Change one of the values given; False if it is of another kind."""
        first, last = self._ranges[number], self._ranges[number + 1]
        if type(value) is not tuple:
            return last == first + 1 and self._change(first, value)
        row = spread(value)
        if len(row) != last - first:
            return False
        for place, same in enumerate(map(is_, self._values[first:last], row), first):
            if not same and not self._change(place, row[place - first]):
                return False
        return True

    def _change(self, number: int, new: Any) -> bool:
        """Write another value in a place; False if it is of another kind."""
        old, kind = self._values[number], self._kinds[number]
        if type(new) is not type(old) or isinstance(kind, Array):
            its = kind_of(new)
            if its is not kind and its != kind:
                return False
        self._write(self._places[number], kind, new)
        self._values[number] = new
        return True

    def _write(self, place: int, kind: Kind, value: Any) -> None:
        if isinstance(kind, Array):
            self._wholes[place] = value.__array_interface__["data"][0]
            for axis, size in enumerate(value.shape, place + 1):
                self._wholes[axis] = size
        elif kind == REAL:
            self._reals[place] = value
        elif kind == BITS:
            self._wholes[place] = int(np.int64(np.uint64(value).astype(np.int64)))
        else:
            whole = int(value)
            if whole >> 63 not in (0, -1):
                raise EngineError(f"{value} does not fit 64 bits with a sign")
            self._wholes[place] = whole

    def result(self, kind: Kind) -> Any:
        """What the call has written."""
        if isinstance(kind, Group):
            return tuple(self._number(n, part) for n, part in enumerate(kind.parts, self._results))
        return self._number(self._results, kind)

    def _number(self, place: int, kind: Kind) -> Any:
        if kind == REAL:
            return self._reals[place]
        if kind == TRUTH:
            return bool(self._wholes[place] & 1)
        if kind == BITS:
            return np.uint64(self._wholes[place] & 0xFFFFFFFFFFFFFFFF)
        return self._wholes[place]
