"""Draw many statics from the nearest cells on, so that what is hidden is not looked at.

Cells are taken in square rings around the sensor's own. A cell is left out where all beams that
could pass it have met something before it; when no beam gets as far as a ring, all is drawn. Cost
grows with what can be seen, not with what is within the beams' reach.
"""

# kernels take their arguments in order

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.planar.columns import FAMILY, REACH, S_COS, S_SIN, S_X, S_Y, S_Z
from gazelle.engines.planar.compiled import inner, kernel, part
from gazelle.engines.planar.kernels_fan import beams_in, cover
from gazelle.engines.planar.kernels_find import draw_found, find_statics
from gazelle.engines.planar.kernels_grid import place_in
from gazelle.engines.planar.kernels_scan import (
    aim,
    cells_of,
    clear,
    draw_view,
    put_view,
    report,
    rows_of,
)
from gazelle.engines.planar.kernels_walk import follow_beam
from gazelle.engines.planar.tables import Cells, Floats, Indices

LONELY = 5.0  # times rings: beams of which the rest are followed one by one
MANY = 256  # statics in view from which it pays to find out which ones are hidden
MARGIN = 1e-6  # by which cells are taken to be larger than they are [m]


@inner
def beyond(beams: Floats, lo: int, hi: int, inverse: float) -> int:
    """How many of beams lo to hi have met nothing nearer than one over ``inverse``."""
    open_ones = np.int64(0)
    for k in range(np.uint64(lo), np.uint64(hi)):
        open_ones += np.int64(1) if beams[2, k] < inverse else np.int64(0)
    return int(open_ones)


@inner
def note_cell(
    cells: Floats, n: int, reach: float, grid: Floats, start: Cells, column: int, row: int,
    sensors: Floats, m: int,
) -> int:  # fmt: skip
    """Write down a cell with anything in it as the n-th, as a disc around it; returns how many."""
    cell = row * int(grid[3]) + column
    if start[cell] == start[cell + 1]:
        return n
    side = grid[2]
    ox = grid[0] + (column + 0.5) * side - sensors[m, S_X]
    oy = grid[1] + (row + 0.5) * side - sensors[m, S_Y]
    half = 0.5 * side + MARGIN
    dx, dy = max(abs(ox) - half, 0.0), max(abs(oy) - half, 0.0)
    square = dx * dx + dy * dy
    if square > reach * reach:
        return n
    c, s = sensors[m, S_COS], sensors[m, S_SIN]
    cells[0, n], cells[1, n] = c * ox + s * oy, c * oy - s * ox
    cells[2, n], cells[3, n], cells[4, n] = 0.0, 0.0, 1.415 * half
    cells[7, n] = cell
    cells[8, n] = 1.0 / math.sqrt(square) if square > 0.0 else math.inf
    return n + 1


@inner
def can_be_seen(beams: Floats, fan: Floats, cells: Floats, i: int) -> bool:
    """Whether a beam may get to the i-th cell."""
    count = beams.shape[1]
    for turn in range(2):
        lo, hi = beams_in(fan, count, cells[5, i], cells[6, i], -turn)
        if lo < hi and beyond(beams, lo, hi, cells[8, i]) > 0:
            return True
    return False


@part
def draw_cells(
    beams: Floats, fan: Floats, cells: Floats, number: int, found: Floats, n: int,
    statics: Floats, start: Cells, items: Cells, stamp: Indices, height: float, x: float,
    y: float, cos: float, sin: float,
) -> int:  # fmt: skip
    """Write down what is in the cells that can be seen; returns how many are yet to be drawn."""
    cover(cells, number, fan)
    for i in range(number):
        if can_be_seen(beams, fan, cells, i):
            cell = int(cells[7, i])
            n = find_statics(
                beams, fan, found, n, statics, items, int(start[cell]), int(start[cell + 1]),
                stamp, height, x, y, cos, sin,
            )  # fmt: skip
    return n


@part
def follow_rest(
    beams: Floats, fan: Floats, sensors: Floats, m: int, grid: Floats, statics: Floats,
    start: Cells, items: Cells, near: float,
) -> None:  # fmt: skip
    """Follow the beams that have met nothing up to a distance."""
    for k in range(beams.shape[1]):
        if beams[2, k] * near < 1.0:
            follow_beam(beams, k, fan, sensors, m, grid, statics, start, items, near)


