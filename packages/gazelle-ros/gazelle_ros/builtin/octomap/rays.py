"""Cells that rays cross (J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm", 1987)."""

from __future__ import annotations

import numpy as np

from gazelle_ros.base.array_types import Floats, Ints64

_MOST_MARKED = 1 << 27
"""Cells around all rays that are marked one by one; more are collected."""


def crossed(origin: Floats, ends: Floats) -> Ints64:
    """Return the cells that rays cross before the one of their end, each once; shape (n, 3).

    Args:
        origin: Of all rays, in sides of a cell, shape (3,).
        ends: Likewise, shape (rays, 3).
    """
    if not len(ends):
        return np.zeros((0, 3), np.int64)
    first, last = np.floor(origin).astype(np.int64), np.floor(ends).astype(np.int64)
    low = np.minimum(first, last.min(axis=0))
    size = np.maximum(first, last.max(axis=0)) - low + 1
    found = _Marks(size) if size.prod() <= _MOST_MARKED else _Collection()
    _follow(origin, ends, np.array([size[1] * size[2], size[2], 1]), low, found)
    cells: Ints64 = np.stack(np.unravel_index(found.indices(), size), axis=-1) + low
    return cells


class _Marks:
    """Cells of a box, marked."""

    def __init__(self, size: Ints64) -> None:
        self._marked = np.zeros(int(size.prod()), np.bool_)

    def add(self, indices: Ints64) -> None:
        self._marked[indices] = True

    def indices(self) -> Ints64:
        return np.flatnonzero(self._marked)


class _Collection:
    """Cells of a box that is too large to be marked."""

    def __init__(self) -> None:
        self._parts: list[Ints64] = []

    def add(self, indices: Ints64) -> None:
        self._parts.append(np.unique(indices))

    def indices(self) -> Ints64:
        return np.unique(np.concatenate(self._parts or [np.zeros(0, np.int64)]))


def _follow(
    origin: Floats, ends: Floats, strides: Ints64, low: Ints64, found: _Marks | _Collection
) -> None:
    """Add the cells of all rays, one after another along each, all rays at once."""
    first = np.floor(origin)
    left = np.abs(np.floor(ends) - first).astype(np.int64)
    order = np.argsort(-left.sum(axis=1))  # those with the most cells first: the others end before
    steps = left.sum(axis=1)[order]
    # A row an axis, as the least of three rows is found faster than that of each row's three.
    left, ways = np.ascontiguousarray(left[order].T), np.ascontiguousarray((ends - origin)[order].T)
    begin = (origin - first)[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        apart = np.abs(1.0 / ways)
        times = np.where(left > 0, np.where(ways > 0.0, 1.0 - begin, begin) * apart, np.inf)
    moves = np.where(ways > 0.0, strides[:, None], -strides[:, None])
    index = np.full(len(ends), int(((first.astype(np.int64) - low) * strides).sum()))
    rays = np.arange(len(ends))
    for step in range(int(steps[0])):
        count = int(np.searchsorted(-steps, -step))  # rays with more steps than this
        found.add(index[:count])
        place = times[:, :count].argmin(axis=0), rays[:count]
        index[:count] += moves[place]
        left[place] -= 1
        times[place] = np.where(left[place] > 0, times[place] + apart[place], np.inf)
