"""Pictures from the pixels of others: each a mean of the four about a place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Bytes, Floats, Indices
from gazelle.errors import EngineError


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class PixelMeans:
    """Four pixels that each output pixel is a mean of, and their weights.

    Attributes:
        shape: Rows and columns of the pictures that are made.
        indices: Of pixels in a row of all, one after another, shape (4, rows * columns).
        weights: Shares of them, likewise.
    """

    shape: tuple[int, int]
    indices: Indices
    weights: Floats

    @classmethod
    def about(
        cls, places: Floats, inside: Bools, size: tuple[int, int], first: Indices | int = 0
    ) -> PixelMeans:
        """Return the means of the pixels about some places.

        Args:
            places: Column and row, whole numbers in the middle of pixels, shape (rows, columns, 2);
                beyond the pixels at the edge it is these.
            inside: Mask of pixels that are not black, shape (rows, columns).
            size: Rows and columns of a picture that they are taken from.
            first: The number of its first pixel, if it is one of several.

        Raises:
            EngineError: The shapes do not fit.
        """
        if places.shape != (*inside.shape, 2) or inside.ndim != 2:
            raise EngineError(f"places of shape {places.shape} do not fit a mask of {inside.shape}")
        height, width = size
        spot = np.clip(np.where(inside[..., None], places, 0.0), 0.0, [width - 1.0, height - 1.0])
        low = np.minimum(np.floor(spot).astype(np.intp), [max(width - 2, 0), max(height - 2, 0)])
        share = spot - low
        indices, weights = [], []
        for dy in (0, 1):
            for dx in (0, 1):
                x = np.minimum(low[..., 0] + dx, width - 1)
                y = np.minimum(low[..., 1] + dy, height - 1)
                part = (share[..., 0] if dx else 1.0 - share[..., 0]) * (
                    share[..., 1] if dy else 1.0 - share[..., 1]
                )
                indices.append((first + y * width + x).ravel())
                weights.append(np.where(inside, part, 0.0).ravel())
        rows, columns = places.shape[:2]
        return cls((rows, columns), np.stack(indices), np.stack(weights))

    def of(self, pixels: Bytes) -> Bytes:
        """Return the pictures, (n, rows, columns, 3), of all pixels of others, (n, m, 3)."""
        mixed = sum(
            weight[:, None] * pixels[:, index]
            for index, weight in zip(self.indices, self.weights, strict=True)
        )
        made: Bytes = np.rint(mixed).astype(np.uint8).reshape(len(pixels), *self.shape, 3)
        return made
