"""Scan with fans of few beams, as sonars are: the beams of many sensors side by side.

Statics are met in the grid of clear space. What else there is near a body is looked up once for
all its sensors.
"""

# ruff: noqa: ARG001  # the arguments are those of all scanning kernels

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import inner, kernel, part
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
    NEAR,
    RADIUS,
    REACH,
    S_Z,
    SIN,
    X0,
    X1,
    Y0,
    Y1,
    Z,
)
from gazelle.engines.planar.columns import X as BODY_X
from gazelle.engines.planar.columns import Y as BODY_Y
from gazelle.engines.planar.kernels_grid import place_in
from gazelle.engines.planar.kernels_march import (
    BEST,
    DX,
    DY,
    HEIGHT,
    MOST_LANES,
    NAME,
    X,
    Y,
    is_clear,
    meet_disc,
    meet_segment,
    meet_statics,
    put_lanes,
)
from gazelle.engines.planar.kernels_scan import (
    aim,
    clear,
    draw_view,
    put_view,
    report,
)
from gazelle.engines.planar.tables import Cells, Floats, Indices, Marks

FEW_BEAMS = 8  # of a fan whose beams are followed one by one
CLOSE = 0.3  # cells around a body from which others are met first


@inner
def meet_body(
    lanes: Floats, i: int, near: float, kinds: Floats, looks: Floats, pose: Floats, k: int, b: int
) -> None:
    """Let lane i meet body b, of kind k."""
    c, s = pose[b, COS], pose[b, SIN]
    ox, oy = lanes[X + i] - pose[b, BODY_X], lanes[Y + i] - pose[b, BODY_Y]
    x, y = c * ox + s * oy, c * oy - s * ox
    dx, dy = c * lanes[DX + i] + s * lanes[DY + i], c * lanes[DY + i] - s * lanes[DX + i]
    height = lanes[HEIGHT + i] - pose[b, Z]
    for p in range(int(kinds[k, FIRST_LOOK]), int(kinds[k, LAST_LOOK])):
        if looks[p, GLOW] < 0.0 or height < looks[p, LOW] or height > looks[p, HIGH]:
            continue
        name = NAMES * (b + 1.0) + p
        x0, y0 = looks[p, X0] - x, looks[p, Y0] - y
        if (int(looks[p, KIND]) & int(CIRCLE)) != 0:
            meet_disc(lanes, i, dx, dy, x0, y0, looks[p, X1], near, name)
        else:
            x1, y1 = looks[p, X1] - x, looks[p, Y1] - y
            c0, c1 = dx * y0 - dy * x0, dx * y1 - dy * x1
            meet_segment(lanes, i, c0, c1, x0 * y1 - x1 * y0, near, name)


@inner
def nearest_of(found: Floats, count: int) -> int:
    """The nearest of the bodies noted in row 5, which is taken from there."""
    pick = 0
    for c in range(1, count):
        if found[4, int(found[5, c])] < found[4, int(found[5, pick])]:
            pick = c
    j = int(found[5, pick])
    found[5, pick] = found[5, count - 1]
    return j


@part
def meet_some(
    lanes: Floats, first: int, last: int, near: float, found: Floats, n: int, kinds: Floats,
    looks: Floats, pose: Floats, world: int,
) -> None:  # fmt: skip
    """Let lanes first to last meet the bodies found, each as a disc at first."""
    for i in range(first, last):
        x, y, dx, dy = lanes[X + i], lanes[Y + i], lanes[DX + i], lanes[DY + i]
        for j in range(np.uint64(n)):
            ox, oy, radius = found[0, j] - x, found[1, j] - y, found[2, j]
            along, aside = dx * ox + dy * oy, dx * oy - dy * ox
            passed = (aside * aside <= radius * radius) & (along >= -radius)
            found[4, j] = along - radius if passed else math.inf
        count = 0
        for j in range(n):
            if found[4, j] * lanes[BEST + i] < 1.0:
                found[5, count] = float(j)
                count += 1
        while count > 0:
            j = nearest_of(found, count)
            count -= 1
            if found[4, j] * lanes[BEST + i] < 1.0:
                b = int(found[3, j])
                k = b - world * kinds.shape[0]
                meet_body(lanes, i, near, kinds, looks, pose, k, b)


@inner
def cells_near(
    lanes: Floats, first: int, last: int, grid: Floats, widest: float
) -> tuple[int, int, int, int]:
    """First and last column and row of bodies that lanes first to last may meet."""
    left, right, low, high = math.inf, -math.inf, math.inf, -math.inf
    for i in range(first, last):
        x, y = lanes[X + i], lanes[Y + i]
        x1, y1 = x + lanes[DX + i] / lanes[BEST + i], y + lanes[DY + i] / lanes[BEST + i]
        left, right = min(left, x, x1), max(right, x, x1)
        low, high = min(low, y, y1), max(high, y, y1)
    begin = place_in(left - widest, grid[0], grid[2], grid[3])
    end = place_in(right + widest, grid[0], grid[2], grid[3])
    bottom = place_in(low - widest, grid[1], grid[2], grid[4])
    return begin, end, bottom, place_in(high + widest, grid[1], grid[2], grid[4])


