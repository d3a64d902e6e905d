"""Wrappers that join, choose and count what is observed."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable
from typing import Any, Self

import numpy as np
from gymnasium.spaces import Box, Dict

from gazelle.drop_in.gym.core import ObservationWrapper, Step, Wrapper
from gazelle.drop_in.gym.error import Error, ResetNeeded
from gazelle.errors import did_you_mean


class LazyFrames(np.ndarray[Any, Any]):
    """Frames as one array; gym joins them when they are used, here they are joined at once.

    Args:
        frames: Arrays of equal shapes.
    """

    def __new__(cls, frames: Iterable[Any], lz4_compress: bool = False) -> Self:  # noqa: FBT001, FBT002
        """Join the frames along a new first axis."""
        del lz4_compress
        return np.stack(list(frames)).view(cls)


class FrameStack(ObservationWrapper):
    """The last observations as one array, the oldest first.

    Args:
        env: Any environment with a box of observations.
        num_stack: Number of frames.
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
        """Start an episode; the first observation fills the stack."""
        first = self.env.reset(**options)
        self.frames.extend([first] * self.num_stack)
        return LazyFrames(self.frames)

    def observation(self, observation: Any) -> Any:
        """Return the last observations with this one."""
        self.frames.append(observation)
        return LazyFrames(self.frames)


class FlattenDictWrapper(ObservationWrapper):
    """Some entries of observations that are dictionaries, as one row of numbers.

    Args:
        env: Any environment with such observations.
        dict_keys: Names of the entries, in their order in the row.
    """

    def __init__(self, env: Any, dict_keys: Iterable[str]) -> None:
        super().__init__(env)
        self.dict_keys = list(dict_keys)
        spaces = [_entry(self.observation_space, key) for key in self.dict_keys]
        size = sum(int(np.prod(each.shape or ())) for each in spaces)
        self.observation_space = Box(-np.inf, np.inf, (size,), np.float32)

    def observation(self, observation: Any) -> Any:
        """Return the entries one after the other."""
        return np.concatenate([np.ravel(observation[key]) for key in self.dict_keys])


class FilterObservation(ObservationWrapper):
    """Some entries of observations that are dictionaries.

    Args:
        env: Any environment with such observations.
        filter_keys: Names of those that stay; all by default.
    """

    def __init__(self, env: Any, filter_keys: Iterable[str] | None = None) -> None:
        super().__init__(env)
        inner = self.observation_space
        if filter_keys is None:
            filter_keys = inner.spaces if isinstance(inner, Dict) else ()
        self._kept = list(filter_keys)
        self.observation_space = Dict({key: _entry(inner, key) for key in self._kept})

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
        """Start an episode; returns the first observation."""
        self.t = 0
        return super().reset(**options)

    def step(self, action: Any) -> Step:
        """Step the environment."""
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
        """Start an episode; returns the first observation."""
        self._has_reset = True
        return self.env.reset(**options)

    def step(self, action: Any) -> Step:
        """Step the environment.

        Raises:
            ResetNeeded: No episode has begun.
        """
        if not self._has_reset:
            raise ResetNeeded("call reset() before step()")
        return super().step(action)


def _entry(space: Any, key: str) -> Any:
    """Return one space of a dictionary of them.

    Raises:
        Error: It is none, or has no such space.
    """
    if not isinstance(space, Dict):
        raise Error(f"this needs observations in a gym.spaces.Dict, not in {space}")
    if key not in space.spaces:
        raise Error(f"there is no observation '{key}'; {did_you_mean(key, space.spaces)}")
    return space.spaces[key]
