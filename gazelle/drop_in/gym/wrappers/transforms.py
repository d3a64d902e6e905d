"""Wrappers that change observations, actions and rewards."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from gymnasium.spaces import Box, flatten, flatten_space

from gazelle.drop_in.gym.core import (
    ActionWrapper,
    ObservationWrapper,
    RewardWrapper,
    Step,
    Wrapper,
)
from gazelle.drop_in.gym.error import Error


class FlattenObservation(ObservationWrapper):
    """Observations as one row of numbers."""

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self._inner = self.observation_space
        self.observation_space = flatten_space(self._inner)

    def observation(self, observation: Any) -> Any:
        """Return the flat observation."""
        return flatten(self._inner, observation)


class TransformObservation(ObservationWrapper):
    """Observations through a function."""

    def __init__(self, env: Any, f: Callable[[Any], Any]) -> None:
        super().__init__(env)
        self.f = f

    def observation(self, observation: Any) -> Any:
        """Return the function's value for an observation."""
        return self.f(observation)


class TransformReward(RewardWrapper):
    """Rewards through a function."""

    def __init__(self, env: Any, f: Callable[[Any], Any]) -> None:
        super().__init__(env)
        self.f = f

    def reward(self, reward: Any) -> Any:
        """Return the function's value for a reward."""
        return self.f(reward)


class ClipAction(ActionWrapper):
    """Actions are kept within their box."""

    def action(self, action: Any) -> Any:
        """Return the nearest action of the box."""
        box = _box(self.action_space)
        return np.clip(action, box.low, box.high)


class RescaleAction(ActionWrapper):
    """Actions between two bounds stand for those of the whole box.

    Args:
        env: With a box of actions.
        a: The lower bound.
        b: The upper bound.
    """

    def __init__(self, env: Any, a: float, b: float) -> None:
        super().__init__(env)
        self._inner = _box(env.action_space)
        shape, kind = self._inner.shape, self._inner.dtype
        self.a = np.zeros(shape, kind) + a
        self.b = np.zeros(shape, kind) + b
        self.action_space = Box(self.a, self.b, dtype=np.float32)

    def action(self, action: Any) -> Any:
        """Return the action in the original box."""
        low, high = self._inner.low, self._inner.high
        return np.clip(low + (high - low) * ((action - self.a) / (self.b - self.a)), low, high)


class RecordEpisodeStatistics(Wrapper):
    """At the end of an episode ``info["episode"]`` has its return ``r``, length ``l`` and time ``t`` [s]."""

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self._begin = time.monotonic()
        self._return, self._length = 0.0, 0

    def reset(self, **options: Any) -> Any:
        """Start an episode; returns the first observation."""
        self._return, self._length = 0.0, 0
        return self.env.reset(**options)

    def step(self, action: Any) -> Step:
        """Step the environment."""
        observation, reward, done, info = self.env.step(action)
        self._return += float(reward)
        self._length += 1
        if done:
            seconds = round(time.monotonic() - self._begin, 6)
            info["episode"] = {"r": self._return, "l": self._length, "t": seconds}
        return observation, reward, done, info


def _box(space: Any) -> Box:
    if not isinstance(space, Box):
        raise Error(f"this wants actions of the kind gym.spaces.Box, not {space}")
    return space
