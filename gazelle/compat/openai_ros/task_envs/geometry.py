"""Geometry of openai_ros' tasks."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gazelle.ros import load_message
from gazelle.ros.transformations import euler_from_quaternion

NEAR = 0.05
"""Tolerance of a position along x and along y [m]."""


def euler_of(orientation: Any) -> tuple[float, float, float]:
    """Roll, pitch and yaw of a ``geometry_msgs/Quaternion`` [rad]."""
    roll, pitch, yaw = euler_from_quaternion(
        (orientation.x, orientation.y, orientation.z, orientation.w)
    )
    return float(roll), float(pitch), float(yaw)


def distance(one: Any, other: Any) -> float:
    """Between two points [m]."""
    return math.dist((one.x, one.y, one.z), (other.x, other.y, other.z))


def magnitude(vector: Any) -> float:
    """Of a ``geometry_msgs/Vector3``."""
    return math.hypot(vector.x, vector.y, vector.z)


def point(x: float, y: float, z: float = 0.0) -> Any:
    """A ``geometry_msgs/Point`` [m]."""
    made: Any = load_message("geometry_msgs/Point")
    return made(float(x), float(y), float(z))


def is_at(place: Any, goal: Any, epsilon: float = NEAR) -> bool:
    """Return whether a point is within a square around another; its upper edges belong to it."""
    return all(
        here - epsilon < there <= here + epsilon
        for here, there in ((goal.x, place.x), (goal.y, place.y))
    )


def samples(
    ranges: Sequence[float],
    step: int,
    *,
    nearest: float,
    farthest: float,
    convert: Callable[[float], float],
) -> list[float]:
    """Every so-manieth range of a scan.

    Args:
        ranges: Shape (n,) [m].
        step: Between two samples.
        nearest: What stands for a range that is not a number [m].
        farthest: What stands for no return [m].
        convert: Rounds the others.
    """

    def value(measured: float) -> float:
        if math.isinf(measured):
            return farthest
        return nearest if math.isnan(measured) else convert(measured)

    return [value(each) for each in ranges[::step]]


def step_between(count: int, parts: int) -> int:
    """Every how-manieth of ``count`` ranges is taken for about ``parts`` samples."""
    return max(1, round(count / parts))


def too_near(ranges: Sequence[float], step: int, least: float) -> bool:
    """Return whether a sample is nearer than it may be; zero means no measurement."""
    taken = np.asarray(ranges[::step], np.float64)
    return bool(np.any((taken > 0.0) & (taken < least)))
