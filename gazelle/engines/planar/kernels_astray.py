"""Scans whose beams each go a little beside where they should, followed one by one."""

from __future__ import annotations

import math

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
    START,
    X0,
    X1,
    Y0,
    Y1,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.compiled import kernel, part
from gazelle.engines.planar.kernels_grid import place_in
from gazelle.engines.planar.kernels_noise import stream, uniform
from gazelle.engines.planar.tables import Cells, Floats, Indices

PLACES = 1 << 40  # of the random numbers of angles, after those of ranges
_EDGE = 1e-6  # by which the grid is taken to be larger than it is [m]


@part
def distance(
    rows: Floats, p: int, x: float, y: float, dx: float, dy: float, z: float, best: float
) -> float:
    """Distance along a ray at which it meets a primitive, given in its frame; else ``best``."""
    if rows[p, GLOW] < 0.0 or z < rows[p, LOW] or z > rows[p, HIGH]:
        return best
    ax, ay = rows[p, X0] - x, rows[p, Y0] - y
    if (int(rows[p, KIND]) & int(CIRCLE)) != 0:
        along, aside, radius = dx * ax + dy * ay, dx * ay - dy * ax, rows[p, X1]
        square = radius * radius - aside * aside
        if square < 0.0:
            return best
        half = math.sqrt(square)
        t = along - half if along >= half else along + half
        return t if 0.0 <= t < best else best
    ex, ey = rows[p, X1] - rows[p, X0], rows[p, Y1] - rows[p, Y0]
    across = dx * ey - dy * ex
    if across == 0.0:
        return best
    t, share = (ax * ey - ay * ex) / across, (ax * dy - ay * dx) / across
    return t if 0.0 <= share <= 1.0 and 0.0 <= t < best else best


@part
def meet_statics(
    x: float, y: float, dx: float, dy: float, z: float, reach: float, grid: Floats,
    statics: Floats, start: Cells, items: Cells,
) -> tuple[float, float]:  # fmt: skip
    """The nearest static along a ray: distance and name."""
    side, best, name, t = grid[2], reach, 0.0, 0.0
    if start.shape[0] == 2:  # one cell, wherever they are
        for p in range(statics.shape[0]):
            met = distance(statics, p, x, y, dx, dy, z, best)
            if met < best:
                best, name = met, p + 1.0
        return best, name
    high_x, high_y = grid[0] + grid[3] * side + _EDGE, grid[1] + grid[4] * side + _EDGE
    if dx != 0.0:
        t = max(t, min((grid[0] - _EDGE - x) / dx, (high_x - x) / dx))
    if dy != 0.0:
        t = max(t, min((grid[1] - _EDGE - y) / dy, (high_y - y) / dy))
    px, py, columns, rows = x + t * dx, y + t * dy, int(grid[3]), int(grid[4])
    outside = px < grid[0] - 2.0 * _EDGE or py < grid[1] - 2.0 * _EDGE
    if outside or px > high_x + _EDGE or py > high_y + _EDGE:
        return best, name
    column, row = place_in(px, grid[0], side, grid[3]), place_in(py, grid[1], side, grid[4])
    while 0 <= column < columns and 0 <= row < rows:
        cell = row * columns + column
        for i in range(start[cell], start[cell + 1]):
            met = distance(statics, int(items[i]), x, y, dx, dy, z, best)
            if met < best:
                best, name = met, items[i] + 1.0
        next_x, next_y = math.inf, math.inf
        if dx != 0.0:
            next_x = (grid[0] + (column + (1 if dx > 0.0 else 0)) * side - x) / dx
        if dy != 0.0:
            next_y = (grid[1] + (row + (1 if dy > 0.0 else 0)) * side - y) / dy
        if min(next_x, next_y) >= best:
            break
        if next_x <= next_y:
            column += 1 if dx > 0.0 else -1
        else:
            row += 1 if dy > 0.0 else -1
    return best, name


