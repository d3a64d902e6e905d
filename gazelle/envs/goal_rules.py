"""Rules that openai_ros' tasks with a place to reach share, on arrays of places."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Bools, Floats

Row = Sequence[float] | Floats


def is_at(place: Floats, goal: Row, tolerance: float) -> Bools:
    """Return whether places are the goal along x and along y; upper edges belong to it.

    Args:
        place: x and y, and maybe more [m], shape (n, 2 or 3).
        goal: Likewise, shape (2 or 3,).
        tolerance: Tolerance of a place along each axis [m].
    """
    middle = np.asarray(goal, np.float64)[:2]
    return is_inside(place[:, :2], middle - tolerance, middle + tolerance)


def is_inside(place: Floats, low: Row, high: Row) -> Bools:
    """Return whether values, shape (n, k), are in a box; its upper edges belong to it."""
    inside = (place > np.asarray(low)) & (place <= np.asarray(high))
    return np.asarray(inside.all(axis=1), np.bool_)


def distance_to(place: Floats, goal: Row) -> Floats:
    """Return how far places are from the goal [m], shape (n,).

    Args:
        place: x and y, and maybe z [m], shape (n, 2 or 3).
        goal: Likewise, shape (2 or 3,); a height that places lack is 0 there.
    """
    end = np.asarray(goal, np.float64)
    flat = np.zeros((len(place), len(end)))
    flat[:, : place.shape[1]] = place
    return np.asarray(np.linalg.norm(flat - end, axis=1), np.float64)


def goal_reward(over: Bools, reached: Bools, end: float, step: Floats) -> Floats:
    """Return the reward of a step, shape (n,).

    Args:
        over: Whether the episode ends.
        reached: Whether the goal is reached.
        end: Reward of an end at the goal; elsewhere it is minus that.
        step: Reward where the episode continues.
    """
    return np.asarray(np.where(over, np.where(reached, end, -end), step), np.float64)
