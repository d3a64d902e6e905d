# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""Rays that frames carry: where they are in the world, and what distances mean."""

from __future__ import annotations

from typing import Any

import cython
import numpy as np

from gazelle.array_types import Bools, Floats

INF = cython.declare(cython.double, float("inf"))


@cython.cclass
class FrameRays:
    """Rays fixed to frames, in some worlds, and their hits.

    Args:
        origins: In the frames [m], shape (frames, rays, 3).
        directions: Unit vectors in the frames, likewise.
        worlds: Number of worlds, n.

    Attributes:
        start: Origins in the world [m], shape (n, frames * rays, 3).
        along: Unit vectors in the world, likewise.
        distance: To what is met [m], shape (n, frames * rays).
        normal: Of the surfaces that are met, shape (n, frames * rays, 3).
        geom: Index of the geom that is hit, shape (n, frames * rays); negative for nothing.
        passed: Body that each ray passes through, likewise; -1 for none.
        inside: Whether it is met from inside, likewise.
    """

    def __init__(self, origins: Floats, directions: Floats, worlds: int) -> None:
        self.carried, self.pointed = origins, directions
        count = origins.shape[0] * origins.shape[1]
        self.start, self.along, self.normal = np.zeros((3, worlds, count, 3))
        self.distance = np.zeros((worlds, count))
        self.geom = np.zeros((worlds, count), np.int32)
        self.passed = np.full((worlds, count), -1, np.int32)
        self.inside = np.zeros((worlds, count), np.bool_)
        self.starts, self.alongs, self.normals = self.start, self.along, self.normal
        self.distances, self.geoms = self.distance, self.geom
        self.insides = self.inside.view(np.uint8)

    def aim(self, position: Floats, quaternion: Floats, beside: Floats) -> None:
        """Compute ``start`` and ``along``.

        Args:
            position: Of the frames [m], shape (n, frames, 3).
            quaternion: (x, y, z, w), of length one, shape (n, frames, 4).
            beside: Added to every origin [m], shape (3,).
        """
        self.point(position, quaternion, beside)

    def settle(self, sheet: Bools, *, signed: bool) -> None:
        """Compute ``inside``, and set ``distance`` to infinity where it is less than zero.

        Args:
            sheet: Things that have no inside, shape (geoms,).
            signed: Whether to set ``distance`` to minus infinity where something is met from inside.
        """
        self.judge(sheet.view(np.uint8), signed)

    def point(self, position: Any, quaternion: Any, beside: Any) -> None:
        """Do what ``aim`` says."""
        for n in range(position.shape[0]):
            for frame in range(self.carried.shape[0]):
                self.point_frame(
                    n,
                    frame,
                    position[n, frame, 0] + beside[0],
                    position[n, frame, 1] + beside[1],
                    position[n, frame, 2] + beside[2],
                    quaternion[n, frame, 0],
                    quaternion[n, frame, 1],
                    quaternion[n, frame, 2],
                    quaternion[n, frame, 3],
                )

    def point_frame(
        self,
        n: int,
        frame: int,
        px: float,
        py: float,
        pz: float,
        x: float,
        y: float,
        z: float,
        w: float,
    ) -> None:
        """Compute ``start`` and ``along`` of a frame in a world, from its position and quaternion."""
        rays = self.carried.shape[1]
        for ray in range(rays):
            at = frame * rays + ray
            a, b = self.carried[frame, ray, 0], self.carried[frame, ray, 1]
            c = self.carried[frame, ray, 2]
            i, j, k = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
            self.starts[n, at, 0] = px + (a + w * i + (y * k - z * j))
            self.starts[n, at, 1] = py + (b + w * j + (z * i - x * k))
            self.starts[n, at, 2] = pz + (c + w * k + (x * j - y * i))
            a, b = self.pointed[frame, ray, 0], self.pointed[frame, ray, 1]
            c = self.pointed[frame, ray, 2]
            i, j, k = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
            self.alongs[n, at, 0] = a + w * i + (y * k - z * j)
            self.alongs[n, at, 1] = b + w * j + (z * i - x * k)
            self.alongs[n, at, 2] = c + w * k + (x * j - y * i)

    def judge(self, sheet: Any, signed: bool) -> None:  # noqa: FBT001  of C
        """Do what ``settle`` says."""
        for n in range(self.distances.shape[0]):
            self.judge_some(n, 0, self.distances.shape[1], sheet, signed)

    def judge_some(self, n: int, first: int, last: int, sheet: Any, signed: bool) -> None:  # noqa: FBT001  of C
        """Do what ``settle`` says of some rays of one world."""
        for ray in range(first, last):
            out = (
                self.normals[n, ray, 0] * self.alongs[n, ray, 0]
                + self.normals[n, ray, 1] * self.alongs[n, ray, 1]
                + self.normals[n, ray, 2] * self.alongs[n, ray, 2]
            )
            geom = self.geoms[n, ray]
            within = out > 0.0 and geom >= 0 and sheet[geom] == 0
            self.insides[n, ray] = within
            if self.distances[n, ray] < 0.0:
                self.distances[n, ray] = INF
            if within and signed:
                self.distances[n, ray] = -INF
