"""One uniform grid for statics and bodies.

A static is listed in every cell that it passes; a body is in the list of the one cell that
its origin is in, and lists are sorted by index. Cells at the border stand for all that is
outside, too. ``grid`` is (x and y of the lower left corner [m], side of a cell [m], columns,
rows).
"""

from __future__ import annotations

import math

from gazelle.engines.native import kernel, part
from gazelle.engines.planar.columns import CIRCLE, KIND, X0, X1, Y0, Y1
from gazelle.engines.planar.tables import Cells, Floats


@part
def place_in(value: float, corner: float, side: float, count: float) -> int:
    """Column or row of a coordinate."""
    f = math.floor((value - corner) / side)
    return int(min(max(f, 0.0), count - 1.0))


@part
def cell_of(grid: Floats, x: float, y: float) -> int:
    """The cell of a point."""
    column = place_in(x, grid[0], grid[2], grid[3])
    row = place_in(y, grid[1], grid[2], grid[4])
    return int(row * int(grid[3]) + column)


@part
def stretch(
    low: float, high: float, y0: float, y1: float, x0: float, x1: float,
) -> tuple[float, float]:  # fmt: skip
    """Where a segment is between two heights: its least and greatest x; (inf, -inf) if nowhere."""
    if (y0 < low and y1 < low) or (y0 > high and y1 > high):
        return math.inf, -math.inf
    t0, t1 = 0.0, 1.0
    dy = y1 - y0
    if dy != 0.0:
        a, b = (low - y0) / dy, (high - y0) / dy
        t0, t1 = max(min(a, b), 0.0), min(max(a, b), 1.0)
    xa, xb = x0 + t0 * (x1 - x0), x0 + t1 * (x1 - x0)
    return min(xa, xb), max(xa, xb)


@kernel
def list_statics(statics: Floats, grid: Floats, start: Cells, items: Cells, margin: float) -> None:
    """Count the statics of each cell into ``start``, or, once summed up, list them.

    Args:
        statics: Primitives, shape (n, PRIMITIVE).
        grid: As above.
        start: Shape (cells + 1,); where there are ``items``, the next free place of each cell.
        items: Indices of statics; of length 0 to count.
        margin: By which cells are larger than they are [m].
    """
    columns, side = int(grid[3]), grid[2]
    for s in range(statics.shape[0]):
        row = statics[s]
        x0, y0, x1, y1 = row[X0], row[Y0], row[X1], row[Y1]
        circle = int(row[KIND]) % 2 == int(CIRCLE)
        if circle:
            radius = x1
            x0, x1 = x0 - radius, x0 + radius
            y0, y1 = y0 - radius, y0 + radius
        first = place_in(min(y0, y1) - margin, grid[1], side, grid[4])
        last = place_in(max(y0, y1) + margin, grid[1], side, grid[4])
        for r in range(first, last + 1):
            lo, hi = min(x0, x1), max(x0, x1)
            if not circle and first < last:
                low = grid[1] + r * side - margin if r > 0 else -math.inf
                high = grid[1] + (r + 1) * side + margin if r < grid[4] - 1 else math.inf
                lo, hi = stretch(low, high, y0, y1, x0, x1)
            if hi < lo:
                continue
            left = place_in(lo - margin, grid[0], side, grid[3])
            right = place_in(hi + margin, grid[0], side, grid[3])
            for c in range(left, right + 1):
                cell = r * columns + c
                if items.size > 0:
                    items[start[cell]] = s
                start[cell] += 1


@part
def link(head: Cells, follow: Cells, body: int, cell: int) -> None:
    """Put a body into the sorted list of a cell."""
    at = head[cell]
    if at < 0 or body < at:
        follow[body] = at
        head[cell] = body
        return
    while follow[at] >= 0 and follow[at] < body:
        at = follow[at]
    follow[body] = follow[at]
    follow[at] = body


@part
def unlink(head: Cells, follow: Cells, body: int, cell: int) -> None:
    """Take a body out of the list of a cell."""
    at = head[cell]
    if at == body:
        head[cell] = follow[body]
        return
    while follow[at] != body:
        at = follow[at]
    follow[at] = follow[body]


@kernel
def relink(
    first: int, last: int, nbody: int, grid: Floats, pose: Floats, head: Cells, follow: Cells,
    cell: Cells,
) -> None:  # fmt: skip
    """Keep the lists right for bodies first to last, counted through all worlds."""
    for b in range(first, last):
        now = cell_of(grid, pose[b, 0], pose[b, 1])
        if now != cell[b]:
            world = b // nbody
            if cell[b] >= 0:
                unlink(head[world], follow, b, cell[b])
            link(head[world], follow, b, now)
            cell[b] = now
