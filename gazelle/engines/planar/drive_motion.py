# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
# ruff: noqa: FBT001  # kernels take their arguments in order
"""Motion of bodies in a step: limits, drives and the path along an arc."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import (
    BLOCKED,
    BRAKE,
    CAR,
    COS,
    DIFFERENTIAL,
    DRIVE_KIND,
    FASTEST,
    FREE,
    MOVING,
    OMNIDIRECTIONAL,
    PASSIVE,
    PUSH,
    RADIUS,
    SIN,
    SLOWEST,
    STILL,
    STRIDE,
    TURN,
    TURN_ACROSS,
    TURN_AHEAD,
    TURN_COS,
    TURN_SIN,
    WHEELBASE,
    YAW,
    X,
    Y,
    Z,
)
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import ceil, fabs, floor, isfinite, sqrt

MOST_LOOKS = 1000.0
PI = 3.141592653589793
MOST_TURN = 1.0  # of a merged step, so that a heading is wrapped by one turn [rad]


def bounded(w: Bodies, value: float, k: int, axis: int) -> float:
    """Return a velocity along an axis within the bounds of a drive."""
    return min(max(value, w.drives[k, SLOWEST + axis]), w.drives[k, FASTEST + axis])


def toward(w: Bodies, now: float, target: float, k: int, axis: int, dt: float) -> float:
    """Return the velocity along an axis after a step, within a drive's bounds of acceleration."""
    change = target - now
    least, most = w.drives[k, BRAKE + axis] * dt, w.drives[k, PUSH + axis] * dt
    return target if least <= change <= most else now + min(max(change, least), most)


def turned(angle: float) -> tuple[float, float, float, float]:
    """Return sin(a), cos(a), sin(a) / a and (1 - cos(a)) / a; by their series where a is small."""
    if abs(angle) > 0.5:
        s, c = sin(angle), cos(angle)
        return s, c, s / angle, (1.0 - c) / angle
    q = angle * angle
    sine = 1.0 - q * (1.0 / 6.0) * (
        1.0 - q * (1.0 / 20.0) * (
            1.0 - q * (1.0 / 42.0) * (1.0 - q * (1.0 / 72.0) * (1.0 - q * (1.0 / 110.0) * (1.0 - q * (1.0 / 156.0))))
        )
    )  # fmt: skip
    versed = 0.5 * (
        1.0 - q * (1.0 / 12.0) * (
            1.0 - q * (1.0 / 30.0) * (1.0 - q * (1.0 / 56.0) * (1.0 - q * (1.0 / 90.0) * (1.0 - q * (1.0 / 132.0))))
        )
    )  # fmt: skip
    return angle * sine, 1.0 - q * versed, sine, angle * versed


def remember_turn(w: Bodies, b: int, angle: float) -> None:
    """Compute the sine and the like of a body's turn in a step, unless the last was the same."""
    if angle != w.memory[b, TURN]:
        sine, cosine, ahead, across = turned(angle)
        w.memory[b, TURN], w.memory[b, TURN_SIN], w.memory[b, TURN_COS] = angle, sine, cosine
        w.memory[b, TURN_AHEAD], w.memory[b, TURN_ACROSS] = ahead, across


def stride(w: Bodies, b: int, vx: float, vy: float, dt: float) -> tuple[float, float]:
    """Return how far a body gets in a step, ahead and to the left of where it begins [m]."""
    forward, aside = vx * dt, vy * dt
    if w.euler:
        return forward, aside
    ahead, across = w.memory[b, TURN_AHEAD], w.memory[b, TURN_ACROSS]
    return ahead * forward - across * aside, across * forward + ahead * aside


def go(w: Bodies, b: int, vx: float, vy: float, turn: float, dt: float) -> None:
    """Write to ``goal`` where a body gets with a velocity in its own frame, kept for a step.

    With ``euler`` the body slides along its old heading and then turns, as Stage has it; else
    it goes along the arc, which is exact.
    """
    angle = turn * dt
    remember_turn(w, b, angle)
    sine, cosine = w.memory[b, TURN_SIN], w.memory[b, TURN_COS]
    forward, aside = stride(w, b, vx, vy, dt)
    c, s = w.rows[b, COS], w.rows[b, SIN]
    w.goal[b, X] = w.rows[b, X] + c * forward - s * aside
    w.goal[b, Y] = w.rows[b, Y] + s * forward + c * aside
    w.goal[b, Z] = w.rows[b, Z]
    yaw = w.rows[b, YAW] + angle
    if abs(yaw) > PI:
        yaw -= 2.0 * PI * floor(yaw / (2.0 * PI) + 0.5)
    c, s = c * cosine - s * sine, s * cosine + c * sine
    unit = 1.5 - 0.5 * (c * c + s * s)  # rounding errors would add up
    w.goal[b, YAW], w.goal[b, COS], w.goal[b, SIN] = yaw, c * unit, s * unit


