"""Rewards and ends of openai_ros' WamvNavTwoSetsBuoys, on arrays of what is observed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.envs.goal_rules import goal_reward, is_at, is_inside


@dataclass(frozen=True, slots=True, kw_only=True)
class ChannelRules:
    """Parameters of the task; the defaults are the published ones.

    Attributes:
        goal: Goal [m]; its height counts for distances, not for ends.
        tolerance: Tolerance of a place along x and along y [m].
        low: Lower edges of the work space along x and y [m].
        high: Upper edges, which belong to it [m].
        closer_reward: Reward of a step that comes nearer to the goal; others get minus that.
        end_reward: Reward of an end at the goal; other ends get minus that.
    """

    goal: tuple[float, float, float] = (30.0, 0.0, 1.0)
    tolerance: float = 0.5
    low: tuple[float, float] = (-1.0, -5.0)
    high: tuple[float, float] = (30.0, 5.0)
    closer_reward: float = 100.0
    end_reward: float = 1000.0


def reached(rules: ChannelRules, place: Floats) -> Bools:
    """Return whether places (x, y), shape (n, 2), are the goal."""
    return is_at(place, rules.goal, rules.tolerance)


def outside(rules: ChannelRules, place: Floats) -> Bools:
    """Return whether places (x, y), shape (n, 2), are out of the work space."""
    return ~is_inside(place, rules.low, rules.high)


def reward_of(rules: ChannelRules, *, over: Bools, success: Bools, closer: Bools) -> Floats:
    """Return the reward of a step, shape (n,), by whether it came closer to the goal as observed."""
    step = np.where(closer, rules.closer_reward, -rules.closer_reward)
    return goal_reward(over, success, rules.end_reward, step)
