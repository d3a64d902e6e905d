# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc, no-any-return"
"""Polar coordinates of a goal, seen from a robot in the plane."""

from __future__ import annotations

import math

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import atan2
from cython.cimports.libc.math import sqrt

from gazelle.array_types import Floats

PI = cython.declare(cython.double, math.pi)


def distance_to(position: Floats, goal: Floats) -> Floats:
    """Return straight distance from robot to goal.

    Args:
        position: Robot positions in the world frame [m], shape (n, 2) or (n, 3); z is ignored.
        goal: Goals in the world frame [m], shape (n, 2).

    Returns:
        Distances [m], shape (n,).
    """
    found = np.empty(len(position))
    find_distances(position, goal, found)
    return found


def heading_to(position: Floats, yaw: Floats, goal: Floats) -> Floats:
    """Return angle from a robot's forward axis to its goal, counter-clockwise positive.

    Args:
        position: As for ``distance_to``.
        yaw: Robot yaw [rad], in [-pi, pi], shape (n,).
        goal: As for ``distance_to``.

    Returns:
        Headings [rad], in [-pi, pi], shape (n,).
    """
    found = np.empty(len(position))
    find_headings(position, yaw, goal, found)
    return found


def find_distances(position: Floats, goal: Floats, found: Floats) -> None:
    """Find distances, shape (n,)."""
    for i in range(found.shape[0]):
        found[i] = distance_of(goal[i, 0] - position[i, 0], goal[i, 1] - position[i, 1])


def find_headings(position: Floats, yaw: Floats, goal: Floats, found: Floats) -> None:
    """Find headings, shape (n,)."""
    for i in range(found.shape[0]):
        found[i] = heading_of(goal[i, 0] - position[i, 0], goal[i, 1] - position[i, 1], yaw[i])


def distance_of(x: float, y: float) -> float:
    """Return the length of a way [m]."""
    return sqrt(x * x + y * y)


def heading_of(x: float, y: float, yaw: float) -> float:
    """Return the direction of a way, seen from a robot [rad]."""
    angle = atan2(y, x) - yaw
    if angle > PI:
        angle -= 2.0 * PI
    if angle < -PI:
        angle += 2.0 * PI
    return angle
