"""Actions of the TurtleBot3 tasks as velocities.

Discrete: always 0.15 m/s ahead, and one of five yaw rates, 1.5 (left) to -1.5 rad/s (right).

Continuous: two numbers in [-1, 1]. The first spans 0 to 0.22 m/s, the burger's top speed.
The second spans -1.5 to 1.5 rad/s: the span of the five discrete rates, on which alone the
published reward is defined, although the burger could turn at 2.84 rad/s.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats
from gazelle.errors import TaskError

ACTIONS = 5
LINEAR = 0.15
ANGULAR_STEP = 0.75
LINEAR_MAX = 0.22
ANGULAR_MAX = 1.5

# Yaw rates, each at its action plus one; what is beside them is no action.
_RATES: Floats = np.full(ACTIONS + 2, math.nan)
_RATES[1:-1] = ANGULAR_STEP * ((ACTIONS - 1) / 2 - np.arange(ACTIONS, dtype=np.float64))
_ONE = np.ones(1, np.intp)


def discrete_command(actions: ArrayLike, nworld: int) -> tuple[Floats, Floats]:
    """Return velocities of discrete actions.

    Args:
        actions: Ints 0 to 4, shape (nworld,).
        nworld: Number of worlds.

    Returns:
        Linear velocity [m/s] and yaw rate [rad/s], each of shape (nworld,).

    Raises:
        TaskError: Wrong shape, or a number that is not an action.
    """
    chosen = np.asarray(actions)
    if chosen.shape != (nworld,):
        raise TaskError(f"actions have shape {chosen.shape}, expected ({nworld},)")
    if chosen.dtype.kind not in "iu":
        raise TaskError(f"actions must be ints, not {chosen.dtype}")
    rates = _RATES.take(chosen.astype(np.intp) + _ONE, mode="clip")
    if not math.isfinite(rates.dot(rates)):  # one pass
        raise TaskError(f"actions must be ints from 0 to {ACTIONS - 1}")
    linear = np.empty(nworld)
    linear.fill(LINEAR)
    return linear, rates


def continuous_command(actions: ArrayLike, nworld: int) -> tuple[Floats, Floats]:
    """Return velocities of continuous actions; numbers outside [-1, 1] are clipped.

    Args:
        actions: Shape (nworld, 2).
        nworld: Number of worlds.

    Returns:
        Linear velocity [m/s] and yaw rate [rad/s], each of shape (nworld,).

    Raises:
        TaskError: Wrong shape, or NaN.
    """
    chosen = np.asarray(actions, dtype=np.float64)
    if chosen.shape != (nworld, 2):
        raise TaskError(f"actions have shape {chosen.shape}, expected ({nworld}, 2)")
    if np.isnan(chosen).any():
        raise TaskError("actions must be numbers in [-1, 1], not NaN")
    clipped = np.clip(chosen, -1.0, 1.0)
    return (clipped[:, 0] + 1.0) * (LINEAR_MAX / 2.0), clipped[:, 1] * ANGULAR_MAX
