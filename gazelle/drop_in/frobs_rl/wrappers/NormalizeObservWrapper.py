"""Observations between -1 and 1."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from gazelle.drop_in.frobs_rl.wrappers.modern import EitherGymApi
from gazelle.drop_in.frobs_rl.wrappers.unit_boxes import UnitBox


class NormalizeObservWrapper(EitherGymApi, gymnasium.ObservationWrapper[Any, Any, Any]):
    """Observations of a box, scaled so that its bounds become -1 and 1; outside they go beyond.

    Args:
        env: With a box of observations.

    Raises:
        TaskError: Its observations are no box.
    """

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self._box = UnitBox(self.env.observation_space, "observations")
        self.low, self.high = self._box.low, self._box.high
        self.observation_space = self._box.space

    def scale_observation(self, observation: Any) -> NDArray[Any]:
        """Return an observation, scaled.

        Raises:
            ValueError: It has not the shape of the box.
        """
        seen = np.asarray(observation)
        if seen.shape != self.low.shape:
            raise ValueError(f"an observation has the shape {self.low.shape}, not {seen.shape}")
        return self._box.shrunk(seen).astype(np.float32)

    def observation(self, observation: Any) -> NDArray[Any]:
        """Return the scaled observation."""
        return self.scale_observation(observation)
