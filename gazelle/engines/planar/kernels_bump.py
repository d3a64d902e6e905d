"""Who is in whose way: convex pieces against static primitives and against each other.

A move that would make a body overlap something is not made, position and heading both. It is
decided as if bodies moved one after another in the order of their indices, so that they never
overlap and the result does not depend on the number of threads: ``screen`` finds, for any
bodies at once, those that are free whatever the others do; ``settle`` takes the rest in order.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import inner, part
from gazelle.engines.planar.columns import (
    BOUND,
    CENTRE_X,
    CENTRE_Y,
    CIRCLE,
    COS,
    COUNT,
    FAMILY,
    FIRST,
    FIRST_PIECE,
    GHOST,
    HIGH,
    KIND,
    L_RADIUS,
    LAST_PIECE,
    LOW,
    MOVING,
    PIECE_HIGH,
    PIECE_LOW,
    RADIUS,
    SIN,
    UNDECIDED,
    X0,
    X1,
    Y0,
    Y1,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.kernels_grid import place_in
from gazelle.engines.planar.tables import Cells, Floats, Marks

TOUCH = 1e-9  # how far shapes may sink into each other and still only touch [m]


@part
def reaches(x: float, y: float, x0: float, y0: float, x1: float, y1: float, radius: float) -> bool:
    """Whether a disc meets a segment."""
    ex, ey = x1 - x0, y1 - y0
    square = ex * ex + ey * ey
    t = 0.0
    if square > 0.0:
        t = min(max(((x - x0) * ex + (y - y0) * ey) / square, 0.0), 1.0)
    dx, dy = x0 + t * ex - x, y0 + t * ey - y
    return bool(dx * dx + dy * dy < radius * radius)


@part
def separates(corners: Floats, i: int, j: int, x0: float, y0: float, x1: float, y1: float) -> bool:
    """Whether both points are on the right of the edge from corner i to corner j, outside."""
    ax, ay = corners[i, 0], corners[i, 1]
    ex, ey = corners[j, 0] - ax, corners[j, 1] - ay
    most = TOUCH * math.sqrt(ex * ex + ey * ey)
    left = max(ex * (y0 - ay) - ey * (x0 - ax), ex * (y1 - ay) - ey * (x1 - ax))
    return bool(left <= most)


@part
def crosses(
    corners: Floats, first: int, count: int, x0: float, y0: float, x1: float, y1: float,
) -> bool:  # fmt: skip
    """Whether a segment has a part inside a convex polygon."""
    for i in range(first, first + count):
        if separates(corners, i, i + 1 if i + 1 < first + count else first, x0, y0, x1, y1):
            return False
    ex, ey = x1 - x0, y1 - y0
    least = TOUCH * math.sqrt(ex * ex + ey * ey)
    low, high = math.inf, -math.inf
    for i in range(first, first + count):
        side = ex * (corners[i, 1] - y0) - ey * (corners[i, 0] - x0)
        low, high = min(low, side), max(high, side)
    return low < -least and high > least


@part
def piece_meets(
    pieces: Floats, corners: Floats, p: int, statics: Floats, s: int, x0: float, y0: float,
    x1: float, y1: float,
) -> bool:  # fmt: skip
    """Whether a piece meets a static primitive, given in the frame of the piece's body."""
    cx, cy = pieces[p, CENTRE_X], pieces[p, CENTRE_Y]
    bound = pieces[p, BOUND]
    first, count = int(pieces[p, FIRST]), int(pieces[p, COUNT])
    if (int(statics[s, KIND]) & int(CIRCLE)) == 0:
        if not reaches(cx, cy, x0, y0, x1, y1, bound):
            return False
        return count == 0 or crosses(corners, first, count, x0, y0, x1, y1)
    radius = statics[s, X1]
    if not reaches(x0, y0, cx, cy, cx, cy, bound + radius - TOUCH):
        return False
    return count == 0 or near_polygon(corners, first, count, x0, y0, radius - TOUCH)