@part
def draw_nearest_first(
    beams: Floats, fan: Floats, found: Floats, cells: Floats, spans: Indices, bottom: int,
    top: int, sensors: Floats, m: int, grid: Floats, statics: Floats, start: Cells,
    items: Cells, stamp: Indices,
) -> None:  # fmt: skip
    """Draw all statics that can be seen in some rows, of each the cells in its span."""
    stamp[statics.shape[0]] += 1
    c, s, height = sensors[m, S_COS], sensors[m, S_SIN], sensors[m, S_Z]
    x = -c * sensors[m, S_X] - s * sensors[m, S_Y]
    y = s * sensors[m, S_X] - c * sensors[m, S_Y]
    column = place_in(sensors[m, S_X], grid[0], grid[2], grid[3])
    row = place_in(sensors[m, S_Y], grid[1], grid[2], grid[4])
    rings = int(max(grid[3], grid[4]))
    for ring in range(rings):
        near = (ring - 1) * grid[2] - MARGIN
        if near >= fan[REACH]:
            return
        if near > 0.0:
            left = beyond(beams, 0, beams.shape[1], 1.0 / near)
            if left < LONELY * ring:
                follow_rest(beams, fan, sensors, m, grid, statics, start, items, near)
                return
        n, number = np.int64(0), np.int64(0)
        for r in range(max(row - ring, bottom), min(row + ring, top) + 1):
            base = r * int(grid[3])
            first = max(column - ring, spans[r, 0] - base)
            last = min(column + ring, spans[r, 1] - base)
            gap = 1
            if abs(r - row) < ring:  # only the two ends of this row are in the ring
                first = column - ring if first == column - ring else column + ring
                gap = 2 * ring
            for q in range(first, last + 1, gap):
                number = note_cell(cells, number, fan[REACH], grid, start, q, r, sensors, m)
                if number == cells.shape[1]:
                    n = draw_cells(
                        beams, fan, cells, number, found, n, statics, start, items, stamp,
                        height, x, y, c, -s,
                    )  # fmt: skip
                    number = 0 * number
        n = draw_cells(
            beams, fan, cells, number, found, n, statics, start, items, stamp, height, x, y,
            c, -s,
        )  # fmt: skip
        if n > 0:
            draw_found(beams, fan, found, n)


@part
def span_rows(
    spans: Indices, view: Floats, grid: Floats, widest: float, start: Cells
) -> tuple[int, int, int]:
    """First and last row in view, and statics listed there; of each row the cells in view."""
    bottom, top = rows_of(view, grid, widest)
    listed = np.int64(0)
    for r in range(bottom, top + 1):
        left, right = cells_of(view, grid, widest, r)
        spans[r, 0], spans[r, 1] = left, right
        listed += np.int64(start[right + 1] - start[left])
    return bottom, top, int(listed)


@kernel
def scan_crowded(
    first: int, last: int, sensors: Floats, owners: Indices, mounts: Floats, fan: Floats,
    outline: Floats, widest: float, grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, beams: Floats,
    view: Floats, stamp: Indices, walls: Floats, others: Floats, spans: Indices, ranges: Floats,
    names: Floats,
) -> None:  # fmt: skip
    """What ``kernels_scan.scan`` does, faster where many statics are in view."""
    for m in range(first, last):
        aim(sensors, m, owners, mounts, pose)
        world = owners[m] // kinds.shape[0]
        me = kinds[owners[m] - world * kinds.shape[0], FAMILY]
        clear(beams, 1.0 / fan[REACH])
        put_view(view, outline, sensors, m)
        bottom, top, listed = span_rows(spans, view, grid, widest, start)
        if listed > MANY:
            draw_nearest_first(
                beams, fan, walls, others, spans, bottom, top, sensors, m, grid, statics, start,
                items, stamp,
            )  # fmt: skip
        draw_view(
            beams, fan, sensors, m, view, widest, grid, statics, start, items, lanes, stamp,
            kinds, looks, pose, head, follow, world, me, walls, others, listed > MANY,
        )  # fmt: skip
        report(beams, m, fan[REACH], ranges, names)
