"""Rewards and ends of openai_ros' driving tasks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.envs.discrete_drive.rules import DriveRules, Place


@dataclass(frozen=True, slots=True)
class DriveEnds:
    """Why episodes end, each of shape (n,).

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


def ends_of(rules: DriveRules, nearest: Floats, place: Floats, goal: Place | None) -> DriveEnds:
    """Why episodes end.

    Args:
        rules: Of the task.
        nearest: The shortest range [m], shape (n,).
        place: x and y as observed [m], shape (n, 2).
        goal: Where to go [m], if anywhere.
    """
    crashed = nearest < rules.crash_range
    outside: Bools = np.zeros(len(place), np.bool_)
    reached: Bools = np.zeros(len(place), np.bool_)
    if goal is not None:
        low, high = np.array(goal) - rules.tolerance, np.array(goal) + rules.tolerance
        reached = np.all((place > low) & (place <= high), axis=1)
    if rules.bounds is not None:
        x0, x1, y0, y1 = rules.bounds
        inside = (place > (x0, y0)) & (place <= (x1, y1))
        outside = ~np.all(inside, axis=1)
    return DriveEnds(crashed, outside, reached)


def reward_of(rules: DriveRules, ends: DriveEnds, *, forward: Bools, closer: Bools) -> Floats:
    """Return the reward of a step, shape (n,).

    Args:
        rules: Of the task.
        ends: Why episodes end.
        forward: Whether the action was the first one.
        closer: Whether the base came nearer to the goal, as observed.
    """
    on_the_way = np.where(forward, rules.forward_reward, rules.turn_reward)
    on_the_way = on_the_way + rules.closer_reward * closer
    last = np.where(ends.reached, rules.end_reward, -rules.end_reward)
    reward: Floats = np.where(ends.over, last, on_the_way)
    return reward
