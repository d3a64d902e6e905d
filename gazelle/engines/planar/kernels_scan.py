"""Scan a fan of beams: find what may be met, and draw it.

The cells that a sensor's field of view passes are found row by row; what is in them is
turned into the frame of the sensor and drawn. Nothing is done a beam and cell, so the cost
grows with what is in view, not with the number of beams times the way they go, nor with the
number of bodies in the world.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.planar.columns import (
    CIRCLE,
    COS,
    FAMILY,
    FIRST_LOOK,
    GLOW,
    HIGH,
    KIND,
    LAST_LOOK,
    LOW,
    NAMES,
    RADIUS,
    REACH,
    S_COS,
    S_SIN,
    S_X,
    S_Y,
    S_Z,
    SIN,
    X0,
    X1,
    Y0,
    Y1,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.compiled import kernel
from gazelle.engines.planar.kernels_fan import draw
from gazelle.engines.planar.kernels_grid import place_in, stretch


@kernel
def draw_row(beams, fan, table, p, height, x, y, cos, sin, name):
    """A primitive of a table whose frame is at (x, y, cos, sin) in the sensor's frame.

    ``height`` is the sensor's in the frame of the table.
    """
    if table[p, GLOW] < 0.0 or height < table[p, LOW] or height > table[p, HIGH]:
        return
    circle = (int(table[p, KIND]) & int(CIRCLE)) != 0
    ax, ay, bx, by = table[p, X0], table[p, Y0], table[p, X1], table[p, Y1]
    x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
    x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
    draw(beams, fan, circle, bx if circle else 0.0, x0, y0, x1, y1, name)


@kernel
def draw_body(beams, fan, sensors, m, kinds, looks, pose, k, b):
    """Body b, of kind k, if sensor m can see it."""
    ox, oy = pose[b, X] - sensors[m, S_X], pose[b, Y] - sensors[m, S_Y]
    far = fan[REACH] + kinds[k, RADIUS]
    if ox * ox + oy * oy > far * far:
        return
    c, n = sensors[m, S_COS], sensors[m, S_SIN]
    x, y = c * ox + n * oy, c * oy - n * ox
    cos = c * pose[b, COS] + n * pose[b, SIN]
    sin = c * pose[b, SIN] - n * pose[b, COS]
    height = sensors[m, S_Z] - pose[b, Z]
    for p in range(int(kinds[k, FIRST_LOOK]), int(kinds[k, LAST_LOOK])):
        draw_row(beams, fan, looks, p, height, x, y, cos, sin, NAMES * (b + 1.0) + p)


@kernel
def put_view(view, outline, sensors, m):
    """Corners of the convex outline of all that a sensor can see, in the world."""
    for k in range(outline.shape[0]):
        x, y = outline[k, 0], outline[k, 1]
        view[k, 0] = sensors[m, S_X] + sensors[m, S_COS] * x - sensors[m, S_SIN] * y
        view[k, 1] = sensors[m, S_Y] + sensors[m, S_SIN] * x + sensors[m, S_COS] * y


@kernel
def extent_of(view, low, high):
    """Least and greatest x of a convex outline between two heights."""
    left, right = math.inf, -math.inf
    count = view.shape[0]
    for k in range(count):
        j = k + 1 if k + 1 < count else 0
        lo, hi = stretch(low, high, view[k, 1], view[j, 1], view[k, 0], view[j, 0])
        left, right = min(left, lo), max(right, hi)
    return left, right


@kernel
def rows_of(view, grid, widest):
    """First and last row of cells that a view, widened by a radius, passes."""
    if grid[4] == 1.0:
        return 0, 0
    low, high = math.inf, -math.inf
    for k in range(view.shape[0]):
        low, high = min(low, view[k, 1]), max(high, view[k, 1])
    bottom = place_in(low - widest, grid[1], grid[2], grid[4])
    return bottom, place_in(high + widest, grid[1], grid[2], grid[4])


@kernel
def cells_of(view, grid, widest, r):
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


@kernel
def draw_view(
    beams, fan, sensors, m, view, widest, grid, statics, start, items, stamp,
    kinds, looks, pose, head, follow, nbody, world, me,
):  # fmt: skip
    """All that is in the cells in view, but for bodies of the family ``me``.

    ``stamp`` holds the scan that came last to each static primitive: each is drawn once.
    """
    now = stamp[statics.shape[0]] + 1
    stamp[statics.shape[0]] = now
    c, n = sensors[m, S_COS], sensors[m, S_SIN]
    x = -c * sensors[m, S_X] - n * sensors[m, S_Y]
    y = n * sensors[m, S_X] - c * sensors[m, S_Y]
    bottom, top = rows_of(view, grid, widest)
    for r in range(bottom, top + 1):
        from_cell, to_cell = cells_of(view, grid, widest, r)
        for i in range(start[from_cell], start[to_cell + 1]):
            s = int(items[i])
            if stamp[s] != now:
                stamp[s] = now
                draw_row(beams, fan, statics, s, sensors[m, S_Z], x, y, c, -n, s + 1.0)
        for cell in range(from_cell, to_cell + 1):
            b = int(head[world, cell])
            while b >= 0:
                k = b - world * nbody
                if kinds[k, FAMILY] != me:
                    draw_body(beams, fan, sensors, m, kinds, looks, pose, k, b)
                b = int(follow[b])


@kernel
def aim(first, last, owners, mounts, pose, sensors):
    """Where the sensors first to last are: mounted on the bodies ``owners``, by turns."""
    for m in range(first, last):
        b, j = owners[m], m % mounts.shape[0]
        c, n = pose[b, COS], pose[b, SIN]
        sensors[m, S_X] = pose[b, X] + c * mounts[j, S_X] - n * mounts[j, S_Y]
        sensors[m, S_Y] = pose[b, Y] + n * mounts[j, S_X] + c * mounts[j, S_Y]
        sensors[m, S_COS] = c * mounts[j, S_COS] - n * mounts[j, S_SIN]
        sensors[m, S_SIN] = n * mounts[j, S_COS] + c * mounts[j, S_SIN]
        sensors[m, S_Z] = pose[b, Z] + mounts[j, S_Z]


@kernel
def scan(
    first, last, sensors, owners, fan, outline, widest, grid, statics, start, items,
    kinds, looks, pose, head, follow, beams, view, stamp, ranges, names,
):  # fmt: skip
    """Scan with the sensors first to last; a beam that meets nothing gets the fan's reach."""
    nbody = kinds.shape[0]
    nothing = 1.0 / fan[REACH]
    for m in range(first, last):
        world = owners[m] // nbody
        me = kinds[owners[m] - world * nbody, FAMILY]
        for k in range(np.uint64(beams.shape[1])):
            beams[2, k] = nothing
            beams[3, k] = 0.0
        put_view(view, outline, sensors, m)
        draw_view(
            beams, fan, sensors, m, view, widest, grid, statics, start, items, stamp,
            kinds, looks, pose, head, follow, nbody, world, me,
        )  # fmt: skip
        for k in range(np.uint64(beams.shape[1])):
            best = beams[2, k]
            t = 1.0 / best
            ranges[m, k] = t if best > nothing else fan[REACH]
        if names.shape[0] > 0:
            for k in range(np.uint64(beams.shape[1])):
                names[m, k] = beams[3, k]
