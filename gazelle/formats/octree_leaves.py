"""Occupied leaves in the data of an OctoMap octree, compiled.

Both forms are depth first, children in the order of their bits (1 for the half with the greater x,
2 for y, 4 for z), as OctoMap 1.9 writes them. ``writeBinaryData``: a node with children is 16 bits,
two a child: 0 unknown, 1 free, 2 occupied, 3 with children of its own. ``writeData``: a node is
its log-odds of being occupied, a little-endian float32, then what else its class has, then a byte
with a bit for each child that is there.
"""

# mypy: disallow-untyped-decorators=False

import cython
import numpy as np

from gazelle.array_types import Bytes, Ints32

DEPTH = 16
"""Levels of an octree below its root."""

WHOLE, CUT_SHORT, TOO_DEEP, TOO_MANY = 0, 1, 2, 3

_DEPTH = cython.declare(cython.int, 16)
_END = cython.declare(cython.int, -1)
_UNKNOWN = cython.declare(cython.int, 0)
_FREE = cython.declare(cython.int, 1)
_OCCUPIED = cython.declare(cython.int, 2)
_PARENT = cython.declare(cython.int, 3)


def occupied_leaves(data: Bytes, record: int, most: int) -> tuple[int, int, Ints32]:
    """Find the occupied leaves: by the binary form, or with log-odds of at least 0.

    Args:
        data: Shape (n,).
        record: Bytes of a node before the one with its children; 0 is the binary form.
        most: Leaves, at most.

    Returns:
        How that went (``WHOLE``, ``CUT_SHORT``, ``TOO_DEEP``, ``TOO_MANY``), how many bytes were read,
        and of each leaf its lower corner from that of the octree and its edge, in finest leaves,
        shape (leaves, 4).
    """
    none = np.empty((0, 4), np.int32)
    counting = OctreeWalk(data, record, none)
    outcome = counting.walk()
    if outcome == WHOLE and counting.count > most:
        outcome = TOO_MANY
    if outcome != WHOLE:
        return outcome, int(counting.at), none
    leaves = np.empty((int(counting.count), 4), np.int32)
    OctreeWalk(data, record, leaves).walk()
    return outcome, int(counting.at), leaves


@cython.cclass
class OctreeWalk:
    """A walk through an octree, in the order of its data.

    A row of the stack is a node whose children are being walked through: its lower corner, the word
    that says what they are, and which of them is next.

    Args:
        data: Shape (n,).
        record: See ``occupied_leaves``.
        leaves: Array for them; the rest is left out, shape (leaves, 4).

    Attributes:
        count: Occupied leaves so far.
        at: Bytes so far.
    """

    count = cython.declare(cython.longlong, visibility="readonly")
    at = cython.declare(cython.longlong, visibility="readonly")
    _data: cython.uchar[::1]
    _leaves: cython.int[:, ::1]
    _stack: cython.int[:, ::1]
    _record: cython.int
    _level: cython.int
    _outcome: cython.int
    _x: cython.int
    _y: cython.int
    _z: cython.int
    _edge: cython.int

    def __init__(self, data: Bytes, record: int, leaves: Ints32) -> None:
        self._data, self._record, self._leaves = data, record, leaves
        self._stack = np.zeros((DEPTH, 5), np.int32)
        self.count = self.at = self._level = self._outcome = 0
        self._x = self._y = self._z = 0
        self._edge = 1 << _DEPTH

    def walk(self) -> int:
        """Walk the tree from the root to the end; returns the outcome."""
        self._walk()
        return int(self._outcome)

    @cython.cfunc
    def _walk(self) -> cython.void:
        kind: cython.int = _PARENT
        while kind != _END:
            if kind == _PARENT:
                kind = self._enter()
            if kind == _OCCUPIED:
                self._take()
            if kind != _END:
                kind = self._next()

    @cython.cfunc
    @cython.exceptval(check=False)
    def _enter(self) -> cython.int:
        """Read a node: what it is, if it is a leaf; its children are next otherwise."""
        start: cython.Py_ssize_t = self.at
        length: cython.int = 2 if self._record == 0 else self._record + 1
        if start + length > self._data.shape[0]:
            self._outcome = 1
            return _END
        word: cython.int = self._data[start + length - 1]
        if self._record == 0:
            word = (word << 8) | self._data[start]
        elif word == 0:
            self.at += length
            return _OCCUPIED if self._is_occupied(start) else _FREE
        if self._level == _DEPTH:
            self._outcome = 2
            return _END
        self.at += length
        self._stack[self._level, 0] = self._x
        self._stack[self._level, 1] = self._y
        self._stack[self._level, 2] = self._z
        self._stack[self._level, 3] = word
        self._stack[self._level, 4] = 0
        self._level += 1
        return _UNKNOWN

    @cython.cfunc
    @cython.exceptval(check=False)
    def _is_occupied(self, start: cython.Py_ssize_t) -> cython.bint:
        """Return whether the float32 at an offset is a number of at least zero."""
        magnitude: cython.uint = self._data[start + 3] & 127
        magnitude = (magnitude << 8) | self._data[start + 2]
        magnitude = (magnitude << 8) | self._data[start + 1]
        magnitude = (magnitude << 8) | self._data[start]
        return magnitude == 0 or (self._data[start + 3] < 128 and magnitude <= 0x7F800000)

    @cython.cfunc
    @cython.exceptval(check=False)
    def _take(self) -> cython.void:
        if self.count < self._leaves.shape[0]:
            self._leaves[self.count, 0] = self._x
            self._leaves[self.count, 1] = self._y
            self._leaves[self.count, 2] = self._z
            self._leaves[self.count, 3] = self._edge
        self.count += 1

    @cython.cfunc
    @cython.exceptval(check=False)
    def _next(self) -> cython.int:
        """Advance to the next child of the innermost node that has one left; returns its kind."""
        while self._level > 0 and self._stack[self._level - 1, 4] == 8:
            self._level -= 1
        if self._level == 0:
            return _END
        row: cython.int = self._level - 1
        child: cython.int = self._stack[row, 4]
        word: cython.int = self._stack[row, 3]
        self._stack[row, 4] = child + 1
        self._edge = 1 << (_DEPTH - self._level)
        self._x = self._stack[row, 0] + (child & 1) * self._edge
        self._y = self._stack[row, 1] + ((child >> 1) & 1) * self._edge
        self._z = self._stack[row, 2] + ((child >> 2) & 1) * self._edge
        if self._record == 0:
            return (word >> (2 * child)) & 3
        return _PARENT if (word >> child) & 1 else _UNKNOWN
