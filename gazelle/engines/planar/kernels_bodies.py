"""Find bodies that a sensor may see, and draw them."""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import part
from gazelle.engines.planar.columns import (
    CIRCLE,
    COS,
    FIRST_LOOK,
    GLOW,
    HIGH,
    KIND,
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
from gazelle.engines.planar.kernels_fan import FEW, beams_in, cover, draw_circle, draw_segment
from gazelle.engines.planar.tables import Floats


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
