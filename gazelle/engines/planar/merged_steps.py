# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
# ruff: noqa: FBT001  # kernels take their arguments in order
"""Many steps at once of bodies that keep their velocities and meet nothing meanwhile.

They have the same bits as steps one after another: the same operations, without looking for what is in
the way where that is known to be too far away, and for several bodies at once.
"""

from __future__ import annotations

from typing import Any

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.collision import ROOM_MEASURED, TOUCH, room_at
from cython.cimports.gazelle.engines.planar.columns import (
    COS,
    FAMILY,
    MOVING,
    RADIUS,
    SIN,
    TURN,
    TURN_COS,
    TURN_SIN,
    YAW,
    X,
    Y,
)
from cython.cimports.gazelle.engines.planar.drive_motion import (
    PI,
    count_substeps,
    longest_move,
    stride,
    twist_of,
)
from cython.cimports.gazelle.engines.planar.grid_cells import place_in, relink_one
from cython.cimports.gazelle.engines.planar.moving import advance_world
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # in a compiled module, what merged_steps.pxd says
    WIDE, M_ALL = 8, 88
    M_X, M_Y, M_YAW, M_COS, M_SIN, M_FORWARD, M_ASIDE, M_ANGLE = 0, 8, 16, 24, 32, 40, 48, 56
    M_TURN_COS, M_TURN_SIN, M_STEPS = 64, 72, 80

MOST_PAUSE = cython.declare(cython.Py_ssize_t, 16)  # steps until merging is tried again
ENOUGH = cython.declare(cython.double, 0.5)  # of the room that can be measured


@cython.cclass
class Moving(System):
    """A step of all bodies, world by world.

    Args:
        bodies: Moving bodies.
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self)
        self.bodies = bodies
        self.mergeable = True

    def update(self, first: int, last: int, time: int) -> None:
        """Advance the worlds first to last by a step."""
        self.update_steps(first, last, time, 1)

    def update_steps(self, first: int, last: int, time: int, count: int) -> None:  # noqa: ARG002
        """Advance the worlds first to last by ``count`` steps."""
        advance_worlds(self.bodies, first, last, count)


def advance_worlds(w: Bodies, first: int, last: int, count: int) -> None:
    """Advance the worlds first to last by ``count`` steps."""
    table = cython.declare(cython.double[M_ALL])
    which = cython.declare(cython.Py_ssize_t[WIDE])
    for i in range(M_ALL):
        table[i] = 0.0
    queued = 0
    for world in range(first, last):
        left, pause = count, 1
        while left > 0:
            steps = steps_alike(w, world, left, True)
            if steps == 0:
                for _ in range(min(pause, left)):
                    advance_world(w, world)
                left -= min(pause, left)
                steps = steps_alike(w, world, left, False) if left > 0 else 0
                pause = 1 if steps > 0 else min(2 * pause, MOST_PAUSE)
            left -= steps
            for k in range(w.nbody if steps > 0 else 0):
                b = world * w.nbody + k
                if w.state[b] == MOVING:
                    load(w, b, k, steps, table, queued)
                    which[queued] = b
                    queued += 1
                    if queued == WIDE:
                        advance_queued(w, table, which, queued)
                        queued = 0
            if left > 0 and steps > 0:  # the world goes on from there
                advance_queued(w, table, which, queued)
                queued = 0
    advance_queued(w, table, which, queued)


def advance_queued(w: Bodies, table: Any, which: Any, number: int) -> None:
    """Make the steps of a table's first bodies, and write the bodies back."""
    drive(table, number)
    store(w, table, which, number)


def steps_alike(w: Bodies, world: int, left: int, fresh: bool) -> int:
    """Return a number of steps, at most those left, in which all bodies of a world do the same.

    Those that move keep moving with the same velocity and come near nothing, the others stay: as in the
    last step, or if ``fresh`` as they would in the next if nothing blocked them.
    """
    begin, end = world * w.nbody, (world + 1) * w.nbody
    if w.sweep and count_substeps(w, begin, end) > 1:
        return 0
    longest = longest_move(w, begin, end, fresh)
    most = 0.0 if longest < 0.0 else 1.0 * left
    for k in range(w.nbody):
        if w.state[begin + k] == MOVING and most > 0.0:
            most = min(most, free_steps(w, world, k, longest, most))
    return cython.cast(cython.Py_ssize_t, most)


def free_steps(w: Bodies, world: int, k: int, longest: float, most: float) -> float:
    """Return in how many steps, ``most`` at most, a moving body comes near nothing.

    Args:
        w: All bodies.
        world: Of the body.
        k: Its kind.
        longest: Way of any body of its world in a step at most, were none blocked [m].
        most: Number of steps.
    """
    b = world * w.nbody + k
    if not fabs(w.rows[b, YAW]) <= 2.0 * PI:  # it is wrapped by one turn at most
        return 0.0
    radius = w.kinds[k, RADIUS]
    spare = min((most + 1.0) * longest, ENOUGH * ROOM_MEASURED * radius)
    room = room_at(w, b, radius, w.rows[b, X], w.rows[b, Y], spare)
    if not room > 2.0 * longest:
        return 0.0
    if longest > 0.0:
        most = min(most, room / longest - 1.0)
    if w.nbody == 1:
        return most
    gap = gap_around(w, world, k, max(2.0 * longest * (most + 1.0), 2.0 * TOUCH))
    if not gap > 4.0 * longest + TOUCH:
        return 0.0
    return min(most, gap / (2.0 * longest) - 1.0) if longest > 0.0 else most


