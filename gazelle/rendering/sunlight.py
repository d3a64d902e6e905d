# cython: infer_types=True, annotation_typing=False
"""Lighting by the lamp that has shadows, looked up in a depth picture along its light."""

from __future__ import annotations

import cython
import numpy as np

from gazelle.rendering.rasterizer import Rasterizer
from gazelle.rendering.shadow_maps import ShadowMaps


class Sunlight:
    """The lamp's picture for one camera at a time.

    Args:
        seen: Triangles that the cameras see.
        maps: Shadow maps of the lamp; None for no shadows.
    """

    def __init__(self, seen: Rasterizer, maps: ShadowMaps | None) -> None:
        self.turns, self.pixel = np.empty((0, 12)), 0.0
        self.there = maps is not None
        if maps is not None:
            square = maps.side, maps.side
            self.shadow = Rasterizer(seen.shapes, seen.links, maps.cameras, maps.lens, square)
            self.turns, self.pixel = maps.turns, maps.pixel

    def draw(self, n: int) -> None:
        """Draw the lamp's picture for camera n."""
        self.shadow.draw(n)

    def share(self, n: int, x: float, y: float, z: float, a: float, b: float, c: float) -> float:
        """Return the share of the lamp that falls on a place: 0 in shadow.

        The place is lifted off its surface by one and a half pixels of the lamp's picture, so that it
        is not in the shadow of itself.

        Args:
            n: The camera that the picture was drawn for.
            x: Of the place in the camera's frame [m].
            y: Likewise.
            z: Likewise.
            a: Of the surface's normal in that frame, of unit length.
            b: Likewise.
            c: Likewise.
        """
        lift = 1.5 * self.pixel
        a, b, c = x + lift * a, y + lift * b, z + lift * c
        u = self.turns[n, 0] * a + self.turns[n, 1] * b + self.turns[n, 2] * c + self.turns[n, 9]
        v = self.turns[n, 3] * a + self.turns[n, 4] * b + self.turns[n, 5] * c + self.turns[n, 10]
        w = self.turns[n, 6] * a + self.turns[n, 7] * b + self.turns[n, 8] * c + self.turns[n, 11]
        if w < self.shadow.near:
            return 1.0
        u = self.shadow.cx + self.shadow.fx * u / w - 0.5
        v = self.shadow.cy + self.shadow.fy * v / w - 0.5
        if u < 0.0 or v < 0.0 or u >= self.shadow.width - 1 or v >= self.shadow.height - 1:
            return 1.0  # beyond what has shadows
        i, j = cython.cast(cython.Py_ssize_t, u), cython.cast(cython.Py_ssize_t, v)
        u, v = u - i, v - j
        a, b = 1.0 - u, 1.0 - v
        c, lit = 1.0 / (w - 0.5 * self.pixel), 0.0
        if self.shadow.inverse[j, i] <= c:
            lit += a * b
        if self.shadow.inverse[j, i + 1] <= c:
            lit += u * b
        if self.shadow.inverse[j + 1, i] <= c:
            lit += a * v
        if self.shadow.inverse[j + 1, i + 1] <= c:
            lit += u * v
        return lit
