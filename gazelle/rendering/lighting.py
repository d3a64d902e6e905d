# cython: infer_types=True, annotation_typing=False
"""Brightness of a matt surface: lamps, ambient light, and the sky."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.rendering.columns import (
    ALONG,
    COLOR,
    CONSTANT,
    DIRECTIONAL,
    INNER,
    KIND,
    LINEAR,
    OUTER,
    QUADRATIC,
    REACH,
    SPOT,
)  # fmt: skip
from cython.cimports.libc.math import sqrt

from gazelle.array_types import Bytes, Floats


class Lighting:
    """The lamps of a world, as cameras of one thread see them.

    Args:
        lamps: As ``columns.KIND`` and what follows say, in the world, shape (n, LAMP).
        ambient: Light from all around, red, green and blue, shape (3,).
        top: Colour of the sky overhead, shape (3,).
        horizon: Colour of the sky at the horizon, and of all that is not sky, shape (3,).
        tones: Values of pixels for brightnesses from 0 to 1, evenly spaced, shape (n,).
    """

    def __init__(
        self, lamps: Floats, ambient: Floats, top: Floats, horizon: Floats, tones: Bytes
    ) -> None:
        import numpy as np

        self.lamps, self.ambient, self.top, self.horizon = lamps, ambient, top, horizon
        self.tones = tones
        self.seen = np.zeros((max(len(lamps), 1), 6))  # place and direction for the camera
        self.up = np.zeros(3)
        self.sky = any(top[k] != horizon[k] for k in range(3))
        self.local = bool((lamps[:, KIND] != DIRECTIONAL).any())
        self.caster, self.share = (
            -1,
            1.0,
        )  # the lamp that has shadows, and what of it falls somewhere

    def look(self, cameras: Floats, n: int) -> None:
        """Transform all lamps to the frame of camera n."""
        for k in range(3):
            self.up[k] = cameras[n, 4 + 3 * k + 2]
        for i in range(self.lamps.shape[0]):
            for k in range(3):
                right = 4 + 3 * k
                place = along = 0.0
                for j in range(3):
                    place += cameras[n, right + j] * (self.lamps[i, 1 + j] - cameras[n, 1 + j])
                    along += cameras[n, right + j] * self.lamps[i, ALONG + j]
                self.seen[i, k], self.seen[i, 3 + k] = place, along

    def light_up(self, x: float, y: float, z: float, normal: Floats, out: Floats) -> None:
        """Compute the light on a matt surface: red, green and blue.

        Args:
            x: Of the place in the camera's frame [m].
            y: Likewise.
            z: Likewise.
            normal: Of the surface, in the camera's frame, of unit length.
            out: Comes out, shape (3,).
        """
        height = normal[0] * self.up[0] + normal[1] * self.up[1] + normal[2] * self.up[2]
        for k in range(3):
            out[k] = self.ambient[k] * (0.75 + 0.25 * height)
        for i in range(self.lamps.shape[0]):
            shine = self.reaching(i, x, y, z, normal)
            if i == self.caster:
                shine *= self.share
            if shine > 0.0:
                for k in range(3):
                    out[k] += shine * self.lamps[i, COLOR + k]

    def reaching(self, k: int, x: float, y: float, z: float, normal: Floats) -> float:
        """Return the share of a lamp's light that falls on a surface."""
        if self.lamps[k, KIND] == DIRECTIONAL:
            cosine = -(
                normal[0] * self.seen[k, 3]
                + normal[1] * self.seen[k, 4]
                + normal[2] * self.seen[k, 5]
            )
            return max(cosine, 0.0)  # type: ignore[no-any-return]
        dx, dy, dz = self.seen[k, 0] - x, self.seen[k, 1] - y, self.seen[k, 2] - z
        away = sqrt(dx * dx + dy * dy + dz * dz)
        cosine = (normal[0] * dx + normal[1] * dy + normal[2] * dz) / max(away, 1e-9)
        if cosine <= 0.0 or away > self.lamps[k, REACH]:
            return 0.0
        fade = self.lamps[k, CONSTANT] + away * (
            self.lamps[k, LINEAR] + away * self.lamps[k, QUADRATIC]
        )
        fade = min(1.0 / max(fade, 1e-6), 1.0)
        if self.lamps[k, KIND] == SPOT:
            along = -(dx * self.seen[k, 3] + dy * self.seen[k, 4] + dz * self.seen[k, 5])
            inner, outer = self.lamps[k, INNER], self.lamps[k, OUTER]
            share = (along / max(away, 1e-9) - outer) / max(inner - outer, 1e-6)
            fade *= min(max(share, 0.0), 1.0)
        return cosine * fade  # type: ignore[no-any-return]

    def tone(self, value: float) -> int:
        """Return the pixel value of a brightness."""
        most = self.tones.shape[0] - 1
        at = min(max(value, 0.0), 1.0) * most + 0.5
        return self.tones[cython.cast(cython.Py_ssize_t, at)]  # type: ignore[no-any-return]

    def backdrop(self, up: float, out: Floats) -> None:
        """Compute the colour at infinity, in a direction whose z in the world is ``up``."""
        share = min(max(up, 0.0), 1.0)
        share = sqrt(share)  # most of the change is near the horizon
        for k in range(3):
            out[k] = self.horizon[k] + share * (self.top[k] - self.horizon[k])
