"""The ground among points: a horizontal plane near z = 0 of the robot's base."""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass

import numpy as np

from gazelle_ros.base.array_types import Bools, Floats
from gazelle_ros.base.errors import RosError

_FEWEST = 50
"""Clouds of fewer points have no ground."""
_FEWEST_LEFT = 10
_TRIES = 100
_LOG = logging.getLogger("gazelle.ros.octomap")


@dataclass(frozen=True, slots=True)
class GroundFilter:
    """Parameters below ``ground_filter``.

    Attributes:
        distance: Greatest distance of a point from the plane [m].
        angle: Greatest angle of the plane with the horizontal [rad].
        plane_distance: Greatest distance of the plane from z = 0 [m].
    """

    distance: float = 0.04
    angle: float = 0.15
    plane_distance: float = 0.07

    def __post_init__(self) -> None:
        if not (0.0 < self.distance < math.inf and 0.0 < self.plane_distance < math.inf):
            raise RosError("'distance' and 'plane_distance' of ground_filter are above 0")
        if not 0.0 < self.angle <= math.pi / 2.0:
            raise RosError(f"'angle' of ground_filter must be from 0 to pi/2, not {self.angle}")

    def ground(self, points: Floats) -> Bools:
        """Return which points are ground, shape (n,).

        Horizontal planes farther from z = 0, such as tables, are skipped. Where there is none, all points
        near z = 0 are ground. Method: M. Fischler and R. Bolles, "Random sample consensus", 1981.

        Args:
            points: In the frame of the base, shape (n, 3).
        """
        left = np.flatnonzero(np.isfinite(points).all(axis=1))
        found = np.zeros(len(points), np.bool_)
        if len(left) < _FEWEST:
            _LOG.warning("a cloud of %d points is too small to find the ground in", len(left))
            return found
        random = np.random.default_rng(0)  # the same cloud has the same ground
        while len(left) > _FEWEST_LEFT:
            plane = self._plane(points[left], random)
            if plane is None:
                break
            members, height = plane
            if abs(height) < self.plane_distance:
                found[left[members]] = True
                return found
            left = left[~members]
        _LOG.warning("there is no plane of the ground in a cloud")
        found[np.abs(points[:, 2]) < self.plane_distance] = True
        return found

    def _plane(self, points: Floats, random: np.random.Generator) -> tuple[Bools, float] | None:
        """Return the points of the best horizontal plane, and its distance from the origin [m]."""
        corners = points[random.integers(0, len(points), (_TRIES, 3))]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        sizes = np.linalg.norm(normals, axis=1)
        flat = (sizes > 1e-12) & (np.abs(normals[:, 2]) >= math.cos(self.angle) * sizes)
        if not flat.any():
            return None
        normals = normals[flat] / sizes[flat, None]
        heights = np.einsum("ij,ij->i", normals, corners[flat, 0])
        near = np.abs(points @ normals.T - heights) <= self.distance
        best = int(near.sum(axis=0).argmax())
        members = near[:, best]
        # The plane of least squares through those points, and what is near it.
        middle = points[members].mean(axis=0)
        normal = np.linalg.svd(points[members] - middle, full_matrices=False)[2][2]
        if abs(normal[2]) >= math.cos(self.angle):
            again = np.abs((points - middle) @ normal) <= self.distance
            if again.sum() >= members.sum():
                return again, float(middle @ normal)
        return members, float(heights[best])
