# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
# ruff: noqa: FBT001  # kernels take their arguments in order
"""Overlap tests: convex pieces against static primitives and against each other.

A move that would make a body overlap something is not made, position and heading both. It is
decided as if bodies moved one after another in the order of their indices, so that they never
overlap and the result does not depend on the number of threads: ``screen`` finds, for any
bodies at once, those that are free whatever the others do; ``settle`` takes the rest in order.
"""

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import (
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
    ROOM,
    ROOM_X,
    ROOM_Y,
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
from cython.cimports.gazelle.engines.planar.grid_cells import place_in
from cython.cimports.libc.math import sqrt

TOUCH = 1e-9  # how far shapes may sink into each other and still only touch [m]

FEW = cython.declare(cython.Py_ssize_t, 16)  # statics up to which all are gone through at once
ROOM_MEASURED = 0.5  # radii of a body up to which room is measured
INFINITE = cython.declare(cython.double, float("inf"))
STEPS = cython.declare(cython.double, 4.0)  # minimum number of steps to merge


def reaches(x: float, y: float, x0: float, y0: float, x1: float, y1: float, radius: float) -> bool:
    """Return whether a disc meets a segment."""
    ex, ey = x1 - x0, y1 - y0
    square = ex * ex + ey * ey
    t = 0.0
    if square > 0.0:
        t = min(max(((x - x0) * ex + (y - y0) * ey) / square, 0.0), 1.0)
    dx, dy = x0 + t * ex - x, y0 + t * ey - y
    return dx * dx + dy * dy < radius * radius


def separates(w: Bodies, i: int, j: int, x0: float, y0: float, x1: float, y1: float) -> bool:
    """Return whether both points are on the right of the edge from corner i to corner j, outside."""
    ax, ay = w.corners[i, 0], w.corners[i, 1]
    ex, ey = w.corners[j, 0] - ax, w.corners[j, 1] - ay
    most = TOUCH * sqrt(ex * ex + ey * ey)
    left = max(ex * (y0 - ay) - ey * (x0 - ax), ex * (y1 - ay) - ey * (x1 - ax))
    return left <= most


def crosses(w: Bodies, first: int, count: int, x0: float, y0: float, x1: float, y1: float) -> bool:
    """Return whether a segment has a part inside a convex polygon."""
    for i in range(first, first + count):
        if separates(w, i, i + 1 if i + 1 < first + count else first, x0, y0, x1, y1):
            return False
    ex, ey = x1 - x0, y1 - y0
    least = TOUCH * sqrt(ex * ex + ey * ey)
    low, high = 1e300, -1e300
    for i in range(first, first + count):
        side = ex * (w.corners[i, 1] - y0) - ey * (w.corners[i, 0] - x0)
        low, high = min(low, side), max(high, side)
    return low < -least and high > least


def near_polygon(w: Bodies, first: int, count: int, x: float, y: float, radius: float) -> bool:
    """Return whether a disc meets a convex polygon."""
    inside = True
    for i in range(first, first + count):
        j = i + 1 if i + 1 < first + count else first
        ax, ay, bx, by = w.corners[i, 0], w.corners[i, 1], w.corners[j, 0], w.corners[j, 1]
        if reaches(x, y, ax, ay, bx, by, radius):
            return True
        inside = inside and (bx - ax) * (y - ay) - (by - ay) * (x - ax) > 0.0
    return inside


def piece_meets(w: Bodies, p: int, s: int, x0: float, y0: float, x1: float, y1: float) -> bool:
    """Return whether a piece meets a static primitive, given in the frame of the piece's body."""
    cx, cy, bound = w.pieces[p, CENTRE_X], w.pieces[p, CENTRE_Y], w.pieces[p, BOUND]
    first = cython.cast(cython.Py_ssize_t, w.pieces[p, FIRST])
    count = cython.cast(cython.Py_ssize_t, w.pieces[p, COUNT])
    if (cython.cast(cython.int, w.statics[s, KIND]) & CIRCLE) == 0:
        if not reaches(cx, cy, x0, y0, x1, y1, bound):
            return False
        return count == 0 or crosses(w, first, count, x0, y0, x1, y1)
    radius = w.statics[s, X1]
    if not reaches(x0, y0, cx, cy, cx, cy, bound + radius - TOUCH):
        return False
    return count == 0 or near_polygon(w, first, count, x0, y0, radius - TOUCH)


def static_meets(w: Bodies, b: int, k: int, s: int) -> bool:
    """Return whether body b, of kind k, at its goal meets a static primitive."""
    kind = cython.cast(cython.int, w.statics[s, KIND])
    if (kind & GHOST) != 0:
        return False
    circle = (kind & CIRCLE) != 0
    ax, ay = w.statics[s, X0] - w.goal[b, X], w.statics[s, Y0] - w.goal[b, Y]
    bx, by = w.statics[s, X1] - w.goal[b, X], w.statics[s, Y1] - w.goal[b, Y]
    radius = w.kinds[k, RADIUS]
    if circle:
        bx, by = ax, ay
        radius += w.statics[s, X1]
    ex, ey, cross = bx - ax, by - ay, ax * by - bx * ay
    if cross * cross > radius * radius * (ex * ex + ey * ey) and not circle:
        return False
    if not reaches(0.0, 0.0, ax, ay, bx, by, radius):
        return False
    c, n = w.goal[b, COS], w.goal[b, SIN]
    x0, y0, x1, y1 = c * ax + n * ay, c * ay - n * ax, c * bx + n * by, c * by - n * bx
    first = cython.cast(cython.Py_ssize_t, w.kinds[k, FIRST_PIECE])
    last = cython.cast(cython.Py_ssize_t, w.kinds[k, LAST_PIECE])
    for p in range(first, last):
        low, high = w.goal[b, Z] + w.pieces[p, PIECE_LOW], w.goal[b, Z] + w.pieces[p, PIECE_HIGH]
        level = low < w.statics[s, HIGH] and high > w.statics[s, LOW]
        if level and piece_meets(w, p, s, x0, y0, x1, y1):
            return True
    return False


def any_near(w: Bodies, x: float, y: float, radius: float) -> bool:
    """Return whether any of few static primitives is within a radius of a point."""
    near = 0
    for i in range(w.lanes.shape[1]):
        ax, ay = w.lanes[X0, i] - x, w.lanes[Y0, i] - y
        ex, ey = w.lanes[X1, i] - w.lanes[X0, i], w.lanes[Y1, i] - w.lanes[Y0, i]
        square = max(ex * ex + ey * ey, 1e-300)
        t = min(max(-(ax * ex + ay * ey) / square, 0.0), 1.0)
        dx, dy, far = ax + t * ex, ay + t * ey, radius + w.lanes[L_RADIUS, i]
        near += dx * dx + dy * dy < far * far
    return near > 0


def distance_of(w: Bodies, s: int, x: float, y: float) -> float:
    """Return the distance of a point from a static primitive, at any height [m]; negative within a circle."""
    kind = cython.cast(cython.int, w.statics[s, KIND])
    if (kind & GHOST) != 0:
        return INFINITE
    x0, y0 = w.statics[s, X0] - x, w.statics[s, Y0] - y
    if (kind & CIRCLE) != 0:
        return sqrt(x0 * x0 + y0 * y0) - w.statics[s, X1]
    ex, ey = w.statics[s, X1] - x - x0, w.statics[s, Y1] - y - y0
    square = max(ex * ex + ey * ey, 1e-300)
    t = min(max(-(x0 * ex + y0 * ey) / square, 0.0), 1.0)
    dx, dy = x0 + t * ex, y0 + t * ey
    return sqrt(dx * dx + dy * dy)


def room_at(w: Bodies, b: int, radius: float, x: float, y: float, wanted: float) -> float:
    """Return how far at least a body's disc at a point is from all that is static [m].

    Negative where the disc, which no height limits, meets something. The distance is remembered, as it
    changes by no more than the way between two points. It is measured up to half a radius.

    Args:
        w: All bodies.
        b: The body, counted through all worlds.
        radius: Of its disc [m].
        x: Of the point [m].
        y: Likewise.
        wanted: It is measured again where what is remembered does not say that it is so far [m].
    """
    dx, dy, room = x - w.memory[b, ROOM_X], y - w.memory[b, ROOM_Y], w.memory[b, ROOM]
    way = sqrt(dx * dx + dy * dy)
    if room - way >= wanted or room + way < 0.0:
        return room - way
    room = ROOM_MEASURED * radius
    r = radius + room
    left = place_in(x - r, w.near_grid[0], w.near_grid[2], w.near_grid[3])
    right = place_in(x + r, w.near_grid[0], w.near_grid[2], w.near_grid[3])
    low = place_in(y - r, w.near_grid[1], w.near_grid[2], w.near_grid[4])
    high = place_in(y + r, w.near_grid[1], w.near_grid[2], w.near_grid[4])
    for row in range(low, high + 1):
        base = row * cython.cast(cython.Py_ssize_t, w.near_grid[3])
        for i in range(w.near_start[base + left], w.near_start[base + right + 1]):
            room = min(room, distance_of(w, w.near_items[i], x, y) - radius - TOUCH)
    w.memory[b, ROOM_X], w.memory[b, ROOM_Y], w.memory[b, ROOM] = x, y, room
    return room


def has_room(w: Bodies, b: int, radius: float) -> bool:
    """Return whether a body's disc at its goal is known to meet nothing static.

    Room is looked for only where a body does not leave it at once.
    """
    x, y = w.goal[b, X], w.goal[b, Y]
    dx, dy = STEPS * (x - w.rows[b, X]), STEPS * (y - w.rows[b, Y])
    spare = ROOM_MEASURED * radius
    if not dx * dx + dy * dy < spare * spare:
        return False
    return room_at(w, b, radius, x, y, 0.0) > 0.0


def statics_meet(w: Bodies, b: int, k: int) -> bool:
    """Return whether body b, of kind k, at its goal meets anything static."""
    x, y, r = w.goal[b, X], w.goal[b, Y], w.kinds[k, RADIUS]
    if has_room(w, b, r):
        return False
    if 0 < w.lanes.shape[1] <= FEW and not any_near(w, x, y, r):
        return False
    left = place_in(x - r, w.near_grid[0], w.near_grid[2], w.near_grid[3])
    right = place_in(x + r, w.near_grid[0], w.near_grid[2], w.near_grid[3])
    low = place_in(y - r, w.near_grid[1], w.near_grid[2], w.near_grid[4])
    high = place_in(y + r, w.near_grid[1], w.near_grid[2], w.near_grid[4])
    for row in range(low, high + 1):
        base = row * cython.cast(cython.Py_ssize_t, w.near_grid[3])
        for i in range(w.near_start[base + left], w.near_start[base + right + 1]):
            if static_meets(w, b, k, w.near_items[i]):
                return True
    return False


def outside(
    w: Bodies, first: int, count: int, cos: float, sin: float, x: float, y: float,
    start: int, number: int,
) -> bool:  # fmt: skip
    """Return whether an edge of a polygon separates it from another one.

    The other's frame is at (x, y, cos, sin) in the frame of the first.
    """
    for i in range(first, first + count):
        j = i + 1 if i + 1 < first + count else first
        ax, ay = w.corners[i, 0], w.corners[i, 1]
        ex, ey = w.corners[j, 0] - ax, w.corners[j, 1] - ay
        most = TOUCH * sqrt(ex * ex + ey * ey)
        apart = True
        for q in range(start, start + number):
            px = x + cos * w.corners[q, 0] - sin * w.corners[q, 1]
            py = y + sin * w.corners[q, 0] + cos * w.corners[q, 1]
            if ex * (py - ay) - ey * (px - ax) > most:
                apart = False
                break
        if apart:
            return True
    return False


def pieces_meet(w: Bodies, p: int, q: int, x: float, y: float, cos: float, sin: float) -> bool:
    """Return whether two pieces overlap; the frame of q's body is at (x, y, cos, sin) in that of p's."""
    qx = x + cos * w.pieces[q, CENTRE_X] - sin * w.pieces[q, CENTRE_Y]
    qy = y + sin * w.pieces[q, CENTRE_X] + cos * w.pieces[q, CENTRE_Y]
    px, py = w.pieces[p, CENTRE_X], w.pieces[p, CENTRE_Y]
    apart = w.pieces[p, BOUND] + w.pieces[q, BOUND] - TOUCH
    if (qx - px) * (qx - px) + (qy - py) * (qy - py) >= apart * apart:
        return False
    first = cython.cast(cython.Py_ssize_t, w.pieces[p, FIRST])
    count = cython.cast(cython.Py_ssize_t, w.pieces[p, COUNT])
    start = cython.cast(cython.Py_ssize_t, w.pieces[q, FIRST])
    number = cython.cast(cython.Py_ssize_t, w.pieces[q, COUNT])
    if count == 0 and number == 0:
        return True
    if number == 0:
        return near_polygon(w, first, count, qx, qy, w.pieces[q, BOUND] - TOUCH)
    # The frame of p's body in that of q's.
    bx, by = -cos * x - sin * y, sin * x - cos * y
    if count == 0:
        cx, cy = bx + cos * px + sin * py, by - sin * px + cos * py
        return near_polygon(w, start, number, cx, cy, w.pieces[p, BOUND] - TOUCH)
    if outside(w, first, count, cos, sin, x, y, start, number):
        return False
    return not outside(w, start, number, cos, -sin, bx, by, first, count)


def bodies_meet(w: Bodies, a: int, ka: int, b: int, kb: int, gone: bool) -> bool:
    """Return whether body a at its goal overlaps body b where it is, or at its goal if ``gone``."""
    at_x = w.goal[b, X] if gone else w.rows[b, X]
    at_y = w.goal[b, Y] if gone else w.rows[b, Y]
    ox, oy = at_x - w.goal[a, X], at_y - w.goal[a, Y]
    far = w.kinds[ka, RADIUS] + w.kinds[kb, RADIUS]
    if ox * ox + oy * oy >= far * far or w.kinds[ka, FAMILY] == w.kinds[kb, FAMILY]:
        return False
    at_cos = w.goal[b, COS] if gone else w.rows[b, COS]
    at_sin = w.goal[b, SIN] if gone else w.rows[b, SIN]
    at_z = w.goal[b, Z] if gone else w.rows[b, Z]
    c, n = w.goal[a, COS], w.goal[a, SIN]
    x, y = c * ox + n * oy, c * oy - n * ox
    cos, sin = c * at_cos + n * at_sin, c * at_sin - n * at_cos
    lift = at_z - w.goal[a, Z]
    first = cython.cast(cython.Py_ssize_t, w.kinds[ka, FIRST_PIECE])
    last = cython.cast(cython.Py_ssize_t, w.kinds[ka, LAST_PIECE])
    begin = cython.cast(cython.Py_ssize_t, w.kinds[kb, FIRST_PIECE])
    end = cython.cast(cython.Py_ssize_t, w.kinds[kb, LAST_PIECE])
    for p in range(first, last):
        for q in range(begin, end):
            over = w.pieces[q, PIECE_LOW] + lift >= w.pieces[p, PIECE_HIGH]
            under = w.pieces[q, PIECE_HIGH] + lift <= w.pieces[p, PIECE_LOW]
            if not over and not under and pieces_meet(w, p, q, x, y, cos, sin):
                return True
    return False


def obstructed(w: Bodies, a: int, reach: float) -> bool:
    """Return whether a body blocks body a.

    For one that is MOVING: by any body, where it is or where it would be. For one that is
    UNDECIDED: by those with lower indices where they have got to, and by the others where
    they are.
    """
    ordered = w.state[a] == UNDECIDED
    k, world = a % w.nbody, a // w.nbody
    x, y, r = w.goal[a, X], w.goal[a, Y], w.kinds[k, RADIUS] + reach
    if w.head.shape[1] == 1:
        return bars_in(w, a, k, world, 0, ordered)
    left = place_in(x - r, w.grid[0], w.grid[2], w.grid[3])
    right = place_in(x + r, w.grid[0], w.grid[2], w.grid[3])
    low = place_in(y - r, w.grid[1], w.grid[2], w.grid[4])
    high = place_in(y + r, w.grid[1], w.grid[2], w.grid[4])
    for row in range(low, high + 1):
        base = row * cython.cast(cython.Py_ssize_t, w.grid[3])
        for cell in range(base + left, base + right + 1):
            if bars_in(w, a, k, world, cell, ordered):
                return True
    return False


def bars_in(w: Bodies, a: int, k: int, world: int, cell: int, ordered: bool) -> bool:
    """Return whether a body in a cell blocks body a; see ``obstructed``."""
    b = w.head[world, cell]
    while b >= 0:
        if b != a and bars(w, a, k, b, b - world * w.nbody, ordered):
            return True
        b = w.follow[b]
    return False


def bars(w: Bodies, a: int, k: int, b: int, kb: int, ordered: bool) -> bool:
    """Return whether body b blocks body a; see ``obstructed``."""
    ahead = w.state[b] == MOVING or w.state[b] == UNDECIDED
    gone = w.state[b] == MOVING and b < a
    if (not ordered or not gone) and bodies_meet(w, a, k, b, kb, False):
        return True
    return (gone if ordered else ahead) and bodies_meet(w, a, k, b, kb, True)
