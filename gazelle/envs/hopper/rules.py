"""Rewards and ends of openai_ros' HopperStayUp, on arrays of what is observed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.envs.goal_rules import distance_to


@dataclass(frozen=True, slots=True, kw_only=True)
class StandRules:
    """Parameters of the task; the defaults are the published ones.

    Attributes:
        desired: Desired position of the base [m].
        desired_yaw: Desired heading [rad].
        desired_force: Desired contact force of the foot [N].
        lowest: Height of the base below which an episode ends [m].
        highest: Height at which it ends [m].
        steepest: Roll and pitch at which it ends [rad].
        alive_reward: Reward of a step without any error.
        weights: Costs of errors: joint angles, force, orientation, distance from the place.
    """

    desired: tuple[float, float, float] = (0.0, 0.0, 1.0)
    desired_yaw: float = 0.0
    desired_force: float = 7.08
    lowest: float = 0.5
    highest: float = 3.0
    steepest: tuple[float, float] = (1.57, 1.57)
    alive_reward: float = 100.0
    weights: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0)


def has_height(rules: StandRules, height: Floats) -> Bools:
    """Return whether the base is as high [m] as it should be, shape (n,)."""
    return np.asarray((height >= rules.lowest) & (height < rules.highest), np.bool_)


def is_upright(rules: StandRules, tilt: Floats) -> Bools:
    """Return whether roll and pitch [rad], shape (n, 2), are small enough, shape (n,)."""
    return np.asarray((np.abs(tilt) < np.array(rules.steepest)).all(axis=1), np.bool_)


def reward_of(rules: StandRules, seen: Floats) -> Floats:
    """Return the reward of a step, shape (n,), from observations, shape (n, 11)."""
    joints, force, orientation, distance = rules.weights
    roll, pitch, yaw = np.abs(seen[:, 1:4] - (0.0, 0.0, rules.desired_yaw)).T
    reward = rules.alive_reward - joints * np.abs(seen[:, 5:8]).sum(axis=1)
    reward = reward - force * np.abs(seen[:, 4] - rules.desired_force)
    reward = reward - orientation * (roll + pitch + yaw)
    return np.asarray(reward - distance * distance_to(seen[:, 8:11], rules.desired), np.float64)
