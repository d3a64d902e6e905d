"""Polar coordinates of a goal, seen from a robot in the plane."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats


def distance_to(position: Floats, goal: Floats) -> Floats:
    """Return straight distance from robot to goal.

    Args:
        position: Robot positions in the world frame [m], shape (n, 2) or (n, 3); z is ignored.
        goal: Goals in the world frame [m], shape (n, 2).

    Returns:
        Distances [m], shape (n,).
    """
    distance: Floats = np.hypot(goal[:, 0] - position[:, 0], goal[:, 1] - position[:, 1])
    return distance


def heading_to(position: Floats, yaw: Floats, goal: Floats) -> Floats:
    """Return angle from a robot's forward axis to its goal, counter-clockwise positive.

    Args:
        position: As for ``distance_to``.
        yaw: Robot yaw [rad], in [-pi, pi], shape (n,).
        goal: As for ``distance_to``.

    Returns:
        Headings [rad], in [-pi, pi], shape (n,).
    """
    bearing = np.arctan2(goal[:, 1] - position[:, 1], goal[:, 0] - position[:, 0])
    angle = bearing - yaw
    angle = np.where(angle > np.pi, angle - 2.0 * np.pi, angle)
    heading: Floats = np.where(angle < -np.pi, angle + 2.0 * np.pi, angle)
    return heading