@part
def meet_bodies(
    lanes: Floats, first: int, last: int, near: float, found: Floats, grid: Floats, widest: float,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, me: int,
) -> None:  # fmt: skip
    """Let lanes first to last, all of body ``me``, meet others up to what they met before.

    First those nearby, as in a crowd there are none to be seen behind them.
    """
    world = me // kinds.shape[0]
    family = kinds[me - world * kinds.shape[0], FAMILY]
    x, y, close = pose[me, BODY_X], pose[me, BODY_Y], CLOSE * grid[2]
    a = place_in(x - close, grid[0], grid[2], grid[3])
    b = place_in(x + close, grid[0], grid[2], grid[3])
    c = place_in(y - close, grid[1], grid[2], grid[4])
    d = place_in(y + close, grid[1], grid[2], grid[4])
    for turn in range(2):
        begin, end, bottom, top = cells_near(lanes, first, last, grid, widest)
        if turn == 0:
            begin, end, bottom, top = max(begin, a), min(end, b), max(bottom, c), min(top, d)
        n = 0
        for row in range(bottom, top + 1):
            base = row * int(grid[3])
            for column in range(begin, end + 1):
                if turn == 1 and a <= column <= b and c <= row <= d:
                    continue
                body = int(head[world, base + column])
                while body >= 0:
                    k = body - world * kinds.shape[0]
                    if kinds[k, FAMILY] != family:
                        found[0, n], found[1, n] = pose[body, BODY_X], pose[body, BODY_Y]
                        found[2, n], found[3, n] = kinds[k, RADIUS], float(body)
                        n += 1
                        if n == found.shape[1]:
                            meet_some(lanes, first, last, near, found, n, kinds, looks, pose, world)
                            n = 0
                    body = int(follow[body])
        if n > 0:
            meet_some(lanes, first, last, near, found, n, kinds, looks, pose, world)


@inner
def end_of(first: int, last: int, most: int, owners: Indices) -> int:
    """Up to which sensor all go at once: not more than ``most``, a body's together if they can."""
    end = min(last, first + most)
    if end < last:
        whole = end
        while whole > first and owners[whole] == owners[whole - 1]:
            whole -= 1
        end = whole if whole > first else end
    return end


@part
def meet_others(
    lanes: Floats, first: int, last: int, beams: int, near: float, owners: Indices, found: Floats,
    grid: Floats, widest: float, kinds: Floats, looks: Floats, pose: Floats, head: Cells,
    follow: Cells,
) -> None:  # fmt: skip
    """Let the lanes of sensors first to last, some beams each, meet bodies."""
    begin = first
    while begin < last:
        end = begin + 1
        while end < last and owners[end] == owners[begin]:
            end += 1
        meet_bodies(
            lanes, (begin - first) * beams, (end - first) * beams, near, found, grid, widest,
            kinds, looks, pose, head, follow, int(owners[begin]),
        )  # fmt: skip
        begin = end


@inner
def report_lanes(
    lanes: Floats, first: int, beams: int, m: int, reach: float, ranges: Floats, names: Floats
) -> None:
    """Write down what the lanes of sensor m met."""
    for k in range(beams):
        best = lanes[BEST + first + k]
        ranges[m, k] = 1.0 / best if best > 1.0 / reach else reach
        if names.shape[0] > 0:
            names[m, k] = lanes[NAME + first + k]


@kernel
def scan_singly(
    first: int, last: int, sensors: Floats, owners: Indices, mounts: Floats, fan: Floats,
    outline: Floats, widest: float, grid: Floats, statics: Floats, start: Cells, items: Cells, lanes: Floats,
    kinds: Floats, looks: Floats, pose: Floats, head: Cells, follow: Cells, beams: Floats,
    view: Floats, stamp: Indices, walls: Floats, others: Floats, fine: Floats, first_item: Cells,
    fine_items: Cells, free: Marks, going: Floats, begins: Floats, middles: Floats, ranges: Floats,
    names: Floats,
) -> None:  # fmt: skip
    """What ``kernels_scan.scan`` does, faster for fans with few beams in a grid."""
    count = beams.shape[1]
    begin = first
    while begin < last:
        end = end_of(begin, last, MOST_LANES // count, owners)
        for m in range(begin, end):
            aim(sensors, m, owners, mounts, pose)
            put_lanes(going, (m - begin) * count, beams, 0, count, fine, sensors, m, fan[REACH])
        meet_statics(
            going, (end - begin) * count, fan[NEAR], statics, fine, first_item, fine_items, free
        )
        meet_others(
            going, begin, end, count, fan[NEAR], owners, others, grid, widest, kinds, looks, pose,
            head, follow,
        )  # fmt: skip
        for m in range(begin, end):
            if is_clear(fine, sensors[m, S_Z]):
                report_lanes(going, (m - begin) * count, count, m, fan[REACH], ranges, names)
                continue
            world = owners[m] // kinds.shape[0]
            me = kinds[owners[m] - world * kinds.shape[0], FAMILY]
            clear(beams, 1.0 / fan[REACH])
            put_view(view, outline, sensors, m, 1.0)
            draw_view(
                beams, fan, sensors, m, view, widest, grid, statics, start, items, lanes, stamp,
                kinds, looks, pose, head, follow, world, me, walls, others, False,
            )  # fmt: skip
            report(beams, m, fan[REACH], ranges, names)
        begin = end
