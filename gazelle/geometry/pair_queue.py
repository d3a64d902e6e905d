# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""A queue of pairs, the smallest first, whose pairs change place when their size does."""

from __future__ import annotations

import cython
import numpy as np


@cython.final
@cython.cclass
class PairQueue:
    """A binary heap of pairs that go by their rows.

    Of pairs of one size the one with the lesser numbers comes first.

    Args:
        count: Rows that there are.

    Attributes:
        length: Pairs in the queue.
    """

    def __init__(self, count: int) -> None:
        self.length = 0
        self.heap = np.zeros(count, np.int32)
        self.place = np.full(count, -1, np.int32)
        self.size = np.zeros(count)
        self.numbers = np.zeros((count, 2), np.int32)

    def push(self, pair: int, size: float, one: int, other: int) -> None:
        """Add a pair that is not in the queue, with its size and its numbers."""
        self.size[pair] = size
        self.numbers[pair, 0], self.numbers[pair, 1] = one, other
        self.length += 1
        self.rise(self.length - 1, pair)

    def pop(self) -> int:
        """Remove the first pair of a queue that is not empty, and return it."""
        pair = self.heap[0]
        self.remove(pair)
        return pair

    def remove(self, pair: int) -> None:
        """Remove a pair, if it is in the queue."""
        place = self.place[pair]
        if place < 0:
            return
        self.place[pair] = -1
        self.length -= 1
        if place < self.length:
            last = self.heap[self.length]
            self.rise(place, last)
            self.sink(self.place[last], last)

    def is_before(self, one: int, other: int) -> bool:
        """Return whether a pair comes before another."""
        if self.size[one] != self.size[other]:
            return self.size[one] < self.size[other]
        if self.numbers[one, 0] != self.numbers[other, 0]:
            return self.numbers[one, 0] < self.numbers[other, 0]
        return self.numbers[one, 1] < self.numbers[other, 1]

    def rise(self, place: int, pair: int) -> None:
        """Move a pair to a place, or above it."""
        while place > 0:
            above = (place - 1) // 2
            if not self.is_before(pair, self.heap[above]):
                break
            self.put(place, self.heap[above])
            place = above
        self.put(place, pair)

    def sink(self, place: int, pair: int) -> None:
        """Move a pair to a place, or below it."""
        while 2 * place + 1 < self.length:
            below = 2 * place + 1
            if below + 1 < self.length and self.is_before(self.heap[below + 1], self.heap[below]):
                below += 1
            if not self.is_before(self.heap[below], pair):
                break
            self.put(place, self.heap[below])
            place = below
        self.put(place, pair)

    def put(self, place: int, pair: int) -> None:
        """Write a pair to a place."""
        self.heap[place] = pair
        self.place[pair] = place
