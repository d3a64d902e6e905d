"""When a TurtleBot3 has collided, and when it has arrived."""

from __future__ import annotations

from gazelle.array_types import Bools, Floats
from gazelle.envs.turtlebot3.rules import Rules


def collided(rules: Rules, nearest: Floats, margin: float = 0.0) -> Bools:
    """Return whether the shortest range [m], shape (n,), is below the limit plus a margin [m].

    The range is not rounded. A range of 0 is a failed ray, and no collision.
    """
    hit: Bools = (nearest > 0.0) & (nearest < rules.collision_range + margin)
    return hit


def reached(rules: Rules, distance: Floats) -> Bools:
    """Return whether the rounded distance to the goal [m], shape (n,), is below the limit."""
    arrived: Bools = distance < rules.goal_distance
    return arrived
