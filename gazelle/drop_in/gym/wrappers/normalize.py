"""Wrappers that normalize observations and rewards to running mean 0 and variance 1."""

from __future__ import annotations

from typing import Any

import numpy as np
from gymnasium.wrappers import utils

from gazelle.drop_in.gym.core import Step, Wrapper

RunningMeanStd: Any = utils.RunningMeanStd


class NormalizeObservation(Wrapper):
    """Observations less their mean, over their standard deviation.

    Args:
        env: Any environment of one world.
        epsilon: Added to the variance.
    """

    def __init__(self, env: Any, epsilon: float = 1e-8) -> None:
        super().__init__(env)
        self.obs_rms = RunningMeanStd(shape=self.observation_space.shape)
        self.epsilon = epsilon

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        return self.normalize(self.env.reset(**options))

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, done, info = self.env.step(action)
        return self.normalize(observation), reward, done, info

    def normalize(self, obs: Any) -> Any:
        """Count an observation, and return it normalized."""
        self.obs_rms.update(np.asarray(obs)[np.newaxis])
        return (obs - self.obs_rms.mean) / np.sqrt(self.obs_rms.var + self.epsilon)


class NormalizeReward(Wrapper):
    """Rewards over the standard deviation of the discounted return.

    Args:
        env: Any environment of one world.
        gamma: Discount of the return.
        epsilon: Added to the variance.
    """

    def __init__(self, env: Any, gamma: float = 0.99, epsilon: float = 1e-8) -> None:
        super().__init__(env)
        self.return_rms = RunningMeanStd(shape=())
        self.gamma, self.epsilon = gamma, epsilon
        self.returns = 0.0

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, done, info = self.env.step(action)
        self.returns = self.returns * self.gamma + float(reward)
        self.return_rms.update(np.array([self.returns]))
        scaled = reward / np.sqrt(self.return_rms.var + self.epsilon)
        if done:
            self.returns = 0.0
        return observation, scaled, done, info