def wanted(w: Bodies, b: int, k: int, axis: int) -> float:
    """Return the velocity along an axis that a body's drive reaches in the end."""
    target = w.command[b, axis]
    if w.drives[k, FREE] == 0.0 and w.drives[k, DRIVE_KIND] != CAR:
        target = bounded(w, target, k, axis)
    return target


def driven(w: Bodies, b: int, k: int, axis: int, dt: float) -> float:
    """Return the velocity along an axis that a body's drive has after a step."""
    target = wanted(w, b, k, axis)
    if w.drives[k, FREE] == 0.0:
        target = toward(w, w.velocity[b, axis], target, k, axis, dt)
    return target


def twist_of(w: Bodies, b: int, k: int) -> tuple[float, float, float]:
    """Return the velocity of a body in its own frame: ahead, to the left [m/s], turning [rad/s]."""
    vx, turn = w.velocity[b, 0], w.velocity[b, 2]
    if w.drives[k, DRIVE_KIND] == CAR:
        vx, turn = vx * cos(turn), vx * sin(turn) / w.drives[k, WHEELBASE]
        vx, turn = bounded(w, vx, k, 0), bounded(w, turn, k, 2)
    return vx, w.velocity[b, 1], turn


def propose(w: Bodies, first: int, last: int, dt: float) -> float:
    """Return propose moves of the bodies first to last; returns the longest distance of one [m].

    They are counted through all worlds. A state becomes STILL, MOVING, or BLOCKED if the command
    is not a number.
    """
    kinds = w.drives.shape[0]
    longest = 0.0
    for b in range(first, last):
        k = b % kinds
        kind = cython.cast(cython.int, w.drives[k, DRIVE_KIND])
        w.state[b] = STILL
        if kind == PASSIVE:
            continue
        for axis in range(3):
            w.velocity[b, axis] = driven(w, b, k, axis, dt)
        if kind in (DIFFERENTIAL, CAR):
            w.velocity[b, 1] = 0.0
        vx, vy, turn = twist_of(w, b, k)
        if vx == 0.0 and vy == 0.0 and turn == 0.0:
            continue
        go(w, b, vx, vy, turn, dt)
        if not isfinite(w.goal[b, X] + w.goal[b, Y] + w.goal[b, YAW]):
            w.state[b] = BLOCKED  # a command that is not a number leads nowhere
            w.velocity[b, 0] = w.velocity[b, 1] = w.velocity[b, 2] = 0.0
            continue
        w.state[b] = MOVING
        longest = max(longest, vx * vx + vy * vy)
    return sqrt(longest) * dt


def fastest(w: Bodies, b: int, k: int, axis: int) -> float:
    """Return the highest speed of a body along an axis in this step."""
    target = w.command[b, axis]
    if w.drives[k, DRIVE_KIND] != CAR:
        target = bounded(w, target, k, axis)
    return max(abs(w.velocity[b, axis]), abs(target))


def count_substeps(w: Bodies, first: int, last: int) -> int:
    """Return the number of parts of a step such that no body moves farther than its stride.

    At most 1,000: a command may be anything, and what goes farther than that jumps.
    """
    most = 1.0
    for b in range(first, last):
        k, d = b % w.nbody, b % w.drives.shape[0]
        kind = cython.cast(cython.int, w.drives[d, DRIVE_KIND])
        if kind == PASSIVE:
            continue
        ahead, aside, turn = fastest(w, b, d, 0), fastest(w, b, d, 1), fastest(w, b, d, 2)
        if kind == CAR:
            turn = ahead / w.drives[d, WHEELBASE]
        way = (ahead + aside + turn * w.kinds[k, RADIUS]) * w.dt
        most = max(most, ceil(min(way / w.kinds[k, STRIDE], MOST_LOOKS)))
    return cython.cast(cython.Py_ssize_t, most)


def commit(w: Bodies, first: int, last: int) -> int:
    """Move the bodies first to last where they may go; record the blocked ones."""
    moved = 0
    for b in range(first, last):
        if w.state[b] == MOVING:
            for c in range(6):
                w.rows[b, c] = w.goal[b, c]
            w.stalled[b] = 0
            moved += 1
        elif w.state[b] == BLOCKED:
            w.stalled[b] = 1
    return moved


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
    longest, k = 0.0, -1
    for b in range(first, last):
        k = k + 1 if k + 1 < w.drives.shape[0] else 0
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
