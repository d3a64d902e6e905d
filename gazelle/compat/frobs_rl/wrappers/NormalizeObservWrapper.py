"""Observations between -1 and 1."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from gazelle.compat.frobs_rl.wrappers.modern import EitherInterface
from gazelle.errors import TaskError


class NormalizeObservWrapper(EitherInterface, gymnasium.ObservationWrapper[Any, Any, Any]):
    """Observations of a box, scaled so that its bounds become -1 and 1; outside they go beyond.

    Args:
        env: With a box of observations.

    Raises:
        TaskError: Its observations are no box.
    """

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        space = self.env.observation_space
        if not isinstance(space, Box):
            raise TaskError(f"this wants a box of observations, not {space}")
        self.low, self.high = space.low, space.high
        self.observation_space = Box(-1.0, 1.0, space.shape, np.float32)

    def scale_observation(self, observation: Any) -> NDArray[Any]:
        """An observation, scaled.

        Raises:
            ValueError: It has not the shape of the box.
        """
        seen = np.asarray(observation)
        if seen.shape != self.low.shape:
            raise ValueError(f"an observation has the shape {self.low.shape}, not {seen.shape}")
        scaled: NDArray[Any] = 2.0 * (seen - self.low) / (self.high - self.low) - 1.0
        return scaled.astype(np.float32)

    def observation(self, observation: Any) -> NDArray[Any]:
        """The same."""
        return self.scale_observation(observation)
