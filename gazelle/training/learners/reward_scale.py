"""Rewards in units of what they add up to, so that learning does not depend on a task's units.

Stable-Baselines3's `VecNormalize` and Gymnasium's `NormalizeReward` do the same one step at a time.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from stable_baselines3.common.running_mean_std import RunningMeanStd

from gazelle.array_types import Bools, Floats32
from gazelle.training.state_arrays import saved_array

_LARGEST = 10.0
_LEAST_VARIANCE = 1e-8


class RewardScale:
    """Running standard deviation of discounted returns, by which rewards are divided.

    Args:
        copies: Number of copies of the task.
        gamma: Discount of one control step.
    """

    def __init__(self, copies: int, gamma: float) -> None:
        self._gamma = gamma
        self._returns = np.zeros(copies)
        self._seen = RunningMeanStd(shape=())

    def scaled(self, rewards: Floats32, starts: Bools, valid: Bools) -> Floats32:
        """Take a rollout into account and return its scaled rewards, shape (steps, copies).

        Args:
            rewards: Rewards of the learner.
            starts: Whether an episode began with the step's observation.
            valid: False where the step was spent on a reset.
        """
        returns = np.empty(rewards.shape)
        for row, (paid, began) in enumerate(zip(rewards, starts, strict=True)):
            self._returns = np.where(began, 0.0, self._gamma * self._returns) + paid
            returns[row] = self._returns
        if valid.any():
            self._seen.update(returns[valid])
        unit = np.sqrt(self._seen.var + _LEAST_VARIANCE)
        scaled: Floats32 = np.clip(rewards / unit, -_LARGEST, _LARGEST).astype(np.float32)
        return scaled

    def get_state(self) -> dict[str, Any]:
        """Return the state that `set_state` restores."""
        seen = self._seen
        moments = np.array([seen.mean, seen.var, seen.count], np.float64)
        return {"returns": self._returns, "moments": moments}

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Restore what `get_state` returned.

        Raises:
            ValueError: An array has another shape than here.
        """
        self._returns = saved_array(state, "returns", self._returns)
        mean, var, count = saved_array(state, "moments", np.zeros(3))
        self._seen.mean, self._seen.var, self._seen.count = (
            np.array(mean),
            np.array(var),
            float(count),
        )