@part
def near_polygon(
    corners: Floats, first: int, count: int, x: float, y: float, radius: float,
) -> bool:  # fmt: skip
    """Whether a disc meets a convex polygon."""
    inside = True
    for i in range(first, first + count):
        j = i + 1 if i + 1 < first + count else first
        ax, ay, bx, by = corners[i, 0], corners[i, 1], corners[j, 0], corners[j, 1]
        if reaches(x, y, ax, ay, bx, by, radius):
            return True
        inside = inside and (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0
    return inside


@part
def static_meets(
    b: int, k: int, kinds: Floats, pieces: Floats, corners: Floats, goal: Floats,
    statics: Floats, s: int,
) -> bool:  # fmt: skip
    """Whether body b at its goal meets a static primitive."""
    if (int(statics[s, KIND]) & int(GHOST)) != 0:
        return False
    circle = (int(statics[s, KIND]) & int(CIRCLE)) != 0
    ax, ay = statics[s, X0] - goal[b, X], statics[s, Y0] - goal[b, Y]
    bx, by = statics[s, X1] - goal[b, X], statics[s, Y1] - goal[b, Y]
    radius = kinds[k, RADIUS]
    if circle:
        bx, by = ax, ay
        radius += statics[s, X1]
    ex, ey, cross = bx - ax, by - ay, ax * by - bx * ay
    if cross * cross > radius * radius * (ex * ex + ey * ey) and not circle:
        return False
    if not reaches(0.0, 0.0, ax, ay, bx, by, radius):
        return False
    c, n = goal[b, COS], goal[b, SIN]
    x0, y0, x1, y1 = c * ax + n * ay, c * ay - n * ax, c * bx + n * by, c * by - n * bx
    for p in range(int(kinds[k, FIRST_PIECE]), int(kinds[k, LAST_PIECE])):
        low, high = goal[b, Z] + pieces[p, PIECE_LOW], goal[b, Z] + pieces[p, PIECE_HIGH]
        level = low < statics[s, HIGH] and high > statics[s, LOW]
        if level and piece_meets(pieces, corners, p, statics, s, x0, y0, x1, y1):
            return True
    return False


@inner
def any_near(lanes: Floats, x: float, y: float, radius: float) -> bool:
    """Whether any of few static primitives is within a radius of a point."""
    near = np.int64(0)
    for i in range(np.uint64(lanes.shape[1])):
        ax, ay = lanes[X0, i] - x, lanes[Y0, i] - y
        ex, ey = lanes[X1, i] - lanes[X0, i], lanes[Y1, i] - lanes[Y0, i]
        square = max(ex * ex + ey * ey, 1e-300)
        t = min(max(-(ax * ex + ay * ey) / square, 0.0), 1.0)
        dx, dy, far = ax + t * ex, ay + t * ey, radius + lanes[L_RADIUS, i]
        near += np.int64(1) if dx * dx + dy * dy < far * far else np.int64(0)
    return bool(near > 0)


@inner
def statics_meet(
    b: int, k: int, kinds: Floats, pieces: Floats, corners: Floats, goal: Floats,
    statics: Floats, grid: Floats, start: Cells, items: Cells, lanes: Floats,
) -> bool:  # fmt: skip
    """Whether body b at its goal meets anything static."""
    x, y, r = goal[b, X], goal[b, Y], kinds[k, RADIUS]
    if lanes.shape[1] > 0 and not any_near(lanes, x, y, r):
        return False
    left, right = (
        place_in(x - r, grid[0], grid[2], grid[3]),
        place_in(x + r, grid[0], grid[2], grid[3]),
    )
    low, high = (
        place_in(y - r, grid[1], grid[2], grid[4]),
        place_in(y + r, grid[1], grid[2], grid[4]),
    )
    for row in range(low, high + 1):
        base = row * int(grid[3])
        for i in range(start[base + left], start[base + right + 1]):
            if static_meets(b, k, kinds, pieces, corners, goal, statics, int(items[i])):
                return True
    return False


@part
def outside(
    corners: Floats, first: int, count: int, cos: float, sin: float, x: float, y: float,
    start: int, number: int,
) -> bool:  # fmt: skip
    """Whether an edge of a polygon separates it from another one.

    The other's frame is at (x, y, cos, sin) in the frame of the first.
    """
    for i in range(first, first + count):
        j = i + 1 if i + 1 < first + count else first
        ax, ay = corners[i, 0], corners[i, 1]
        ex, ey = corners[j, 0] - ax, corners[j, 1] - ay
        most = TOUCH * math.sqrt(ex * ex + ey * ey)
        apart = True
        for q in range(start, start + number):
            px = x + cos * corners[q, 0] - sin * corners[q, 1]
            py = y + sin * corners[q, 0] + cos * corners[q, 1]
            if ex * (py - ay) - ey * (px - ax) > most:
                apart = False
                break
        if apart:
            return True
    return False


@part
def pieces_meet(
    pieces: Floats, corners: Floats, p: int, q: int, x: float, y: float, cos: float, sin: float,
) -> bool:  # fmt: skip
    """Whether two pieces overlap; the frame of q's body is at (x, y, cos, sin) in that of p's."""
    qx = x + cos * pieces[q, CENTRE_X] - sin * pieces[q, CENTRE_Y]
    qy = y + sin * pieces[q, CENTRE_X] + cos * pieces[q, CENTRE_Y]
    px, py = pieces[p, CENTRE_X], pieces[p, CENTRE_Y]
    apart = pieces[p, BOUND] + pieces[q, BOUND] - TOUCH
    if (qx - px) ** 2 + (qy - py) ** 2 >= apart * apart:
        return False
    first, count = int(pieces[p, FIRST]), int(pieces[p, COUNT])
    start, number = int(pieces[q, FIRST]), int(pieces[q, COUNT])
    if count == 0 and number == 0:
        return True
    if number == 0:
        return bool(near_polygon(corners, first, count, qx, qy, pieces[q, BOUND] - TOUCH))
    # The frame of p's body in that of q's.
    bx, by = -cos * x - sin * y, sin * x - cos * y
    if count == 0:
        cx, cy = bx + cos * px + sin * py, by - sin * px + cos * py
        return bool(near_polygon(corners, start, number, cx, cy, pieces[p, BOUND] - TOUCH))
    if outside(corners, first, count, cos, sin, x, y, start, number):
        return False
    return not outside(corners, start, number, cos, -sin, bx, by, first, count)


@part
def bodies_meet(
    a: int, ka: int, b: int, kb: int, kinds: Floats, pieces: Floats, corners: Floats,
    goal: Floats, at: Floats,
) -> bool:  # fmt: skip
    """Whether body a at its goal overlaps body b where it is in the table ``at``."""
    ox, oy = at[b, X] - goal[a, X], at[b, Y] - goal[a, Y]
    far = kinds[ka, RADIUS] + kinds[kb, RADIUS]
    if ox * ox + oy * oy >= far * far or kinds[ka, FAMILY] == kinds[kb, FAMILY]:
        return False
    c, n = goal[a, COS], goal[a, SIN]
    x, y = c * ox + n * oy, c * oy - n * ox
    cos, sin = c * at[b, COS] + n * at[b, SIN], c * at[b, SIN] - n * at[b, COS]
    lift = at[b, Z] - goal[a, Z]
    for p in range(int(kinds[ka, FIRST_PIECE]), int(kinds[ka, LAST_PIECE])):
        for q in range(int(kinds[kb, FIRST_PIECE]), int(kinds[kb, LAST_PIECE])):
            over = pieces[q, PIECE_LOW] + lift >= pieces[p, PIECE_HIGH]
            under = pieces[q, PIECE_HIGH] + lift <= pieces[p, PIECE_LOW]
            level = not over and not under
            if level and pieces_meet(pieces, corners, p, q, x, y, cos, sin):
                return True
    return False


@part
def obstructed(
    a: int, reach: float, nbody: int, kinds: Floats, pieces: Floats, corners: Floats,
    pose: Floats, goal: Floats, state: Marks, grid: Floats, head: Cells, follow: Cells,
) -> bool:  # fmt: skip
    """Whether body a's way is barred by a body.

    For one that is MOVING: by any body, where it is or where it would be. For one that is
    UNDECIDED: by those with lower indices where they have got to, and by the others where
    they are.
    """
    ordered = state[a] == UNDECIDED
    k = a % nbody
    world = a // nbody
    x, y, r = goal[a, X], goal[a, Y], kinds[k, RADIUS] + reach
    left, right = (
        place_in(x - r, grid[0], grid[2], grid[3]),
        place_in(x + r, grid[0], grid[2], grid[3]),
    )
    low, high = (
        place_in(y - r, grid[1], grid[2], grid[4]),
        place_in(y + r, grid[1], grid[2], grid[4]),
    )
    for row in range(low, high + 1):
        base = row * int(grid[3])
        for cell in range(base + left, base + right + 1):
            b = int(head[world, cell])
            while b >= 0:
                if b != a:
                    ahead = state[b] == MOVING or state[b] == UNDECIDED
                    gone = state[b] == MOVING and b < a
                    kb = b - world * nbody
                    if (not ordered or not gone) and bodies_meet(
                        a, k, b, kb, kinds, pieces, corners, goal, pose
                    ):
                        return True
                    if (gone if ordered else ahead) and bodies_meet(
                        a, k, b, kb, kinds, pieces, corners, goal, goal
                    ):
                        return True
                b = int(follow[b])
    return False
