"""Follow a path: where to head, and how fast at most."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.angles import wrapped
from gazelle.navigation.limits import BaseLimits

Pose2 = tuple[float, float, float]

_AHEAD = 0.4  # how far along the path the base aims [m]
_TURN_FIRST = math.radians(50.0)  # headings farther off are turned to on the spot
_TURNING_GAIN = 2.5  # turning rate for an error of heading [1/s]


def following_velocity(path: Floats, pose: Pose2, limits: BaseLimits) -> tuple[float, float]:
    """Return forward [m/s] and turning [rad/s] velocity that follow a path without obstacles.

    The base steers for a point of the path a little ahead of it, on an arc (pure pursuit,
    R. C. Coulter, CMU-RI-TR-92-01, 1992), and brakes for the end.

    Args:
        path: Points (x, y) to the goal [m], shape (n, 2).
        pose: x, y [m] and heading [rad], in the frame of the path.
        limits: Of the base.
    """
    here = np.array(pose[:2])
    nearest = int(np.hypot(*(path - here).T).argmin())
    rest = path[nearest:]
    far = np.nonzero(np.hypot(*(rest - here).T) >= _AHEAD)[0]
    aim = rest[far[0]] if len(far) else rest[-1]
    dx, dy = (aim - here).tolist()
    error = wrapped(math.atan2(dy, dx) - pose[2])
    if abs(error) > _TURN_FIRST:
        return 0.0, _bounded(_TURNING_GAIN * error, limits.angular)
    to_go = float(np.hypot(*(rest[-1] - here)))
    # Half of what the base can do is planned with, so that it can still brake for others.
    braking = math.sqrt(limits.linear_acceleration * to_go)
    speed = min(limits.linear, braking) * math.cos(error)
    turning = 2.0 * speed * math.sin(error) / max(math.hypot(dx, dy), 0.1)
    if abs(turning) > limits.angular:
        speed *= limits.angular / abs(turning)
    return speed, _bounded(turning, limits.angular)


def turn_to(heading: float, pose: Pose2, limits: BaseLimits) -> float:
    """Return the turning rate towards a heading on the spot [rad/s]."""
    return _bounded(_TURNING_GAIN * wrapped(heading - pose[2]), limits.angular)


def _bounded(value: float, most: float) -> float:
    return min(max(value, -most), most)
