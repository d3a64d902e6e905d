"""Follow single beams through the grid, cell by cell, until they meet something."""

from __future__ import annotations

import math

from gazelle.engines.planar.columns import (
    CIRCLE,
    FAMILY,
    FIRST_LOOK,
    GLOW,
    HIGH,
    KIND,
    LAST_LOOK,
    LOW,
    NAMES,
    NEAR,
    REACH,
    S_COS,
    S_SIN,
    S_X,
    S_Y,
    S_Z,
    X0,
    X1,
    Y0,
    Y1,
    Z,
)
from gazelle.engines.planar.compiled import inner, part
from gazelle.engines.planar.kernels_bodies import draw_looks, find_body
from gazelle.engines.planar.kernels_fan import draw_circle, draw_segment
from gazelle.engines.planar.kernels_grid import place_in
from gazelle.engines.planar.tables import Cells, Floats

MARGIN = 1e-6  # by which the grid is taken to be larger than it is [m]


@inner
def meet_static(
    beams: Floats, k: int, fan: Floats, sensors: Floats, m: int, statics: Floats, p: int
) -> None:
    """Draw a static primitive into beam k."""
    height = sensors[m, S_Z]
    if statics[p, GLOW] < 0.0 or height < statics[p, LOW] or height > statics[p, HIGH]:
        return
    c, s = sensors[m, S_COS], sensors[m, S_SIN]
    ax, ay = statics[p, X0] - sensors[m, S_X], statics[p, Y0] - sensors[m, S_Y]
    x0, y0 = c * ax + s * ay, c * ay - s * ax
    name = p + 1.0
    if (int(statics[p, KIND]) & int(CIRCLE)) != 0:
        square = statics[p, X1] * statics[p, X1]
        cross = x0 * x0 + y0 * y0 - square
        if cross != 0.0:
            draw_circle(beams, k, k + 1, x0, y0, square, 1.0 / cross, fan[NEAR], name)
        return
    bx, by = statics[p, X1] - sensors[m, S_X], statics[p, Y1] - sensors[m, S_Y]
    x1, y1 = c * bx + s * by, c * by - s * bx
    dx, dy = beams[0, k], beams[1, k]
    cross = x0 * y1 - x1 * y0
    if cross != 0.0 and (dx * y0 - dy * x0) * (dx * y1 - dy * x1) <= 0.0:
        seen = name if cross < 0.0 else -name
        draw_segment(beams, k, k + 1, x0, y0, x1, y1, 1.0 / cross, fan[NEAR], seen)


@part
def enters(place: float, way: float, low: float, high: float) -> tuple[float, float]:
    """Between which distances a coordinate that changes by ``way`` is within bounds."""
    if way == 0.0:
        return (-math.inf, math.inf) if low <= place <= high else (math.inf, -math.inf)
    a, b = (low - place) / way, (high - place) / way
    return min(a, b), max(a, b)


@part
def follow_beam(
    beams: Floats, k: int, fan: Floats, sensors: Floats, m: int, grid: Floats, statics: Floats,
    start: Cells, items: Cells, begin: float,
) -> None:  # fmt: skip
    """Meet the statics along beam k; those nearer than ``begin`` may be left out."""
    c, s = sensors[m, S_COS], sensors[m, S_SIN]
    dx, dy = c * beams[0, k] - s * beams[1, k], s * beams[0, k] + c * beams[1, k]
    x, y, side = sensors[m, S_X], sensors[m, S_Y], grid[2]
    columns, rows = int(grid[3]), int(grid[4])
    in_x, out_x = enters(x, dx, grid[0] - MARGIN, grid[0] + columns * side + MARGIN)
    in_y, out_y = enters(y, dy, grid[1] - MARGIN, grid[1] + rows * side + MARGIN)
    t = max(in_x, in_y, begin)
    if t > min(out_x, out_y, fan[REACH]):
        return
    column = place_in(x + t * dx, grid[0], side, grid[3])
    row = place_in(y + t * dy, grid[1], side, grid[4])
    to_x, to_y = 1 if dx > 0.0 else 0, 1 if dy > 0.0 else 0
    over_x, over_y = 1.0 / dx if dx != 0.0 else math.inf, 1.0 / dy if dy != 0.0 else math.inf
    while 0 <= column < columns and 0 <= row < rows:
        cell = row * columns + column
        for i in range(start[cell], start[cell + 1]):
            meet_static(beams, k, fan, sensors, m, statics, int(items[i]))
        t_x = (grid[0] + (column + to_x) * side - x) * over_x if dx != 0.0 else math.inf
        t_y = (grid[1] + (row + to_y) * side - y) * over_y if dy != 0.0 else math.inf
        if min(t_x, t_y) * beams[2, k] >= 1.0:
            return
        if t_x <= t_y:
            column += 2 * to_x - 1
        else:
            row += 2 * to_y - 1


@inner
def meet_bodies(
    beams: Floats, k: int, fan: Floats, sensors: Floats, m: int, dx: float, dy: float,
    grid: Floats, widest: float, kinds: Floats, looks: Floats, pose: Floats, head: Cells,
    follow: Cells, world: int, me: float, others: Floats,
) -> None:  # fmt: skip
    """Meet the bodies along beam k up to what it met, but for those of the family ``me``."""
    x, y, side = sensors[m, S_X], sensors[m, S_Y], grid[2]
    x1, y1 = x + dx / beams[2, k], y + dy / beams[2, k]
    first = place_in(min(y, y1) - widest, grid[1], side, grid[4])
    last = place_in(max(y, y1) + widest, grid[1], side, grid[4])
    across = dx / dy if abs(dy) > MARGIN else 0.0
    for row in range(first, last + 1):
        left, right = min(x, x1), max(x, x1)
        if first < last and abs(dy) > MARGIN:
            low, high = grid[1] + row * side - widest, grid[1] + (row + 1) * side + widest
            low = min(low, y, y1) if row == 0 else low
            high = max(high, y, y1) if row == grid[4] - 1 else high
            enter, leave = x + (low - y) * across, x + (high - y) * across
            left, right = max(left, min(enter, leave)), min(right, max(enter, leave))
        begin = row * int(grid[3]) + place_in(left - widest, grid[0], side, grid[3])
        end = row * int(grid[3]) + place_in(right + widest, grid[0], side, grid[3])
        for cell in range(begin, end + 1):
            b = int(head[world, cell])
            while b >= 0:
                kind = b - world * kinds.shape[0]
                if kinds[kind, FAMILY] != me:
                    meet_body(beams, k, fan, sensors, m, kinds, looks, pose, kind, b, others)
                b = int(follow[b])


@inner
def meet_body(
    beams: Floats, k: int, fan: Floats, sensors: Floats, m: int, kinds: Floats, looks: Floats,
    pose: Floats, kind: int, b: int, others: Floats,
) -> None:  # fmt: skip
    """Draw body b into beam k."""
    if find_body(others, 0, fan, sensors, m, kinds, pose, kind, b) == 0:
        return
    x, y, radius = others[0, 0], others[1, 0], others[4, 0]
    aside = beams[0, k] * y - beams[1, k] * x
    if aside * aside > radius * radius:
        return
    nearest = math.sqrt(x * x + y * y) - radius
    away = nearest > 0.0 and nearest * fan[NEAR] >= 1.0
    draw_looks(
        beams, k, k + 1, fan, looks, int(kinds[kind, FIRST_LOOK]), int(kinds[kind, LAST_LOOK]),
        sensors[m, S_Z] - pose[b, Z], others, 0, away, NAMES * (b + 1.0),
    )  # fmt: skip
