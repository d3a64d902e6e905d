"""In which bins of place and heading poses are, how many bins that are, and which of them touch.

What adaptive particle numbers and clusters are made of: see `particle_filter`.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np
from cython.cimports.libc.math import floor

from gazelle.array_types import Floats, Indices


@cython.cclass
class PoseBins:
    """Poses by bins, in a hash table with open addressing.

    Args:
        poses: x, y [m] and heading [rad], shape (n, 3), n at least 1.
        side: Of a bin along x and y [m].
        turn: Of a bin [rad].
    """

    _bins: cython.Py_ssize_t[::1]
    _places: cython.longlong[:, ::1]
    _slots: cython.Py_ssize_t[::1]
    _count: cython.Py_ssize_t

    def __init__(self, poses: Floats, side: float, turn: float) -> None:
        size = 1 << (2 * len(poses)).bit_length()
        self._bins = np.empty(len(poses), np.intp)
        self._places = np.empty((len(poses), 3), np.int64)
        self._slots = np.full(size, -1, np.intp)
        self._count = 0
        self._sort(poses, side, turn)

    @property
    def count(self) -> int:
        """Number of occupied bins."""
        return int(self._count)

    def counts(self) -> Indices:
        """Return the number of bins of the first pose, the first two, ..., shape (n,)."""
        # Bins are numbered as they come.
        highest: Indices = np.maximum.accumulate(np.asarray(self._bins)) + 1
        return highest

    def clusters(self) -> Indices:
        """Return the cluster of each pose: bins that touch, at corners too, are one.

        Shape (n,).
        """
        labels = np.full(self._count, -1, np.intp)
        self._join(labels, np.empty(self._count, np.intp))
        found: Indices = labels[np.asarray(self._bins)]
        return found

    @cython.cfunc
    @cython.exceptval(check=False)
    def _sort(
        self, poses: cython.double[:, ::1], side: cython.double, turn: cython.double
    ) -> cython.void:
        n: cython.Py_ssize_t
        for n in range(poses.shape[0]):
            x: cython.longlong = cython.cast(cython.longlong, floor(poses[n, 0] / side))
            y: cython.longlong = cython.cast(cython.longlong, floor(poses[n, 1] / side))
            heading: cython.longlong = cython.cast(cython.longlong, floor(poses[n, 2] / turn))
            slot: cython.Py_ssize_t = self._slot(x, y, heading)
            if self._slots[slot] < 0:
                self._slots[slot] = self._count
                self._places[self._count, 0] = x
                self._places[self._count, 1] = y
                self._places[self._count, 2] = heading
                self._count += 1
            self._bins[n] = self._slots[slot]

    @cython.cfunc
    @cython.exceptval(check=False)
    def _slot(
        self, x: cython.longlong, y: cython.longlong, heading: cython.longlong
    ) -> cython.Py_ssize_t:
        """Return the index of a bin in the hash table, or of the free slot for it."""
        mask: cython.Py_ssize_t = self._slots.shape[0] - 1
        # Neighbours come apart; three primes without meaning.
        slot: cython.Py_ssize_t = (x * 73856093 ^ y * 19349663 ^ heading * 83492791) & mask
        while True:
            known: cython.Py_ssize_t = self._slots[slot]
            if known < 0 or (
                self._places[known, 0] == x
                and self._places[known, 1] == y
                and self._places[known, 2] == heading
            ):
                return slot
            slot = (slot + 1) & mask

    @cython.cfunc
    @cython.exceptval(check=False)
    def _join(self, labels: cython.Py_ssize_t[::1], front: cython.Py_ssize_t[::1]) -> cython.void:
        """Flood-fill from each bin without a label."""
        seed: cython.Py_ssize_t
        side: cython.int
        label: cython.Py_ssize_t = 0
        for seed in range(self._count):
            if labels[seed] >= 0:
                continue
            labels[seed] = label
            front[0] = seed
            waiting: cython.Py_ssize_t = 1
            while waiting:
                waiting -= 1
                here: cython.Py_ssize_t = front[waiting]
                for side in range(27):
                    other: cython.Py_ssize_t = self._slots[
                        self._slot(
                            self._places[here, 0] + side // 9 - 1,
                            self._places[here, 1] + side // 3 % 3 - 1,
                            self._places[here, 2] + side % 3 - 1,
                        )
                    ]
                    if other >= 0 and labels[other] < 0:
                        labels[other] = label
                        front[waiting] = other
                        waiting += 1
            label += 1
