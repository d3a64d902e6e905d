"""Find static primitives that a sensor may see, and draw them."""

from __future__ import annotations

import numpy as np

from gazelle.engines.native import part
from gazelle.engines.planar.columns import (
    CIRCLE,
    GLOW,
    HIGH,
    KIND,
    L_GLOW,
    L_HIGH,
    L_LOW,
    L_RADIUS,
    LOW,
    NEAR,
    REACH,
    X0,
    X1,
    Y0,
    Y1,
)
from gazelle.engines.planar.kernels_fan import (
    FEW,
    beams_in,
    cover,
    draw,
    draw_through,
    solve,
)
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
def draw_found(beams: Floats, fan: Floats, found: Floats, n: int) -> None:
    """Draw the static primitives found."""
    solve(found, n)
    draw_statics(beams, fan, found, n)


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
            draw_found(beams, fan, found, n)
            n = 0 * n
    return n
