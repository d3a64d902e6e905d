"""Wrappers that join, choose and count what is observed."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import Any

import numpy as np
from gymnasium.spaces import Box, Dict

from gazelle.compat.gym.core import ObservationWrapper, Step, Wrapper
from gazelle.compat.gym.error import Error, ResetNeeded


class FrameStack(ObservationWrapper):
    """The last observations as one array, the oldest first.

    Args:
        env: Any environment with a box of observations.
        num_stack: How many.
    """

    def __init__(self, env: Any, num_stack: int, lz4_compress: bool = False) -> None:  # noqa: FBT001, FBT002
        del lz4_compress
        super().__init__(env)
        self.num_stack = num_stack
        self.frames: deque[Any] = deque(maxlen=num_stack)
        inner = self.observation_space
        if not isinstance(inner, Box):
            raise Error("FrameStack needs observations in a gym.spaces.Box")
        low, high = (np.stack([bound] * num_stack) for bound in (inner.low, inner.high))
        self.observation_space = Box(low, high, dtype=inner.dtype.type)

    def reset(self, **options: Any) -> Any:
        """Begin an episode; the first observation stands in every place."""
        first = self.env.reset(**options)
        self.frames.extend([first] * self.num_stack)
        return np.stack(self.frames)

    def observation(self, observation: Any) -> Any:
        """Return the last observations with this one."""
        self.frames.append(observation)
        return np.stack(self.frames)


class FilterObservation(ObservationWrapper):
    """Some entries of observations that are dictionaries.

    Args:
        env: Any environment with such observations.
        filter_keys: Names of those that stay; all by default.
    """

    def __init__(self, env: Any, filter_keys: Iterable[str] | None = None) -> None:
        super().__init__(env)
        inner = self.observation_space
        if not isinstance(inner, Dict):
            raise Error("FilterObservation needs observations in a gym.spaces.Dict")
        self._kept = list(inner.spaces if filter_keys is None else filter_keys)
        unknown = [key for key in self._kept if key not in inner.spaces]
        if unknown:
            raise Error(f"there are no observations {unknown}; there are {list(inner.spaces)}")
        self.observation_space = Dict({key: inner.spaces[key] for key in self._kept})

    def observation(self, observation: Any) -> Any:
        """Return the entries that stay."""
        return {key: observation[key] for key in self._kept}


class TimeAwareObservation(ObservationWrapper):
    """Observations with the number of steps of the episode behind them."""

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        inner = self.observation_space
        if not isinstance(inner, Box) or inner.dtype != np.float32 or len(inner.shape) != 1:
            raise Error("TimeAwareObservation needs a row of float32 as observation")
        low = np.append(inner.low, np.float32(0.0))
        high = np.append(inner.high, np.float32(np.inf))
        self.observation_space = Box(low, high, dtype=np.float32)
        self.t = 0

    def reset(self, **options: Any) -> Any:
        """Begin an episode; returns the first observation."""
        self.t = 0
        return super().reset(**options)

    def step(self, action: Any) -> Step:
        """Act once."""
        self.t += 1
        return super().step(action)

    def observation(self, observation: Any) -> Any:
        """Return the observation with the number behind it."""
        return np.append(observation, self.t).astype(np.float32)


class OrderEnforcing(Wrapper):
    """Refuses steps before the first ``reset``."""

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self._has_reset = False

    def reset(self, **options: Any) -> Any:
        """Begin an episode; returns the first observation."""
        self._has_reset = True
        return self.env.reset(**options)

    def step(self, action: Any) -> Step:
        """Act once.

        Raises:
            ResetNeeded: No episode has begun.
        """
        if not self._has_reset:
            raise ResetNeeded("call reset() before step()")
        return super().step(action)
