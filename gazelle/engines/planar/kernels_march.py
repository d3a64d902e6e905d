"""Let beams cross empty space in long strides, many of them side by side.

Statics have a grid of their own for this, the finer the more of them there are; where there is a
bitmap, its cells are that grid's. For each of four directions ``clear`` says how large a square
of empty cells begins at a cell and goes there, and last how large one is all around it: a beam
goes on to the edge of its square at once. It is 0 where primitives are listed, and negative where
a cell is solid to its edges. Marks end a little beyond edges, so that they never stand still;
primitives are listed in cells by a margin that is larger. A lane is a beam on its way.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from gazelle.engines.native import inner, kernel, part
from gazelle.engines.planar.columns import (
    GLOW,
    HIGH,
    KIND,
    LOW,
    S_COS,
    S_SIN,
    S_X,
    S_Y,
    S_Z,
    X0,
    X1,
    Y0,
    Y1,
)
from gazelle.engines.planar.tables import Cells, Floats, Marks

MOST_LANES: Final = 64

# Where in the array of lanes the first one has: where a beam starts and how it goes, in the world
# [m] and in cells, and how far a cell is [m]; how far it is, where it ends, where it leaves the
# grid or has reached its end [m]; one over the distance to what it met, and the name of that; its
# height [m]; the column and row that it is in, and how much is clear there [cells]; where in
# ``clear`` its direction begins. Distances between these are known when kernels are compiled, so
# that many lanes are handled at once.
X: Final = 0
Y: Final = 1 * MOST_LANES
DX: Final = 2 * MOST_LANES
DY: Final = 3 * MOST_LANES
U: Final = 4 * MOST_LANES
V: Final = 5 * MOST_LANES
DU: Final = 6 * MOST_LANES
DV: Final = 7 * MOST_LANES
OVER_U: Final = 8 * MOST_LANES
OVER_V: Final = 9 * MOST_LANES
AT: Final = 10 * MOST_LANES
END: Final = 11 * MOST_LANES
OUT: Final = 12 * MOST_LANES
BEST: Final = 13 * MOST_LANES
NAME: Final = 14 * MOST_LANES
HEIGHT: Final = 15 * MOST_LANES
AT_U: Final = 16 * MOST_LANES
AT_V: Final = 17 * MOST_LANES
FREE: Final = 18 * MOST_LANES
BASE: Final = 19 * MOST_LANES
LANES: Final = 20 * MOST_LANES

# A grid of clear space: corner in a frame that may be turned, sides of a cell [m], columns and
# rows, cosine and sine of how far the frame is turned, the heights between which solid cells are
# solid [m], and the name of what they are of.
CORNER_U: Final = 0
CORNER_V: Final = 1
SIDE_U: Final = 2
SIDE_V: Final = 3
COLUMNS: Final = 4
ROWS: Final = 5
TURN_COS: Final = 6
TURN_SIN: Final = 7
SOLID_LOW: Final = 8
SOLID_HIGH: Final = 9
SOLID_NAME: Final = 10
FINE: Final = 11

SIDE_BY_SIDE: Final = 32  # beams of a bundle
NUDGE: Final = 1e-9  # by which strides go beyond the edge of a cell [m]
LISTED: Final = 1e-6  # by which statics are listed in cells that they do not pass [m]
MOST_CLEAR: Final = 120  # cells
LEVEL: Final = 1e-12  # directions along an axis that are less are taken as this


@kernel
def measure_clear(solid: Marks, start: Cells, columns: int, clear: Marks) -> None:
    """Find the largest empty square from each cell on, in each direction, and around it.

    Each is one more than the least of the three before it.
    """
    cells = solid.size
    rows = cells // columns
    for quadrant in range(4):
        base = quadrant * cells
        step, line = (1, columns) if quadrant == 0 else (1, -columns)
        if quadrant > 1:
            step, line = -1, columns if quadrant == 2 else -columns  # of four
        for i in range(rows):
            row = rows - 1 - i if line > 0 else i
            for j in range(columns):
                column = columns - 1 - j if step > 0 else j
                cell = row * columns + column
                least = MOST_CLEAR
                inside = 0 <= column + step < columns
                if inside:
                    least = min(least, int(clear[base + cell + step]))
                if i > 0:
                    least = min(least, int(clear[base + cell + line]))
                if inside and i > 0:
                    least = min(least, int(clear[base + cell + line + step]))
                least = min(max(least, 0) + 1, MOST_CLEAR)
                if start[cell + 1] > start[cell]:
                    least = 0
                clear[base + cell] = -1 if solid[cell] != 0 else least
    for cell in range(cells):
        least = min(clear[cell], clear[cells + cell])
        clear[4 * cells + cell] = min(least, clear[2 * cells + cell], clear[3 * cells + cell])


@inner
def put_lanes(
    lanes: Floats, first: int, beams: Floats, base: int, count: int, fine: Floats, sensors: Floats,
    m: int, reach: float,
) -> None:  # fmt: skip
    """Start beams of sensor m, from number ``base`` on, as lanes from ``first`` on."""
    x, y, c, s = sensors[m, S_X], sensors[m, S_Y], sensors[m, S_COS], sensors[m, S_SIN]
    cos, sin, height = fine[TURN_COS], fine[TURN_SIN], sensors[m, S_Z]
    side_u, side_v, columns, rows = fine[SIDE_U], fine[SIDE_V], fine[COLUMNS], fine[ROWS]
    u = (cos * x + sin * y - fine[CORNER_U]) / side_u
    v = (cos * y - sin * x - fine[CORNER_V]) / side_v
    for k in range(np.uint64(count)):
        i = first + k
        bx, by = beams[0, base + k], beams[1, base + k]
        dx, dy = c * bx - s * by, s * bx + c * by
        lanes[X + i], lanes[Y + i], lanes[DX + i], lanes[DY + i] = x, y, dx, dy
        along, across = cos * dx + sin * dy, cos * dy - sin * dx
        along = LEVEL if abs(along) < LEVEL else along
        across = LEVEL if abs(across) < LEVEL else across
        over_u, over_v = side_u / along, side_v / across
        au, bu = -u * over_u, (columns - u) * over_u
        av, bv = -v * over_v, (rows - v) * over_v
        lanes[U + i], lanes[V + i], lanes[DU + i], lanes[DV + i] = (
            u, v, along / side_u, across / side_v,
        )  # fmt: skip
        lanes[OVER_U + i], lanes[OVER_V + i] = over_u, over_v
        lanes[AT + i] = max(0.0, max(min(au, bu), min(av, bv)) - LISTED)
        lanes[OUT + i] = min(reach, min(max(au, bu), max(av, bv)) + LISTED)
        lanes[BEST + i], lanes[NAME + i], lanes[HEIGHT + i] = 1.0 / reach, 0.0, height
        quadrant = (0.0 if along > 0.0 else 2.0) + (0.0 if across > 0.0 else 1.0)
        lanes[BASE + i] = quadrant * columns * rows


@inner
def cell_of_lane(lanes: Floats, i: int, columns: float, rows: float) -> tuple[float, float]:
    """Column and row of the cell that lane i is in."""
    u = math.floor(lanes[U + i] + lanes[AT + i] * lanes[DU + i])
    v = math.floor(lanes[V + i] + lanes[AT + i] * lanes[DV + i])
    return min(max(u, 0.0), columns - 1.0), min(max(v, 0.0), rows - 1.0)


@inner
def beyond(lanes: Floats, i: int, u: float, v: float, wide: float) -> float:
    """How far lane i is when it leaves the square of cells around (u, v)."""
    to_u = u + wide if lanes[DU + i] > 0.0 else u + 1.0 - wide
    to_v = v + wide if lanes[DV + i] > 0.0 else v + 1.0 - wide
    edge = min((to_u - lanes[U + i]) * lanes[OVER_U + i], (to_v - lanes[V + i]) * lanes[OVER_V + i])
    return float(max(lanes[AT + i], edge) + NUDGE)


@inner
def look_around(lanes: Floats, count: int, fine: Floats, clear: Marks) -> None:
    """Find where lanes are, and how much is clear there."""
    columns, rows = fine[COLUMNS], fine[ROWS]
    for i in range(np.uint64(count)):
        lanes[AT_U + i], lanes[AT_V + i] = cell_of_lane(lanes, i, columns, rows)
    for i in range(count):
        lanes[FREE + i] = clear[
            np.uint64(lanes[BASE + i] + lanes[AT_V + i] * columns + lanes[AT_U + i])
        ]


@part
def march(lanes: Floats, count: int, fine: Floats, clear: Marks) -> None:
    """Let lanes go on until each is at its end or at a cell with anything in it."""
    moving = 1
    while moving > 0:
        moving = 0
        look_around(lanes, count, fine, clear)
        for i in range(np.uint64(count)):
            free = lanes[FREE + i]
            after = beyond(lanes, i, lanes[AT_U + i], lanes[AT_V + i], free)
            go = (free > 0.0) & (lanes[AT + i] < lanes[END + i])
            lanes[AT + i] = after if go else lanes[AT + i]
            moving += 1 if go else 0


@part
def march_bundles(lanes: Floats, count: int, fine: Floats, clear: Marks, spread: float) -> None:
    """Let lanes go on as long as all beams do that are beside them.

    Args:
        lanes: The middle of each bundle.
        count: How many.
        fine: The grid.
        clear: Marks to the next one that is not empty.
        spread: How far beams are aside, as a share of the distance.
    """
    least = min(fine[SIDE_U], fine[SIDE_V])
    moving = 1
    while moving > 0:
        moving = 0
        look_around(lanes, count, fine, clear)
        for i in range(np.uint64(count)):
            at = lanes[AT + i]
            way = ((lanes[FREE + i] - 1.0) * least - at * spread) / (1.0 + spread) - LISTED
            go = (way > 0.5 * least) & (at < lanes[END + i])
            lanes[AT + i] = at + way if go else at
            moving += 1 if go else 0


@inner
def meet_static(lanes: Floats, i: int, statics: Floats, p: int, near: float) -> None:
    """Let lane i meet a static primitive; what it meets from inside has a negative name."""
    height = lanes[HEIGHT + i]
    if statics[p, GLOW] < 0.0 or height < statics[p, LOW] or height > statics[p, HIGH]:
        return
    dx, dy = lanes[DX + i], lanes[DY + i]
    x0, y0 = statics[p, X0] - lanes[X + i], statics[p, Y0] - lanes[Y + i]
    if (int(statics[p, KIND]) & 1) != 0:
        meet_disc(lanes, i, dx, dy, x0, y0, statics[p, X1], near, p + 1.0)
        return
    x1, y1 = statics[p, X1] - lanes[X + i], statics[p, Y1] - lanes[Y + i]
    meet_segment(lanes, i, dx * y0 - dy * x0, dx * y1 - dy * x1, x0 * y1 - x1 * y0, near, p + 1.0)


@inner
def meet_segment(
    lanes: Floats, i: int, c0: float, c1: float, cross: float, near: float, name: float
) -> None:
    """Let lane i meet a segment whose ends are c0 and c1 aside of it."""
    if c0 * c1 <= 0.0 and cross != 0.0:
        v = (c1 - c0) / cross
        if v > lanes[BEST + i] and v <= near:
            lanes[BEST + i] = v
            lanes[NAME + i] = name if cross < 0.0 else -name


@inner
def meet_disc(
    lanes: Floats, i: int, dx: float, dy: float, x: float, y: float, radius: float, near: float,
    name: float,
) -> None:  # fmt: skip
    """Let lane i, whose direction is (dx, dy), meet a circle about a point seen from its start."""
    along, aside = dx * x + dy * y, dx * y - dy * x
    rest, cross = radius * radius - aside * aside, x * x + y * y - radius * radius
    if rest >= 0.0 and cross != 0.0:
        root = math.sqrt(rest)
        front, back = (along + root) / cross, (along - root) / cross
        facing = front > 0.0 and front <= near
        v = front if facing else back
        if v > lanes[BEST + i] and v <= near:
            lanes[BEST + i] = v
            lanes[NAME + i] = name if facing else -name


@part
def meet_statics(
    lanes: Floats, count: int, near: float, statics: Floats, fine: Floats, start: Cells,
    items: Cells, clear: Marks,
) -> None:  # fmt: skip
    """Let lanes go on until each has met the nearest static primitive, or is at its end."""
    for i in range(np.uint64(count)):
        lanes[END + i] = lanes[OUT + i]
    march(lanes, count, fine, clear)
    columns, rows = fine[COLUMNS], fine[ROWS]
    for i in range(count):
        end = lanes[END + i]
        begun, solid = lanes[AT + i] > 0.0, False  # whether it is in what it began in
        while lanes[AT + i] < end:
            u, v = cell_of_lane(lanes, i, columns, rows)
            cell = int(v * columns + u)
            wide = float(clear[int(lanes[BASE + i]) + cell])
            way = lanes[AT + i] - NUDGE
            if not begun or way <= NUDGE:  # on an edge it may seem to be on either side
                begun, solid = True, wide < 0.0
            elif (wide < 0.0) != solid:
                met = 1.0 / way
                if met > lanes[BEST + i]:
                    lanes[BEST + i] = met
                    lanes[NAME + i] = -fine[SOLID_NAME] if solid else fine[SOLID_NAME]
                break
            if wide <= 0.0:
                for k in range(start[cell], start[cell + 1]):
                    meet_static(lanes, i, statics, int(items[k]), near)
                end = min(end, 1.0 / lanes[BEST + i])
                wide = 1.0
            lanes[AT + i] = beyond(lanes, i, u, v, wide)


@inner
def is_clear(fine: Floats, height: float) -> bool:
    """Whether what is solid is so at a height; if not, beams do not go through clear space."""
    if fine[SOLID_NAME] == 0.0:
        return True
    return bool((height >= fine[SOLID_LOW]) & (height <= fine[SOLID_HIGH]))
