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

from gazelle.engines.planar.columns import (
    CIRCLE,
    COS,
    FAMILY,
    FIRST_LOOK,
    GLOW,
    HIGH,
    KIND,
    L_GLOW,
    L_HIGH,
    L_LOW,
    L_RADIUS,
    LAST_LOOK,
    LOW,
    NAMES,
    NEAR,
    OPEN,
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
from gazelle.engines.planar.compiled import kernel, part
from gazelle.engines.planar.kernels_fan import (
    FEW,
    beams_in,
    cover,
    draw,
    draw_circle,
    draw_segment,
    draw_through,
    solve,
)
from gazelle.engines.planar.kernels_grid import place_in, stretch
from gazelle.engines.planar.tables import Cells, Floats, Indices


@part
def find_static(
    found: Floats, n: int, fan: Floats, statics: Floats, s: int, height: float, x: float,
    y: float, cos: float, sin: float,
) -> int:  # fmt: skip
    """Write down a static primitive as the n-th found if it can be seen; returns how many.

    The world's frame is at (x, y, cos, sin) in the sensor's.
    """
    if statics[s, GLOW] < 0.0 or height < statics[s, LOW] or height > statics[s, HIGH]:
        return n
    ax, ay, bx, by = statics[s, X0], statics[s, Y0], statics[s, X1], statics[s, Y1]
    x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
    x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
    radius = bx if (int(statics[s, KIND]) & int(CIRCLE)) != 0 else 0.0
    if radius > 0.0:
        far = fan[REACH] + radius
        if x0 * x0 + y0 * y0 > far * far:
            return n
    else:
        cross, ex, ey = x0 * y1 - x1 * y0, x1 - x0, y1 - y0
        if cross * cross > fan[REACH] * fan[REACH] * (ex * ex + ey * ey):
            return n
    found[0, n], found[1, n], found[2, n], found[3, n] = x0, y0, x1, y1
    found[4, n], found[7, n] = radius, s + 1.0
    return n + 1


@part
def find_lanes(
    found: Floats, lanes: Floats, height: float, x: float, y: float, cos: float, sin: float
) -> None:
    """Write down all static primitives of a world with few, prepared as ``solve`` does.

    Those that cannot be seen are a share 0 of any distance: never met.
    """
    for i in range(np.uint64(lanes.shape[1])):
        ax, ay, bx, by = lanes[X0, i], lanes[Y0, i], lanes[X1, i], lanes[Y1, i]
        x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
        x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
        radius, name = lanes[L_RADIUS, i], float(i) + 1.0
        disc = radius > 0.0
        cross = x0 * x0 + y0 * y0 - radius * radius if disc else x0 * y1 - x1 * y0
        seen = (lanes[L_GLOW, i] >= 0.0) & (height >= lanes[L_LOW, i])
        seen = seen & (height <= lanes[L_HIGH, i]) & (cross != 0.0)
        found[0, i], found[1, i], found[2, i], found[3, i] = x0, y0, x1, y1
        found[4, i] = radius
        found[7, i] = name if disc | (cross < 0.0) else -name
        found[8, i] = 1.0 / cross if seen else 0.0


@part
def draw_statics(beams: Floats, fan: Floats, found: Floats, n: int) -> None:
    """Draw the static primitives found and solved."""
    count = beams.shape[1]
    if count <= FEW:
        draw_through(beams, found, n, fan[NEAR])
        return
    cover(found, n, fan)
    for i in range(n):
        for turn in range(2):
            lo, hi = beams_in(fan, count, found[5, i], found[6, i], -turn)
            if lo < hi:
                draw(beams, lo, hi, fan, found, i)


@part
def hidden(beams: Floats, lo: int, hi: int, inverse: float) -> bool:
    """Whether beams lo to hi all meet something nearer than one over ``inverse``."""
    for k in range(lo, hi):  # noqa: SIM110  # compiled code knows no generators
        if beams[2, k] < inverse:
            return False
    return True


@part
def draw_looks(
    beams: Floats, lo: int, hi: int, fan: Floats, looks: Floats, first: int, last: int,
    height: float, found: Floats, i: int, away: bool, name: float,
) -> None:  # fmt: skip
    """Primitives of the i-th body found.

    Of closed outlines that beams begin ``away`` from only the front is drawn.
    """
    x, y, cos, sin = found[0, i], found[1, i], found[2, i], found[3, i]
    for p in range(first, last):
        if looks[p, GLOW] < 0.0 or height < looks[p, LOW] or height > looks[p, HIGH]:
            continue
        ax, ay, bx, by = looks[p, X0], looks[p, Y0], looks[p, X1], looks[p, Y1]
        x0, y0 = x + cos * ax - sin * ay, y + sin * ax + cos * ay
        x1, y1 = x + cos * bx - sin * by, y + sin * bx + cos * by
        kind = int(looks[p, KIND])
        circle = (kind & int(CIRCLE)) != 0
        cross = x0 * x0 + y0 * y0 - bx * bx if circle else x0 * y1 - x1 * y0
        back = cross > 0.0 and not circle
        if cross == 0.0 or (back and away and (kind & int(OPEN)) == 0):
            continue
        inverse = 1.0 / cross
        if circle:
            draw_circle(beams, lo, hi, x0, y0, bx * bx, inverse, fan[NEAR], name + p)
        else:
            seen = -name - p if back else name + p
            draw_segment(beams, lo, hi, x0, y0, x1, y1, inverse, fan[NEAR], seen)


@part
def find_body(
    found: Floats, n: int, fan: Floats, sensors: Floats, m: int, kinds: Floats, pose: Floats,
    k: int, b: int,
) -> int:  # fmt: skip
    """Write down body b, of kind k, as the n-th found if it can be seen; returns how many."""
    ox, oy = pose[b, X] - sensors[m, S_X], pose[b, Y] - sensors[m, S_Y]
    radius = kinds[k, RADIUS]
    far = fan[REACH] + radius
    if ox * ox + oy * oy > far * far:
        return n
    c, s = sensors[m, S_COS], sensors[m, S_SIN]
    found[0, n], found[1, n] = c * ox + s * oy, c * oy - s * ox
    found[2, n], found[3, n] = (
        c * pose[b, COS] + s * pose[b, SIN],
        c * pose[b, SIN] - s * pose[b, COS],
    )
    found[4, n], found[7, n] = radius, b
    return n + 1


@part
def draw_bodies(
    beams: Floats, fan: Floats, found: Floats, n: int, sensors: Floats, m: int, kinds: Floats,
    looks: Floats, pose: Floats, world: int,
) -> None:  # fmt: skip
    """Draw the bodies found."""
    count = beams.shape[1]
    if count > FEW:
        cover(found, n, fan)
    for i in range(n):
        b = int(found[7, i])
        k = b - world * kinds.shape[0]
        x, y, radius = found[0, i], found[1, i], found[4, i]
        square = x * x + y * y
        nearest = math.sqrt(square) - radius
        away = nearest > 0.0 and nearest * fan[NEAR] >= 1.0
        height = sensors[m, S_Z] - pose[b, Z]
        lo, hi = np.int64(0), count
        for turn in range(2 if count > FEW else 1):
            if count > FEW:
                lo, hi = beams_in(fan, count, found[5, i], found[6, i], -turn)
                if away and hidden(beams, lo, hi, 1.0 / nearest):
                    continue
            draw_looks(
                beams, lo, hi, fan, looks, int(kinds[k, FIRST_LOOK]), int(kinds[k, LAST_LOOK]),
                height, found, i, away, NAMES * (b + 1.0),
            )  # fmt: skip


@part
def put_view(view: Floats, outline: Floats, sensors: Floats, m: int) -> None:
    """Corners of the convex outline of all that a sensor can see, in the world."""
    for k in range(outline.shape[0]):
        x, y = outline[k, 0], outline[k, 1]
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
def find_statics(
    beams: Floats, fan: Floats, found: Floats, n: int, statics: Floats, items: Cells, first: int,
    last: int, stamp: Indices, height: float, x: float, y: float, cos: float, sin: float,
) -> int:  # fmt: skip
    """Write down statics of some cells, listed in ``items``; draw them when there are many.

    ``stamp`` holds the scan that came last to each: each is drawn once a scan.
    """
    now = stamp[statics.shape[0]]
    for i in range(first, last):
        p = int(items[i])
        if stamp[p] == now:
            continue
        stamp[p] = now
        n = find_static(found, n, fan, statics, p, height, x, y, cos, sin)
        if n == found.shape[1]:
            solve(found, n)
            draw_statics(beams, fan, found, n)
            n = 0 * n
    return n


@part
def draw_view(  # a call for each cell would cost more than what it does
    beams: Floats, fan: Floats, sensors: Floats, m: int, view: Floats, widest: float,
    grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats, stamp: Indices,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, world: int, me: float,
    walls: Floats, others: Floats,
) -> None:  # fmt: skip
    """All that is in the cells in view, but for bodies of the family ``me``."""
    stamp[statics.shape[0]] += 1
    c, s, height = sensors[m, S_COS], sensors[m, S_SIN], sensors[m, S_Z]
    x = -c * sensors[m, S_X] - s * sensors[m, S_Y]
    y = s * sensors[m, S_X] - c * sensors[m, S_Y]
    few = lanes.shape[1]
    if few > 0:
        find_lanes(walls, lanes, height, x, y, c, -s)
        draw_statics(beams, fan, walls, few)
    n, q = np.int64(0), np.int64(0)
    bottom, top = rows_of(view, grid, widest)
    for r in range(bottom, top + 1):
        left, right = cells_of(view, grid, widest, r)
        if few == 0:
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
                        draw_bodies(beams, fan, others, q, sensors, m, kinds, looks, pose, world)
                        q = 0 * q
                b = int(follow[b])
    if n > 0:
        solve(walls, n)
        draw_statics(beams, fan, walls, n)
    if q > 0:
        draw_bodies(beams, fan, others, q, sensors, m, kinds, looks, pose, world)


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


@kernel
def scan(
    first: int, last: int, sensors: Floats, owners: Indices, mounts: Floats, fan: Floats,
    outline: Floats, widest: float, grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, beams: Floats,
    view: Floats, stamp: Indices, walls: Floats, others: Floats, ranges: Floats, names: Floats,
) -> None:  # fmt: skip
    """Scan with the sensors first to last; a beam that meets nothing gets the fan's reach."""
    nothing = 1.0 / fan[REACH]
    for m in range(first, last):
        aim(sensors, m, owners, mounts, pose)
        world = owners[m] // kinds.shape[0]
        me = kinds[owners[m] - world * kinds.shape[0], FAMILY]
        for k in range(np.uint64(beams.shape[1])):
            beams[2, k] = nothing
            beams[3, k] = 0.0
        if grid[3] * grid[4] > 1.0:
            put_view(view, outline, sensors, m)
        draw_view(
            beams, fan, sensors, m, view, widest, grid, statics, start, items, lanes, stamp,
            kinds, looks, pose, head, follow, world, me, walls, others,
        )  # fmt: skip
        for k in range(np.uint64(beams.shape[1])):
            best = beams[2, k]
            t = 1.0 / best
            ranges[m, k] = t if best > nothing else fan[REACH]
        if names.shape[0] > 0:
            for k in range(np.uint64(beams.shape[1])):
                names[m, k] = beams[3, k]