@part
def meet_body(
    b: int, kind: int, x: float, y: float, dx: float, dy: float, z: float, best: float,
    kinds: Floats, looks: Floats, pose: Floats,
) -> tuple[float, float]:  # fmt: skip
    """The nearest primitive of a body along a ray, if it is nearer than ``best``."""
    ax, ay, name = x - pose[b, X], y - pose[b, Y], 0.0
    aside = dx * ay - dy * ax
    if abs(aside) > kinds[kind, RADIUS]:
        return best, name
    c, s = pose[b, COS], pose[b, SIN]
    px, py, vx, vy = c * ax + s * ay, c * ay - s * ax, c * dx + s * dy, c * dy - s * dx
    for p in range(int(kinds[kind, FIRST_LOOK]), int(kinds[kind, LAST_LOOK])):
        met = distance(looks, p, px, py, vx, vy, z - pose[b, Z], best)
        if met < best:
            best, name = met, NAMES * (b + 1.0) + p
    return best, name


@part
def meet_bodies(
    x: float, y: float, dx: float, dy: float, z: float, best: float, name: float, world: int,
    me: float, widest: float, grid: Floats, kinds: Floats, looks: Floats, pose: Floats,
    head: Cells, follow: Cells,
) -> tuple[float, float]:  # fmt: skip
    """The nearest body of another family along a ray, if it is nearer than ``best``."""
    x1, y1, side = x + best * dx, y + best * dy, grid[2]
    left = place_in(min(x, x1) - widest, grid[0], side, grid[3])
    right = place_in(max(x, x1) + widest, grid[0], side, grid[3])
    low = place_in(min(y, y1) - widest, grid[1], side, grid[4])
    high = place_in(max(y, y1) + widest, grid[1], side, grid[4])
    for row in range(low, high + 1):
        for column in range(left, right + 1):
            b = int(head[world, row * int(grid[3]) + column])
            while b >= 0:
                kind = b - world * kinds.shape[0]
                if kinds[kind, FAMILY] != me:
                    met, found = meet_body(b, kind, x, y, dx, dy, z, best, kinds, looks, pose)
                    if met < best:
                        best, name = met, found
                b = int(follow[b])
    return best, name


@kernel
def scan_astray(
    first: int, last: int, owners: Indices, mounts: Floats, fan: Floats, step: float,
    spread: Floats, seed: int, tick: int, widest: float, grid: Floats, statics: Floats,
    start: Cells, items: Cells, kinds: Floats, looks: Floats, pose: Floats, head: Cells,
    follow: Cells, ranges: Floats, names: Floats,
) -> None:  # fmt: skip
    """Scan with sensors first to last, with normal noise of ``spread`` [rad] on every angle."""
    count = ranges.shape[1]
    for m in range(first, last):
        b, mount = int(owners[m]), m % mounts.shape[0]
        world = b // kinds.shape[0]
        me, c, s = kinds[b - world * kinds.shape[0], FAMILY], pose[b, COS], pose[b, SIN]
        x = pose[b, X] + c * mounts[mount, S_X] - s * mounts[mount, S_Y]
        y = pose[b, Y] + s * mounts[mount, S_X] + c * mounts[mount, S_Y]
        z, random = pose[b, Z] + mounts[mount, S_Z], stream(seed, b, tick)
        along = c * mounts[mount, S_COS] - s * mounts[mount, S_SIN]
        aside = s * mounts[mount, S_COS] + c * mounts[mount, S_SIN]
        for k in range(count):
            place = PLACES + 2 * (mount * count + k)
            radius = math.sqrt(-2.0 * math.log(uniform(random, place)))
            wave = radius * math.cos(2.0 * math.pi * uniform(random, place + 1))
            angle = fan[START] + k * step + spread[mount] * wave
            vx, vy = math.cos(angle), math.sin(angle)
            dx, dy = along * vx - aside * vy, aside * vx + along * vy
            best, name = meet_statics(x, y, dx, dy, z, fan[REACH], grid, statics, start, items)
            best, name = meet_bodies(
                x, y, dx, dy, z, best, name, world, me, widest, grid, kinds, looks, pose, head,
                follow,
            )  # fmt: skip
            ranges[m, k] = best
            if names.size > 0:
                names[m, k] = name
