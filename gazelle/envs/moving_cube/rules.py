"""Actions, rewards and ends of openai_ros' MovingCubeOneDiskWalk, on arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats
from gazelle.envs.decimals import rounded


@dataclass(frozen=True, slots=True, kw_only=True)
class WalkRules:
    """Parameters of the task; the defaults are the published ones.

    Attributes:
        speed: Speed of the wheel of actions 0 and 1, one each way [rad/s].
        speed_step: Change of it by actions 3 and 4 [rad/s].
        largest_pitch: Pitch beyond which an episode ends [rad].
        largest_yaw: Likewise.
        way_weight: Reward of a metre along y.
        speed_weight: Reward of a metre a second along y.
        yaw_weight: Cost of a yaw of a quarter turn.
        failure_reward: Reward of the step in which it tilts too far.
    """

    speed: float = 50.0
    speed_step: float = 10.0
    largest_pitch: float = 0.3
    largest_yaw: float = 0.3
    way_weight: float = 100.0
    speed_weight: float = 100.0
    yaw_weight: float = 100.0
    failure_reward: float = 10.0


def wheel_speeds(rules: WalkRules, speed: Floats, actions: NDArray[np.int64]) -> Floats:
    """Return the commanded speeds of actions (0 to 4), after these [rad/s], all of shape (n,)."""
    fixed = np.ones_like(speed) * rules.speed
    speeds = (fixed, -fixed, 0.0 * fixed, speed + rules.speed_step, speed - rules.speed_step)
    return np.asarray(np.clip(np.choose(actions, speeds), -rules.speed, rules.speed), np.float64)


def has_failed(rules: WalkRules, seen: Floats) -> Bools:
    """Return whether it tilts too far, of observations, shape (n, 6 or more)."""
    tilted = np.abs(seen[:, 3]) > rules.largest_pitch
    return np.asarray(tilted | (np.abs(seen[:, 5]) > rules.largest_yaw), np.bool_)


def reward_of(rules: WalkRules, seen: Floats, before: Floats, failed: Bools) -> Floats:
    """Return the reward of a step, shape (n,), from observations, shape (n, 6 or more).

    ``before`` is y as observed in the step before [m], shape (n,).
    """
    y, speed, yaw = seen[:, 1], seen[:, 4], seen[:, 5]
    way = rounded((y - before) * rules.way_weight, 0)
    turned = rounded(-np.abs(np.sin(yaw)) * rules.yaw_weight, 0)
    step = way + rounded(speed * rules.speed_weight, 0) + turned
    return np.asarray(np.where(failed, rules.failure_reward, step), np.float64)
