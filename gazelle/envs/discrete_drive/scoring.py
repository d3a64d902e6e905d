"""Observed ranges, rewards and ends of openai_ros' driving tasks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.envs.decimals import rounded
from gazelle.envs.discrete_drive.rules import DriveRules
from gazelle.envs.goal_rules import goal_reward, is_at, is_inside


@dataclass(frozen=True, slots=True)
class DriveEnds:
    """Reasons for which episodes end, each of shape (n,).

    Attributes:
        crashed: Something is too near.
        outside: The base left its work space.
        reached: The base is at the goal.
    """

    crashed: Bools
    outside: Bools
    reached: Bools

    @property
    def over(self) -> Bools:
        """True where the episode ends."""
        return self.crashed | self.outside | self.reached


def observed(rules: DriveRules, ranges: NDArray[Any]) -> Floats:
    """Return ranges as they are observed [m], same shape.

    Args:
        rules: Parameters of the task.
        ranges: Measured ranges [m]; infinite (of either sign) where nothing is in range.
    """
    nothing, unknown = np.isinf(ranges), np.isnan(ranges)
    known = np.where(nothing | unknown, 0.0, ranges)
    if rules.clamped:
        known = np.clip(known, rules.least, rules.far)
    known = np.trunc(known) if rules.decimals is None else rounded(known, rules.decimals)
    return np.where(nothing, rules.far, np.where(unknown, rules.least, known))


def has_crashed(rules: DriveRules, ranges: NDArray[Any], seen: NDArray[Any]) -> Bools:
    """Return whether something is too near, shape (n,).

    Args:
        rules: Parameters of the task.
        ranges: Measured ranges [m], shape (n, k); 0 and less is no measurement.
        seen: The same as observed [m].
    """
    if rules.crash_range is None:
        return np.asarray(np.any(seen == rules.least, axis=1), np.bool_)
    near = (ranges > 0.0) & (ranges < rules.crash_range)
    return np.asarray(np.any(near, axis=1), np.bool_)


def ends_of(rules: DriveRules, crashed: Bools, place: Floats) -> DriveEnds:
    """Return the reasons why episodes end.

    Args:
        rules: Parameters of the task.
        crashed: Whether a robot has crashed, shape (n,).
        place: Observed x and y [m], shape (n, 2).
    """
    outside, reached = np.zeros((2, len(crashed)), np.bool_)
    if rules.goal is not None:
        reached = is_at(place, rules.goal, rules.tolerance)
    if rules.bounds is not None:
        x0, x1, y0, y1 = rules.bounds
        outside = ~is_inside(place, (x0, y0), (x1, y1))
    return DriveEnds(crashed, outside, reached)


def reward_of(
    rules: DriveRules, *, over: Bools, reached: Bools, forward: Bools, closer: Bools
) -> Floats:
    """Return the reward of a step, shape (n,); ``forward``: the action was the first one."""
    step = np.array(rules.rewards)[np.where(forward, 0, 1), np.where(closer, 1, 0)]
    return goal_reward(over, reached, rules.end_reward, step)
