"""The layers of a policy that looks at pictures, in numpy: they act without torch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import gymnasium as gym
import numpy as np
import numpy.typing as npt

from gazelle.array_types import Bytes, Floats32

CHANNELS = (16, 32)
"""Of the convolutions."""
KERNELS = (5, 3)
"""Their sides."""
STRIDE = 2
"""Of all of them."""
_COARSE = 28  # pixels along a side that the first convolution sees, about


def is_picture(space: gym.Space[Any]) -> bool:
    """Return whether observations are images, uint8 of shape (height, width, channels)."""
    return isinstance(space, gym.spaces.Box) and space.dtype == np.uint8 and len(space.shape) == 3


def observation_dtype(space: gym.Space[Any]) -> npt.DTypeLike:
    """Return the dtype in which observations are stored: bytes for images, else float32."""
    return np.uint8 if is_picture(space) else np.float32


def pooling_of(shape: tuple[int, ...]) -> int:
    """Return the number of pixels per side that are pooled into one before the first convolution."""
    return max(1, min(shape[0], shape[1]) // _COARSE)


@dataclass(frozen=True, slots=True)
class PictureLayers:
    """Means of squares of pixels, then convolutions with a ReLU each, then all in a row.

    Attributes:
        shape: Of a picture: height, width, channels.
        pooling: Side of the squares.
        weights: Of the convolutions, shape (rows, columns, channels in, channels out), float32.
        biases: Shape (channels out,).
    """

    shape: tuple[int, int, int]
    pooling: int
    weights: tuple[Floats32, ...]
    biases: tuple[Floats32, ...]

    @property
    def inputs(self) -> int:
        """Entries of a picture."""
        return int(np.prod(self.shape))

    def features(self, pictures: Bytes | Floats32) -> Floats32:
        """Return the features of images of shape (N, entries): shape (N, features), float32."""
        x = self._pooled(pictures.reshape(-1, *self.shape))
        for weight, bias in zip(self.weights, self.biases, strict=True):
            x = _convolved(x, weight, STRIDE)
            x += bias
            np.maximum(x, 0.0, out=x)
        return x.reshape(len(x), -1)

    def _pooled(self, pictures: Bytes | Floats32) -> Floats32:
        """Return means, from -0.5 to 0.5; the remainder at the right and below is ignored."""
        side = self.pooling
        count, height, width, channels = pictures.shape
        rows, columns = height // side, width // side
        cut = pictures[:, : rows * side, : columns * side]
        squares = cut.reshape(count, rows, side, columns, side, channels)
        means: Floats32 = squares.mean(axis=(2, 4), dtype=np.float32)
        means *= np.float32(1.0 / 255.0)
        means -= np.float32(0.5)
        return means


def _convolved(x: Floats32, weight: Floats32, stride: int) -> Floats32:
    """Return a convolution without padding: x of shape (N, rows, columns, channels)."""
    rows, columns, entering, leaving = weight.shape
    windows = np.lib.stride_tricks.sliding_window_view(x, (rows, columns), axis=(1, 2))
    windows = windows[:, ::stride, ::stride].transpose(0, 1, 2, 4, 5, 3)
    count, high, wide = windows.shape[:3]
    flat = windows.reshape(count * high * wide, rows * columns * entering)
    made: Floats32 = flat @ weight.reshape(-1, leaving)
    return made.reshape(count, high, wide, leaving)
