"""Observations to the range that networks like, as the first layer of the network itself.

The scaling is fixed by the bounds of the observation space. So it needs no
running averages that would have to be saved, replayed and exported, and it
folds exactly into the first layer of the numpy actor.
"""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import torch
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor

_LARGEST_BOUND = 1e4


class ScaledObservations(BaseFeaturesExtractor):  # type: ignore[misc]  # untyped base
    """Flattens, and maps each entry with finite bounds to [-1, 1].

    Entries without bounds, or with bounds beyond 1e4, stay as they are.

    Args:
        observation_space: A Box.
        scale: False keeps all entries as they are.
    """

    def __init__(self, observation_space: gym.spaces.Box, *, scale: bool = True) -> None:
        size = int(np.prod(observation_space.shape))
        super().__init__(observation_space, features_dim=size)
        low = observation_space.low.reshape(-1).astype(np.float64)
        high = observation_space.high.reshape(-1).astype(np.float64)
        bounded = (np.abs(low) < _LARGEST_BOUND) & (np.abs(high) < _LARGEST_BOUND) & (high > low)
        bounded &= scale
        low, high = np.where(bounded, low, -1.0), np.where(bounded, high, 1.0)
        span, centre = high - low, 0.5 * (high + low)
        self.register_buffer("gain", torch.as_tensor(2.0 / span, dtype=torch.float32))
        self.register_buffer("offset", torch.as_tensor(-2.0 * centre / span, dtype=torch.float32))

    def forward(self, observations: torch.Tensor) -> torch.Tensor:
        """Shape (N, ...) to (N, entries)."""
        scaled: torch.Tensor = observations.flatten(1) * self.gain + self.offset
        return scaled