def gap_around(w: Bodies, world: int, k: int, most: float) -> float:
    """Return the distance from a body's disc to the nearest other's [m], or ``most`` if it is farther."""
    if w.head.shape[1] == 1:
        return gap_in(w, world, k, 0, most)
    a = world * w.nbody + k
    x, y = w.rows[a, X], w.rows[a, Y]
    r = w.kinds[k, RADIUS] + w.widest + most
    left = place_in(x - r, w.grid[0], w.grid[2], w.grid[3])
    right = place_in(x + r, w.grid[0], w.grid[2], w.grid[3])
    low = place_in(y - r, w.grid[1], w.grid[2], w.grid[4])
    high = place_in(y + r, w.grid[1], w.grid[2], w.grid[4])
    gap = most
    for row in range(low, high + 1):
        base = row * cython.cast(cython.Py_ssize_t, w.grid[3])
        for cell in range(base + left, base + right + 1):
            gap = gap_in(w, world, k, cell, gap)
    return gap


def gap_in(w: Bodies, world: int, k: int, cell: int, most: float) -> float:
    """Return the same as ``gap_around`` among the bodies in a cell."""
    begin, gap = world * w.nbody, most
    x, y = w.rows[begin + k, X], w.rows[begin + k, Y]
    radius, family = w.kinds[k, RADIUS], w.kinds[k, FAMILY]
    b = w.head[world, cell]
    while b >= 0:
        if w.kinds[b - begin, FAMILY] != family:
            dx, dy = w.rows[b, X] - x, w.rows[b, Y] - y
            apart = radius + w.kinds[b - begin, RADIUS]
            square, far = dx * dx + dy * dy, apart + gap
            if square < far * far:
                gap = sqrt(square) - apart
        b = w.follow[b]
    return gap


def load(w: Bodies, b: int, k: int, steps: int, table: Any, column: int) -> None:
    """Write a body to a column of a table, with what it does in a step, and for how many steps."""
    vx, vy, _ = twist_of(w, b, k if w.drives.shape[0] > 1 else 0)
    forward, aside = stride(w, b, vx, vy, w.dt)
    table[M_X + column], table[M_Y + column] = w.rows[b, X], w.rows[b, Y]
    table[M_YAW + column] = w.rows[b, YAW]
    table[M_COS + column], table[M_SIN + column] = w.rows[b, COS], w.rows[b, SIN]
    table[M_FORWARD + column], table[M_ASIDE + column] = forward, aside
    table[M_ANGLE + column] = w.memory[b, TURN]
    table[M_TURN_COS + column] = w.memory[b, TURN_COS]
    table[M_TURN_SIN + column] = w.memory[b, TURN_SIN]
    table[M_STEPS + column] = steps


def drive(table: Any, number: int) -> None:
    """Make the steps of a table's first bodies, as ``drive_motion.go`` does."""
    most = 0.0
    for i in range(WIDE):
        table[M_STEPS + i] = table[M_STEPS + i] if i < number else 0.0
        most = max(most, table[M_STEPS + i])
    for k in range(cython.cast(cython.Py_ssize_t, most)):
        for i in range(WIDE):
            going = k < table[M_STEPS + i]
            c, s = table[M_COS + i], table[M_SIN + i]
            forward, aside = table[M_FORWARD + i], table[M_ASIDE + i]
            x = table[M_X + i] + c * forward - s * aside
            y = table[M_Y + i] + s * forward + c * aside
            yaw = table[M_YAW + i] + table[M_ANGLE + i]
            yaw = yaw - 2.0 * PI if yaw > PI else yaw + 2.0 * PI if yaw < -PI else yaw
            cosine, sine = table[M_TURN_COS + i], table[M_TURN_SIN + i]
            ahead, across = c * cosine - s * sine, s * cosine + c * sine
            unit = 1.5 - 0.5 * (ahead * ahead + across * across)
            table[M_X + i] = x if going else table[M_X + i]
            table[M_Y + i] = y if going else table[M_Y + i]
            table[M_YAW + i] = yaw if going else table[M_YAW + i]
            table[M_COS + i] = ahead * unit if going else c
            table[M_SIN + i] = across * unit if going else s


def store(w: Bodies, table: Any, which: Any, number: int) -> None:
    """Write a table's first bodies back."""
    for i in range(number):
        b = which[i]
        w.rows[b, X], w.rows[b, Y], w.rows[b, YAW] = (
            table[M_X + i],
            table[M_Y + i],
            table[M_YAW + i],
        )
        w.rows[b, COS], w.rows[b, SIN] = table[M_COS + i], table[M_SIN + i]
        w.stalled[b] = 0
        if w.head.shape[1] > 1:
            relink_one(w, b)
