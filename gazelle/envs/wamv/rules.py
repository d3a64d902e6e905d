"""Rewards and ends of openai_ros' WamvNavTwoSetsBuoys, on arrays of what is observed."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats

GOAL = (30.0, 0.0, 1.0)
"""Goal position [m]; distances count its height, ends do not."""
TOLERANCE = 0.5
"""Tolerance along x and along y [m]."""
LOW, HIGH = (-1.0, -5.0), (30.0, 5.0)
"""Edges of the work space along x and y [m]."""
CLOSER, DONE = 100.0, 1000.0
"""Reward of a step that came nearer to the goal (else less by that), and of an end."""


def reached(place: Floats) -> Bools:
    """Return whether positions (x, y), shape (n, 2), are at the goal."""
    goal = np.array(GOAL[:2])
    return np.asarray(
        np.all((place > goal - TOLERANCE) & (place <= goal + TOLERANCE), axis=1), np.bool_
    )


def outside(place: Floats) -> Bools:
    """Return whether positions (x, y), shape (n, 2), are out of the work space."""
    return np.asarray(~np.all((place > LOW) & (place <= HIGH), axis=1), np.bool_)


def distance_of(place: Floats) -> Floats:
    """From places on the water, shape (n, 2), to the goal [m], shape (n,)."""
    left = ((place - GOAL[:2]) ** 2).sum(axis=1) + GOAL[2] ** 2
    return np.asarray(np.sqrt(left), np.float64)


def reward_of(over: Bools, success: Bools, closer: Bools) -> Floats:
    """Return the reward of a step, shape (n,).

    Args:
        over: Whether the episode ends.
        success: Whether it is at the goal.
        closer: Whether it came nearer to the goal, as observed.
    """
    last = np.where(success, DONE, -DONE)
    return np.asarray(np.where(over, last, np.where(closer, CLOSER, -CLOSER)), np.float64)
