# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""One uniform grid for statics and bodies.

A static is listed in every cell that it passes; a body is in the list of the one cell that
its origin is in, and lists are sorted by index. Cells at the border stand for all that is
outside, too. ``grid`` is (x and y of the lower left corner [m], side of a cell [m], columns,
rows).
"""

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import CIRCLE, KIND, X0, X1, Y0, Y1, X, Y
from cython.cimports.libc.math import floor

from gazelle.array_types import Floats, Indices, Ints32, Worlds

INFINITE = float("inf")


def place_in(value: float, corner: float, side: float, count: float) -> int:
    """Return the column or row of a coordinate."""
    return cython.cast(
        cython.Py_ssize_t, min(max(floor((value - corner) / side), 0.0), count - 1.0)
    )


def cell_of(grid: Floats, x: float, y: float) -> int:
    """Return the cell of a point."""
    column = place_in(x, grid[0], grid[2], grid[3])
    row = place_in(y, grid[1], grid[2], grid[4])
    return row * cython.cast(cython.Py_ssize_t, grid[3]) + column


def stretch(
    low: float, high: float, y0: float, y1: float, x0: float, x1: float
) -> tuple[float, float]:
    """Return the least and greatest x of a segment between two heights; (inf, -inf) if none."""
    if (y0 < low and y1 < low) or (y0 > high and y1 > high):
        return INFINITE, -INFINITE
    t0, t1 = 0.0, 1.0
    dy = y1 - y0
    if dy != 0.0:
        a, b = (low - y0) / dy, (high - y0) / dy
        t0, t1 = max(min(a, b), 0.0), min(max(a, b), 1.0)
    xa, xb = x0 + t0 * (x1 - x0), x0 + t1 * (x1 - x0)
    return min(xa, xb), max(xa, xb)


def list_statics(
    statics: Floats, grid: Floats, start: Ints32, items: Ints32, margin: float
) -> None:
    """Count the statics of each cell into ``start``, or, once summed up, list them.

    Args:
        statics: Primitives, shape (n, PRIMITIVE).
        grid: As above.
        start: Shape (cells + 1,); where there are ``items``, the next free place of each cell.
        items: Indices of statics; of length 0 to count.
        margin: By which cells are larger than they are [m].
    """
    columns, side = cython.cast(cython.Py_ssize_t, grid[3]), grid[2]
    for s in range(statics.shape[0]):
        x0, y0, x1, y1 = statics[s, X0], statics[s, Y0], statics[s, X1], statics[s, Y1]
        circle = cython.cast(cython.int, statics[s, KIND]) % 2 == CIRCLE
        if circle:
            radius = x1
            x0, x1 = x0 - radius, x0 + radius
            y0, y1 = y0 - radius, y0 + radius
        first = place_in(min(y0, y1) - margin, grid[1], side, grid[4])
        last = place_in(max(y0, y1) + margin, grid[1], side, grid[4])
        for r in range(first, last + 1):
            lo, hi = min(x0, x1), max(x0, x1)
            if not circle and first < last:
                low = grid[1] + r * side - margin if r > 0 else -INFINITE
                high = grid[1] + (r + 1) * side + margin if r < grid[4] - 1 else INFINITE
                lo, hi = stretch(low, high, y0, y1, x0, x1)
            if hi < lo:
                continue
            left = place_in(lo - margin, grid[0], side, grid[3])
            right = place_in(hi + margin, grid[0], side, grid[3])
            for c in range(left, right + 1):
                cell = r * columns + c
                if items.shape[0] > 0:
                    items[start[cell]] = s
                start[cell] += 1


def link(w: Bodies, world: int, body: int, cell: int) -> None:
    """Insert a body into the sorted list of a cell."""
    at = w.head[world, cell]
    if at < 0 or body < at:
        w.follow[body] = at
        w.head[world, cell] = body
        return
    while w.follow[at] >= 0 and w.follow[at] < body:
        at = w.follow[at]
    w.follow[body] = w.follow[at]
    w.follow[at] = body


def unlink(w: Bodies, world: int, body: int, cell: int) -> None:
    """Remove a body from the list of a cell."""
    at = w.head[world, cell]
    if at == body:
        w.head[world, cell] = w.follow[body]
        return
    while w.follow[at] != body:
        at = w.follow[at]
    w.follow[at] = w.follow[body]


def relink_one(w: Bodies, b: int) -> None:
    """Update the lists for one body, counted through all worlds."""
    now = cell_of(w.grid, w.rows[b, X], w.rows[b, Y])
    before = w.cell[b]
    if now != before:
        world = b // w.nbody
        if before >= 0:
            unlink(w, world, b, before)
        link(w, world, b, now)
        w.cell[b] = now


def relink(w: Bodies, first: int, last: int) -> None:
    """Update the lists for bodies first to last, counted through all worlds."""
    for b in range(first, last):
        relink_one(w, b)


def relink_some(w: Bodies, which: Indices) -> None:
    """Update the lists for some bodies, shape (n,)."""
    for i in range(which.shape[0]):
        relink_one(w, which[i])


def put_back(w: Bodies, worlds: Worlds, initial: Floats) -> None:
    """Reset all bodies of some worlds, shape (n,), to rows of a world, at rest."""
    for i in range(worlds.shape[0]):
        for k in range(w.nbody):
            b = worlds[i] * w.nbody + k
            for c in range(initial.shape[1]):
                w.rows[b, c] = initial[k, c]
            for axis in range(3):
                w.command[b, axis] = w.velocity[b, axis] = 0.0
            w.stalled[b] = 0
            relink_one(w, b)
