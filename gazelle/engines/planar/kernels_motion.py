"""Where bodies would go in a step: limits, drives and the way along an arc."""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import inner, part
from gazelle.engines.planar.columns import (
    BLOCKED,
    BRAKE,
    CAR,
    COS,
    DIFFERENTIAL,
    DRIVE_KIND,
    FASTEST,
    MOVING,
    PASSIVE,
    PUSH,
    RADIUS,
    SIN,
    SLOWEST,
    STILL,
    STRIDE,
    WHEELBASE,
    YAW,
    X,
    Y,
    Z,
)
from gazelle.engines.planar.tables import Flags, Floats, Marks

MOST_LOOKS = 1000.0


@inner
def bounded(value: float, drives: Floats, k: int, axis: int) -> float:
    """A velocity along an axis within the bounds of a drive."""
    return float(min(max(value, drives[k, SLOWEST + axis]), drives[k, FASTEST + axis]))


@inner
def toward(now: float, wanted: float, drives: Floats, k: int, axis: int, dt: float) -> float:
    """The velocity along an axis after a step, within a drive's bounds of acceleration."""
    change = wanted - now
    least, most = drives[k, BRAKE + axis] * dt, drives[k, PUSH + axis] * dt
    return wanted if least <= change <= most else now + min(max(change, least), most)


@part
def turned(angle: float) -> tuple[float, float, float, float]:
    """sin(a), cos(a), sin(a) / a and (1 - cos(a)) / a; by their series where a is small."""
    if abs(angle) > 0.5:
        s, c = math.sin(angle), math.cos(angle)
        return s, c, s / angle, (1.0 - c) / angle
    q = angle * angle
    sine = 1.0 - q * (1 / 6) * (
        1.0 - q * (1 / 20) * (
            1.0 - q * (1 / 42) * (1.0 - q * (1 / 72) * (1.0 - q * (1 / 110) * (1.0 - q * (1 / 156))))
        )
    )  # fmt: skip
    versed = 0.5 * (
        1.0 - q * (1 / 12) * (
            1.0 - q * (1 / 30) * (1.0 - q * (1 / 56) * (1.0 - q * (1 / 90) * (1.0 - q * (1 / 132))))
        )
    )  # fmt: skip
    return angle * sine, 1.0 - q * versed, sine, angle * versed


@inner
def go(
    pose: Floats, goal: Floats, b: int, vx: float, vy: float, turn: float, dt: float, euler: bool
) -> None:
    """Write to ``goal`` where a body gets with a velocity in its own frame, kept for a step.

    With ``euler`` the body slides along its old heading and then turns, as Stage has it; else
    it goes along the arc, which is exact.
    """
    angle = turn * dt
    sine, cosine, ahead, across = turned(angle)
    forward, aside = vx * dt, vy * dt
    if not euler:
        forward, aside = ahead * forward - across * aside, across * forward + ahead * aside
    cos, sin = pose[b, COS], pose[b, SIN]
    goal[b, X] = pose[b, X] + cos * forward - sin * aside
    goal[b, Y] = pose[b, Y] + sin * forward + cos * aside
    goal[b, Z] = pose[b, Z]
    yaw = pose[b, YAW] + angle
    if abs(yaw) > math.pi:
        yaw -= 2.0 * math.pi * math.floor(yaw / (2.0 * math.pi) + 0.5)
    c, s = cos * cosine - sin * sine, sin * cosine + cos * sine
    unit = 1.5 - 0.5 * (c * c + s * s)  # rounding errors would add up
    goal[b, YAW], goal[b, COS], goal[b, SIN] = yaw, c * unit, s * unit


@inner
def propose(
    first: int, last: int, drives: Floats, command: Floats, velocity: Floats, pose: Floats,
    goal: Floats, state: Marks, dt: float, euler: bool,
) -> float:  # fmt: skip
    """Decide where the bodies first to last would go; returns the longest way of one [m].

    Args:
        first: Of the bodies, counted through all worlds.
        last: The one after the last.
        drives: What moves each kind of body, shape (nbody, DRIVE).
        command: Wanted velocity along x and y and about z in the body's frame [m/s, rad/s];
            of a car the speed of its front wheel, nothing, and its steering angle [rad].
        velocity: What it is, in the same meaning.
        pose: Bodies.
        goal: Where they would be.
        state: STILL, MOVING, or BLOCKED as it was for one that stands still.
        dt: [s].
        euler: Whether to go straight and then turn.
    """
    nbody = drives.shape[0]
    longest = 0.0
    for b in range(first, last):
        k = b % nbody
        kind = drives[k, DRIVE_KIND]
        state[b] = STILL
        if kind == PASSIVE:
            continue
        for axis in range(3):
            wanted = command[b, axis]
            if kind != CAR:
                wanted = bounded(wanted, drives, k, axis)
            velocity[b, axis] = toward(velocity[b, axis], wanted, drives, k, axis, dt)
        vx, vy, turn = velocity[b, 0], velocity[b, 1], velocity[b, 2]
        if kind in (DIFFERENTIAL, CAR):
            vy = velocity[b, 1] = 0.0
        if kind == CAR:
            vx, turn = vx * math.cos(turn), vx * math.sin(turn) / drives[k, WHEELBASE]
            vx, turn = bounded(vx, drives, k, 0), bounded(turn, drives, k, 2)
        if vx == 0.0 and vy == 0.0 and turn == 0.0:
            continue
        go(pose, goal, b, vx, vy, turn, dt, euler)
        if not math.isfinite(goal[b, X] + goal[b, Y] + goal[b, YAW]):
            state[b] = BLOCKED  # a command that is no number leads nowhere
            velocity[b, 0], velocity[b, 1], velocity[b, 2] = 0.0, 0.0, 0.0
            continue
        state[b] = MOVING
        longest = max(longest, vx * vx + vy * vy)
    return math.sqrt(longest) * dt


@inner
def looks_on_the_way(
    first: int, last: int, drives: Floats, command: Floats, velocity: Floats, kinds: Floats,
    dt: float,
) -> int:  # fmt: skip
    """Into how many equal parts a step is cut so that no body goes farther than its stride.

    At most 1,000: a command may be anything, and what goes farther than that jumps.
    """
    nbody = kinds.shape[0]
    most = 1.0
    for b in range(first, last):
        k = b % nbody
        d = b % drives.shape[0]
        kind = drives[d, DRIVE_KIND]
        if kind == PASSIVE:
            continue
        fast = np.zeros(3)
        for axis in range(3):
            wanted = command[b, axis]
            if kind != CAR:
                wanted = bounded(wanted, drives, d, axis)
            fast[axis] = max(abs(velocity[b, axis]), abs(wanted))
        turn = fast[0] / drives[d, WHEELBASE] if kind == CAR else fast[2]
        way = (fast[0] + fast[1] + turn * kinds[k, RADIUS]) * dt
        most = max(most, math.ceil(min(way / kinds[k, STRIDE], MOST_LOOKS)))
    return int(most)


@inner
def commit(first: int, last: int, pose: Floats, goal: Floats, state: Marks, stalled: Flags) -> int:
    """Let the bodies first to last be where they may go; remember who could not."""
    moved = 0
    for b in range(first, last):
        if state[b] == MOVING:
            for c in range(6):
                pose[b, c] = goal[b, c]
            stalled[b] = False
            moved += 1
        elif state[b] == BLOCKED:
            stalled[b] = True
    return moved
