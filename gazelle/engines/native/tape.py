"""Calls of kernels that are made one after another, again and again, without Python between."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.native.decorators import Function, kernel
from gazelle.engines.native.function import Native
from gazelle.engines.native.memory import call_at
from gazelle.engines.native.packing import Words

Call = tuple[Function, tuple[Any, ...]]
"""A kernel that returns nothing, and what it is called with."""


@kernel
def _play(calls: NDArray[np.int64], count: int) -> None:
    for _ in range(count):
        for i in range(calls.shape[0]):
            call_at(calls[i, 0], calls[i, 1])


class Tape:
    """Plays calls of kernels; it keeps their words, as most will be the same the next time."""

    def __init__(self) -> None:
        self._kept: list[tuple[Native, Words]] = []
        self._table = np.zeros((0, 2), np.int64)

    def play(self, calls: Sequence[Call], count: int) -> None:
        """Make all calls in order, ``count`` times; numbers stay, what is in arrays may change."""
        native = [(function, values) for function, values in calls if isinstance(function, Native)]
        if len(native) < len(calls):  # Python runs kernels
            for _ in range(count):
                for function, values in calls:
                    function(*values)
            return
        if len(calls) != len(self._kept) or not all(map(_takes, self._kept, calls)):
            self._kept = [(function, Words(values)) for function, values in native]
            rows = [(function.entry(words), words.address) for function, words in self._kept]
            self._table = np.array(rows, np.int64).reshape(-1, 2)
        _play(self._table, count)


def _takes(kept: tuple[Native, Words], call: Call) -> bool:
    return kept[0] is call[0] and kept[1].take(call[1])
