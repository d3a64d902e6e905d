# cython: infer_types=True, annotation_typing=False
"""Lanes that meet bodies: what there is near a body is looked up once for all its sensors."""

# ruff: noqa: PLR1716, PLW3301  # arguments in order; loops that become vectors

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.beams import Candidates
from cython.cimports.gazelle.engines.planar.columns import FAMILY, RADIUS, X, Y
from cython.cimports.gazelle.engines.planar.grid_cells import place_in
from cython.cimports.gazelle.engines.planar.lanes import Lanes
from cython.cimports.gazelle.engines.planar.scan_columns import (
    C_FIRST,
    C_NAME,
    C_RADIUS,
    C_SPAN,
    C_X0,
    C_Y0,
    LANE_BEST,
    LANE_DX,
    LANE_DY,
    LANE_X,
    LANE_Y,
)  # fmt: skip

INF = cython.declare(cython.double, float("inf"))
CROWD = cython.declare(cython.int, 128)  # bodies that are met at once
CLOSE = cython.declare(cython.double, 0.3)  # cells around a body from which others are met first


def take_nearest(found: Candidates, count: int) -> int:
    """Remove and return the nearest of the bodies listed in ``span``."""
    pick = 0
    for c in range(1, count):
        here = cython.cast(cython.Py_ssize_t, found.table[C_SPAN + c])
        if (
            found.table[C_FIRST + here]
            < found.table[C_FIRST + cython.cast(cython.Py_ssize_t, found.table[C_SPAN + pick])]
        ):
            pick = c
    j: int = cython.cast(cython.Py_ssize_t, found.table[C_SPAN + pick])
    found.table[C_SPAN + pick] = found.table[C_SPAN + count - 1]
    return j


def meet_some(lanes: Lanes, first: int, last: int, found: Candidates, n: int, base: int) -> None:
    """Intersect lanes first to last with the first n bodies found, each as a disc at first.

    Args:
        lanes: Of which.
        first: Of the lanes.
        last: Before it.
        found: Bodies; ``first`` and ``span`` are written on.
        n: Number of bodies.
        base: The first body of the world.
    """
    for i in range(first, last):
        x, y = lanes.table[LANE_X + i], lanes.table[LANE_Y + i]
        dx, dy = lanes.table[LANE_DX + i], lanes.table[LANE_DY + i]
        for j in range(n):
            ox, oy, radius = (
                found.table[C_X0 + j] - x,
                found.table[C_Y0 + j] - y,
                found.table[C_RADIUS + j],
            )
            along, aside = dx * ox + dy * oy, dx * oy - dy * ox
            passed = (aside * aside <= radius * radius) & (along >= -radius)
            found.table[C_FIRST + j] = along - radius if passed else INF
        count = 0
        for j in range(n):
            if found.table[C_FIRST + j] * lanes.table[LANE_BEST + i] < 1.0:
                found.table[C_SPAN + count] = j
                count += 1
        while count > 0:
            j = take_nearest(found, count)
            count -= 1
            if found.table[C_FIRST + j] * lanes.table[LANE_BEST + i] < 1.0:
                b = cython.cast(cython.Py_ssize_t, found.table[C_NAME + j])
                lanes.meet_body(i, b - base, b)


def cells_near(lanes: Lanes, first: int, last: int) -> tuple[int, int, int, int]:
    """Return first and last column and row of bodies that lanes first to last may meet."""
    left, right, low, high = INF, -INF, INF, -INF
    for i in range(first, last):
        x, y = lanes.table[LANE_X + i], lanes.table[LANE_Y + i]
        x1 = x + lanes.table[LANE_DX + i] / lanes.table[LANE_BEST + i]
        y1 = y + lanes.table[LANE_DY + i] / lanes.table[LANE_BEST + i]
        left, right = min(left, min(x, x1)), max(right, max(x, x1))
        low, high = min(low, min(y, y1)), max(high, max(y, y1))
    widest, side = lanes.bodies.widest, lanes.bodies.grid[2]
    x, y = lanes.bodies.grid[0], lanes.bodies.grid[1]
    columns, rows = lanes.bodies.grid[3], lanes.bodies.grid[4]
    return (
        place_in(left - widest, x, side, columns),
        place_in(right + widest, x, side, columns),
        place_in(low - widest, y, side, rows),
        place_in(high + widest, y, side, rows),
    )


def meet_bodies(lanes: Lanes, first: int, last: int, found: Candidates, me: int) -> None:
    """Intersect lanes first to last, all of body ``me``, with others up to their nearest hit.

    First those nearby, as in a crowd there are none to be seen behind them.
    """
    nbody = lanes.bodies.nbody
    world = me // nbody
    origin = world * nbody
    family = lanes.bodies.kinds[me - origin, FAMILY]
    side, columns, rows = lanes.bodies.grid[2], lanes.bodies.grid[3], lanes.bodies.grid[4]
    x, y, close = lanes.bodies.rows[me, X], lanes.bodies.rows[me, Y], CLOSE * side
    a = place_in(x - close, lanes.bodies.grid[0], side, columns)
    b = place_in(x + close, lanes.bodies.grid[0], side, columns)
    c = place_in(y - close, lanes.bodies.grid[1], side, rows)
    d = place_in(y + close, lanes.bodies.grid[1], side, rows)
    for turn in range(2):
        begin, end, bottom, top = cells_near(lanes, first, last)
        if turn == 0:
            begin, end, bottom, top = max(begin, a), min(end, b), max(bottom, c), min(top, d)
        n = 0
        for row in range(bottom, top + 1):
            base = row * cython.cast(cython.Py_ssize_t, columns)
            for column in range(begin, end + 1):
                if turn == 1 and a <= column and column <= b and c <= row and row <= d:
                    continue
                body = cython.cast(cython.Py_ssize_t, lanes.bodies.head[world, base + column])
                while body >= 0:
                    if lanes.bodies.kinds[body - origin, FAMILY] != family:
                        found.table[C_X0 + n] = lanes.bodies.rows[body, X]
                        found.table[C_Y0 + n] = lanes.bodies.rows[body, Y]
                        found.table[C_RADIUS + n] = lanes.bodies.kinds[body - origin, RADIUS]
                        found.table[C_NAME + n] = body
                        n += 1
                        if n == CROWD:
                            meet_some(lanes, first, last, found, n, origin)
                            n = 0
                    body = lanes.bodies.follow[body]
        if n > 0:
            meet_some(lanes, first, last, found, n, origin)
