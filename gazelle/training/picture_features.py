"""The layers of a policy that looks at pictures, in torch: they learn."""

from __future__ import annotations

import gymnasium as gym
import numpy as np
import torch
from stable_baselines3.common.torch_layers import BaseFeaturesExtractor
from torch import nn

from gazelle.array_types import Floats32
from gazelle.training.picture_layers import (
    CHANNELS,
    KERNELS,
    STRIDE,
    PictureLayers,
    pooling_of,
)
from gazelle.training.scaling import ObservationScale


class PictureFeatures(BaseFeaturesExtractor):  # type: ignore[misc]  # untyped base
    """Trainable torch module equivalent to `PictureLayers`.

    Args:
        observation_space: Of pictures, uint8 of shape (height, width, channels).
        scale: Plays no part: colours are scaled by their bounds.
        features: Likewise.
    """

    def __init__(
        self,
        observation_space: gym.spaces.Box,
        *,
        scale: ObservationScale | None = None,
        features: bool = False,
    ) -> None:
        del scale, features
        height, width, entering = observation_space.shape
        self._shape = height, width, entering
        pooling = pooling_of(observation_space.shape)
        layers: list[nn.Module] = [nn.AvgPool2d(pooling)] if pooling > 1 else []
        rows, columns = height // pooling, width // pooling
        for leaving, kernel in zip(CHANNELS, KERNELS, strict=True):
            layers += [nn.Conv2d(entering, leaving, kernel, STRIDE), nn.ReLU()]
            entering = leaving
            rows, columns = ((side - kernel) // STRIDE + 1 for side in (rows, columns))
        super().__init__(observation_space, features_dim=rows * columns * entering)
        self._pooling = pooling
        self.layers = nn.Sequential(*layers)

    def forward(self, observations: torch.Tensor) -> torch.Tensor:
        """Map pictures of shape (N, height, width, channels) to (N, features)."""
        x = observations.float().mul_(1.0 / 255.0).sub_(0.5) if (
            observations.dtype == torch.uint8
        ) else observations * (1.0 / 255.0) - 0.5  # fmt: skip
        made: torch.Tensor = self.layers(x.permute(0, 3, 1, 2))
        # As numpy lays them out: rows, columns, channels.
        return made.permute(0, 2, 3, 1).flatten(1)

    def exported(self) -> PictureLayers:
        """Return the same layers in numpy."""
        convolutions = [layer for layer in self.layers if isinstance(layer, nn.Conv2d)]
        return PictureLayers(
            self._shape,
            self._pooling,
            tuple(_numpy(layer.weight.permute(2, 3, 1, 0)) for layer in convolutions),
            tuple(_numpy(layer.bias) for layer in convolutions if layer.bias is not None),
        )


def _numpy(tensor: torch.Tensor) -> Floats32:
    array: Floats32 = np.ascontiguousarray(tensor.detach().cpu().numpy(), dtype=np.float32).copy()
    return array
