"""When a TurtleBot3 has collided, and when it has arrived."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.envs.turtlebot3.rules import Rules

Float64 = NDArray[np.float64]
Bool = NDArray[np.bool_]


def collided(rules: Rules, nearest: Float64) -> Bool:
    """Whether the shortest range (not rounded) [m], shape (n,), is below the limit.

    A range of 0 is a failed ray, and no collision.
    """
    hit: Bool = (nearest > 0.0) & (nearest < rules.collision_range)
    return hit


def reached(rules: Rules, distance: Float64) -> Bool:
    """Whether the rounded distance to the goal [m], shape (n,), is below the limit."""
    arrived: Bool = distance < rules.goal_distance
    return arrived
