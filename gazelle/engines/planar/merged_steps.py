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
    DRIVE_KIND,
    FAMILY,
    MOVING,
    OMNIDIRECTIONAL,
    PASSIVE,
    RADIUS,
    SIN,
    STILL,
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
    driven,
    remember_turn,
    stride,
    twist_of,
    wanted,
)
from cython.cimports.gazelle.engines.planar.grid_cells import place_in, relink_one
from cython.cimports.gazelle.engines.planar.moving import advance_world
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # in a compiled module, what merged_steps.pxd says
    WIDE, M_ALL = 8, 88
    M_X, M_Y, M_YAW, M_COS, M_SIN, M_FORWARD, M_ASIDE, M_ANGLE = 0, 8, 16, 24, 32, 40, 48, 56
    M_TURN_COS, M_TURN_SIN, M_STEPS = 64, 72, 80

MOST_TURN = cython.declare(
    cython.double, 1.0
)  # of a step, so that a heading is wrapped by one turn [rad]
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
            for b in range(world * w.nbody, (world + 1) * w.nbody if steps > 0 else 0):
                if w.state[b] == MOVING:
                    load(w, b, steps, table, queued)
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


def keeps_velocity(w: Bodies, b: int, k: int) -> bool:
    """Return whether the next step leaves the velocity of a body as it is."""
    sideways = w.drives[k, DRIVE_KIND] == OMNIDIRECTIONAL
    return (
        driven(w, b, k, 0, w.dt) == w.velocity[b, 0]
        and (not sideways or driven(w, b, k, 1, w.dt) == w.velocity[b, 1])
        and driven(w, b, k, 2, w.dt) == w.velocity[b, 2]
    )


def expect_move(w: Bodies, b: int, k: int) -> bool:
    """Set a body's velocity and state of the next step, if nothing blocks it.

    Returns whether it keeps that velocity; else its velocity is as before along some axes, and as in the
    next step along others, which changes nothing for that step.
    """
    sideways = w.drives[k, DRIVE_KIND] == OMNIDIRECTIONAL
    for axis in range(3):
        if axis == 1 and not sideways:
            w.velocity[b, axis] = 0.0
            continue
        speed = driven(w, b, k, axis, w.dt)
        if speed != wanted(w, b, k, axis):  # nor is what is not a number
            return False
        w.velocity[b, axis] = speed
    vx, vy, turn = twist_of(w, b, k)
    w.state[b] = STILL if vx == 0.0 and vy == 0.0 and turn == 0.0 else MOVING
    if w.state[b] == MOVING:
        remember_turn(w, b, turn * w.dt)
    return True


def longest_move(w: Bodies, first: int, last: int, fresh: bool) -> float:
    """Return the longest way of a body in a step, were none blocked [m]; negative if velocities change.

    Args:
        w: All bodies.
        first: Of a world.
        last: Before it.
        fresh: Whether states are those of another time, and expected here.
    """
    longest = 0.0
    for b in range(first, last):
        k = b % w.drives.shape[0]
        if w.drives[k, DRIVE_KIND] == PASSIVE:
            w.state[b] = STILL
            continue
        if not (expect_move(w, b, k) if fresh else keeps_velocity(w, b, k)):
            return -1.0
        vx, vy, turn = twist_of(w, b, k)
        angle = w.memory[b, TURN]  # of a part of a step, if the last one had several
        if w.state[b] == MOVING and not (fabs(angle) <= MOST_TURN and angle == turn * w.dt):
            return -1.0
        longest = max(longest, vx * vx + vy * vy)
    return sqrt(longest) * w.dt


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
    for b in range(begin, end):
        if w.state[b] == MOVING and most > 0.0:
            most = min(most, free_steps(w, b, longest, most))
    return cython.cast(cython.Py_ssize_t, most)


def free_steps(w: Bodies, b: int, longest: float, most: float) -> float:
    """Return in how many steps, ``most`` at most, a moving body comes near nothing.

    Args:
        w: All bodies.
        b: The body, counted through all worlds.
        longest: Way of any body of its world in a step at most, were none blocked [m].
        most: Number of steps.
    """
    if not fabs(w.rows[b, YAW]) <= 2.0 * PI:  # it is wrapped by one turn at most
        return 0.0
    radius = w.kinds[b % w.nbody, RADIUS]
    spare = min((most + 1.0) * longest, ENOUGH * ROOM_MEASURED * radius)
    room = room_at(w, b, radius, w.rows[b, X], w.rows[b, Y], spare)
    if not room > 2.0 * longest:
        return 0.0
    if longest > 0.0:
        most = min(most, room / longest - 1.0)
    if w.nbody == 1:
        return most
    gap = gap_around(w, b, max(2.0 * longest * (most + 1.0), 2.0 * TOUCH))
    if not gap > 4.0 * longest + TOUCH:
        return 0.0
    return min(most, gap / (2.0 * longest) - 1.0) if longest > 0.0 else most


def gap_around(w: Bodies, a: int, most: float) -> float:
    """Return the distance from a body's disc to the nearest other's [m], or ``most`` if it is farther."""
    world, k = a // w.nbody, a % w.nbody
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
            b = w.head[world, cell]
            while b >= 0:
                kb = b - world * w.nbody
                if w.kinds[kb, FAMILY] != w.kinds[k, FAMILY]:
                    dx, dy = w.rows[b, X] - x, w.rows[b, Y] - y
                    apart = w.kinds[k, RADIUS] + w.kinds[kb, RADIUS]
                    square, far = dx * dx + dy * dy, apart + gap
                    if square < far * far:
                        gap = sqrt(square) - apart
                b = w.follow[b]
    return gap


def load(w: Bodies, b: int, steps: int, table: Any, column: int) -> None:
    """Write a body to a column of a table, with what it does in a step, and for how many steps."""
    k = b % w.drives.shape[0]
    vx, vy, _ = twist_of(w, b, k)
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
