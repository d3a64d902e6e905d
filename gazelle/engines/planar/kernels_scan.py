"""Scan a fan of beams: find what may be met, and draw it.

The cells that a sensor's field of view passes are found row by row; what is in them is
turned into the frame of the sensor and drawn. Nothing is done a beam and cell, so the cost
grows with what is in view, not with the number of beams times the way they go, nor with the
number of bodies in the world.
"""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import part, whole
from gazelle.engines.planar.columns import (
    COS,
    FAMILY,
    REACH,
    S_COS,
    S_SIN,
    S_X,
    S_Y,
    S_Z,
    SIN,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.kernels_bodies import draw_bodies, find_body
from gazelle.engines.planar.kernels_find import draw_found, draw_statics, find_lanes, find_statics
from gazelle.engines.planar.kernels_grid import place_in, stretch
from gazelle.engines.planar.tables import Cells, Floats, Indices

RINGS = 16  # by which bodies are sorted


@part
def put_view(view: Floats, outline: Floats, sensors: Floats, m: int, share: float) -> None:
    """Corners of the convex outline of all that a sensor sees up to a share of its reach."""
    for k in range(outline.shape[0]):
        x, y = share * outline[k, 0], share * outline[k, 1]
        view[k, 0] = sensors[m, S_X] + sensors[m, S_COS] * x - sensors[m, S_SIN] * y
        view[k, 1] = sensors[m, S_Y] + sensors[m, S_SIN] * x + sensors[m, S_COS] * y


@part
def extent_of(view: Floats, low: float, high: float) -> tuple[float, float]:
    """Least and greatest x of a convex outline between two heights."""
    left, right = math.inf, -math.inf
    count = view.shape[0]
    for k in range(count):
        j = k + 1 if k + 1 < count else 0
        lo, hi = stretch(low, high, view[k, 1], view[j, 1], view[k, 0], view[j, 0])
        left, right = min(left, lo), max(right, hi)
    return left, right


@part
def rows_of(view: Floats, grid: Floats, widest: float) -> tuple[int, int]:
    """First and last row of cells that a view, widened by a radius, passes."""
    if grid[4] == 1.0:
        return 0, 0
    low, high = math.inf, -math.inf
    for k in range(view.shape[0]):
        low, high = min(low, view[k, 1]), max(high, view[k, 1])
    bottom = place_in(low - widest, grid[1], grid[2], grid[4])
    return bottom, place_in(high + widest, grid[1], grid[2], grid[4])


@part
def cells_of(view: Floats, grid: Floats, widest: float, r: int) -> tuple[int, int]:
    """First and last cell of row r that a view, widened by a radius, passes."""
    base = r * int(grid[3])
    if grid[3] == 1.0:
        return base, base
    below = grid[1] + r * grid[2] - widest if r > 0 else -math.inf
    above = grid[1] + (r + 1) * grid[2] + widest if r < grid[4] - 1 else math.inf
    left, right = extent_of(view, below, above)
    if right < left:
        return base, base - 1
    first = place_in(left - widest, grid[0], grid[2], grid[3])
    return base + first, base + place_in(right + widest, grid[0], grid[2], grid[3])


@part
def sort_found(found: Floats, n: int, reach: float) -> None:
    """Copy the bodies found to the lower half of the rows, about the nearest first.

    Then those that are hidden by others need not be drawn.
    """
    for ring in range(RINGS):
        found[8, ring] = 0.0
    share = RINGS / reach
    for i in range(np.uint64(n)):
        x, y = found[0, i], found[1, i]
        found[6, i] = min(math.sqrt(x * x + y * y) * share, RINGS - 1.0)
    for i in range(n):
        found[8, int(found[6, i])] += 1.0
    before = 0.0
    for ring in range(RINGS):
        here = found[8, ring]
        found[8, ring] = before
        before += here
    for i in range(n):
        ring = int(found[6, i])
        to = int(found[8, ring])
        found[8, ring] += 1.0
        for row in range(5):
            found[9 + row, to] = found[row, i]
        found[16, to] = found[7, i]


@part
def draw_view(  # a call for each cell would cost more than what it does
    beams: Floats, fan: Floats, sensors: Floats, m: int, view: Floats, widest: float,
    grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats, stamp: Indices,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, world: int, me: float,
    walls: Floats, others: Floats, drawn: bool,
) -> None:  # fmt: skip
    """All that is in the cells in view, but for bodies of the family ``me``.

    Statics may have been ``drawn`` before.
    """
    stamp[statics.shape[0]] += 1
    c, s, height = sensors[m, S_COS], sensors[m, S_SIN], sensors[m, S_Z]
    x = -c * sensors[m, S_X] - s * sensors[m, S_Y]
    y = s * sensors[m, S_X] - c * sensors[m, S_Y]
    few = lanes.shape[1]
    if few > 0 and not drawn:
        find_lanes(walls, lanes, height, x, y, c, -s)
        draw_statics(beams, fan, walls, few)
    n, q = np.int64(0), np.int64(0)
    bottom, top = rows_of(view, grid, widest)
    for r in range(bottom, top + 1):
        left, right = cells_of(view, grid, widest, r)
        if few == 0 and not drawn:
            n = find_statics(
                beams, fan, walls, n, statics, items, int(start[left]), int(start[right + 1]),
                stamp, height, x, y, c, -s,
            )  # fmt: skip
        for cell in range(left, right + 1):
            b = int(head[world, cell])
            while b >= 0:
                k = b - world * kinds.shape[0]
                if kinds[k, FAMILY] != me:
                    q = find_body(others, q, fan, sensors, m, kinds, pose, k, b)
                    if q == others.shape[1]:
                        sort_found(others, q, fan[REACH])
                        draw_bodies(
                            beams, fan, others[9:], q, sensors, m, kinds, looks, pose, world
                        )
                        q = 0 * q
                b = int(follow[b])
    if n > 0:
        draw_found(beams, fan, walls, n)
    if q > 0:
        sort_found(others, q, fan[REACH])
        draw_bodies(beams, fan, others[9:], q, sensors, m, kinds, looks, pose, world)


@part
def aim(sensors: Floats, m: int, owners: Indices, mounts: Floats, pose: Floats) -> None:
    """Find where sensor m is: the mounts are on the bodies ``owners``, by turns."""
    b, j = owners[m], m % mounts.shape[0]
    c, s = pose[b, COS], pose[b, SIN]
    sensors[m, S_X] = pose[b, X] + c * mounts[j, S_X] - s * mounts[j, S_Y]
    sensors[m, S_Y] = pose[b, Y] + s * mounts[j, S_X] + c * mounts[j, S_Y]
    sensors[m, S_COS] = c * mounts[j, S_COS] - s * mounts[j, S_SIN]
    sensors[m, S_SIN] = s * mounts[j, S_COS] + c * mounts[j, S_SIN]
    sensors[m, S_Z] = pose[b, Z] + mounts[j, S_Z]


@part
def clear(beams: Floats, nothing: float) -> None:
    """Forget what beams met."""
    for k in range(np.uint64(beams.shape[1])):
        beams[2, k] = nothing
        beams[3, k] = 0.0


@part
def report(beams: Floats, m: int, reach: float, ranges: Floats, names: Floats) -> None:
    """Write down what the beams of sensor m met."""
    nothing = 1.0 / reach
    for k in range(np.uint64(beams.shape[1])):
        best = beams[2, k]
        t = 1.0 / best
        ranges[m, k] = t if best > nothing else reach
    if names.shape[0] > 0:
        for k in range(np.uint64(beams.shape[1])):
            names[m, k] = beams[3, k]


@whole
def scan(
    first: int, last: int, sensors: Floats, owners: Indices, mounts: Floats, fan: Floats,
    outline: Floats, widest: float, grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, beams: Floats,
    view: Floats, stamp: Indices, walls: Floats, others: Floats, ranges: Floats, names: Floats,
) -> None:  # fmt: skip
    """Scan with the sensors first to last; a beam that meets nothing gets the fan's reach."""
    for m in range(first, last):
        aim(sensors, m, owners, mounts, pose)
        world = owners[m] // kinds.shape[0]
        me = kinds[owners[m] - world * kinds.shape[0], FAMILY]
        clear(beams, 1.0 / fan[REACH])
        if grid[3] * grid[4] > 1.0:
            put_view(view, outline, sensors, m, 1.0)
        draw_view(
            beams, fan, sensors, m, view, widest, grid, statics, start, items, lanes, stamp,
            kinds, looks, pose, head, follow, world, me, walls, others, False,
        )  # fmt: skip
        report(beams, m, fan[REACH], ranges, names)
