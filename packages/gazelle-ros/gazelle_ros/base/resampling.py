"""Images resampled at places between their pixels, with OpenCV's kinds of interpolation."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.base.array_types import Floats, Pixels

_CUBIC = -0.75
"""Slope of the cubic kernel at a distance of one pixel."""


class Interpolation(IntEnum):
    """Kind of interpolation; numbers are OpenCV's."""

    NEAREST = 0
    LINEAR = 1
    CUBIC = 2
    AREA = 3
    LANCZOS4 = 4


_TAPS = {
    Interpolation.NEAREST: 1,
    Interpolation.LINEAR: 2,
    Interpolation.CUBIC: 4,
    Interpolation.AREA: 2,
    Interpolation.LANCZOS4: 8,
}


class Resampling:
    """Resampling of images of one size at the same places.

    Args:
        columns: Of the places, from the middle of the leftmost pixel, shape (height, width).
        rows: Likewise, from the middle of the highest pixel.
        size: Rows and columns of the images.
        interpolation: Between pixels; areas, which need a scale, are linear (see `resize`).
        replicate: Whether the outermost pixels go on beyond the image; else it is 0 there.
    """

    def __init__(
        self,
        columns: Floats,
        rows: Floats,
        size: tuple[int, int],
        interpolation: Interpolation = Interpolation.LINEAR,
        *,
        replicate: bool = False,
    ) -> None:
        self._shape = columns.shape
        # Places far off would overflow integers, and are all the same.
        across = np.clip(columns.ravel(), -16.0, size[1] + 16.0)
        down = np.clip(rows.ravel(), -16.0, size[0] + 16.0)
        self._across, self._weights = _taps(across, size[1], interpolation, replicate=replicate)
        lines, self._down_weights = _taps(down, size[0], interpolation, replicate=replicate)
        self._down = lines * size[1]

    def apply(self, image: Pixels) -> Pixels:
        """Return the resampled image, of the same type.

        Args:
            image: Shape (rows, columns) or (rows, columns, channels).
        """
        flat = image.reshape(-1, *image.shape[2:])
        total: Pixels = np.zeros(())
        floating = image.dtype.kind == "f"
        for line, down in zip(self._down, self._down_weights, strict=True):
            for place, across in zip(self._across, self._weights, strict=True):
                weight = down * across
                if image.ndim > 2:
                    weight = weight[:, None]
                part = flat.take(line + place, axis=0)
                if floating:  # infinity and NaN count only where they have a weight
                    part = np.where(weight != 0.0, part, 0.0)
                total = total + part * weight
        return _as_type(total, image.dtype).reshape(*self._shape, *image.shape[2:])


def resize(image: Pixels, height: int, width: int, interpolation: Interpolation) -> Pixels:
    """Return an image of another size; edges of the outermost pixels are where they were.

    Args:
        image: Shape (rows, columns) or (rows, columns, channels).
        height: Rows wanted.
        width: Columns wanted.
        interpolation: Areas are means of what a pixel covers, where the image becomes smaller.
    """
    rows, columns = image.shape[:2]
    if interpolation is Interpolation.AREA and height <= rows and width <= columns:
        return _means(image, height, width)
    down, across = np.arange(height) * (rows / height), np.arange(width) * (columns / width)
    if interpolation is Interpolation.NEAREST:
        return np.ascontiguousarray(image[down.astype(np.intp)][:, across.astype(np.intp)])
    down, across = down + 0.5 * (rows / height - 1.0), across + 0.5 * (columns / width - 1.0)
    columns_at, rows_at = np.meshgrid(across, down)
    return Resampling(columns_at, rows_at, (rows, columns), interpolation, replicate=True).apply(
        image
    )


def _taps(
    places: Floats, count: int, interpolation: Interpolation, *, replicate: bool
) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Return indices and weights of the pixels around places, shapes (taps, n)."""
    taps = _TAPS[interpolation]
    if taps == 1:
        index = np.rint(places).astype(np.int32)[None]
        weights = np.ones(index.shape, np.float32)
    else:
        first = np.floor(places)
        apart = np.arange(1 - taps // 2, taps // 2 + 1, dtype=np.int32)[:, None]
        index = first.astype(np.int32) + apart
        weights = _kernel(np.abs(places - first - apart), interpolation).astype(np.float32)
    if not replicate:
        weights = np.where((index >= 0) & (index < count), weights, np.float32(0.0))
    return np.clip(index, 0, count - 1), weights


def _kernel(away: Floats, interpolation: Interpolation) -> Floats:
    """Return weights of pixels by their distances, which add up to 1; shape (taps, n)."""
    if interpolation in {Interpolation.LINEAR, Interpolation.AREA}:
        return 1.0 - away
    if interpolation is Interpolation.CUBIC:
        near = ((_CUBIC + 2.0) * away - (_CUBIC + 3.0)) * away * away + 1.0
        far = ((_CUBIC * away - 5.0 * _CUBIC) * away + 8.0 * _CUBIC) * away - 4.0 * _CUBIC
        return np.where(away <= 1.0, near, far)
    weights: Floats = np.sinc(away) * np.sinc(away / 4.0)
    weights /= weights.sum(axis=0)
    return weights


def _means(image: Pixels, height: int, width: int) -> Pixels:
    """Return the means of what the pixels of a smaller image cover."""
    down, across = _shares(image.shape[0], height), _shares(image.shape[1], width)
    means = np.tensordot(down, image, axes=1)  # (height, columns[, channels])
    means = np.moveaxis(np.tensordot(means, across, axes=(1, 1)), -1, 1)
    return _as_type(means, image.dtype)


def _shares(count: int, size: int) -> Floats:
    """Return the share of each pixel in those that cover it, shape (wanted, count)."""
    edges = np.arange(size + 1) * (count / size)
    pixels = np.arange(count)
    low = np.maximum(edges[:-1, None], pixels)
    high = np.minimum(edges[1:, None], pixels + 1.0)
    shares: Floats = np.maximum(high - low, 0.0) * (size / count)
    return shares


def _as_type(values: Pixels, kind: np.dtype[Any]) -> Pixels:
    """Return values as another type, rounded and within its range."""
    if kind.kind == "f":
        return values.astype(kind)
    limits = np.iinfo(kind)
    return np.clip(np.rint(values), limits.min, limits.max).astype(kind)
