"""Convex hulls of points in space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Indices
from gazelle.geometry.integer_hull import HullBuilder

Solid = tuple[Floats, NDArray[np.int32]]
"""Vertices, shape (n, 3), and faces, shape (m, 3)."""


@dataclass(frozen=True, slots=True)
class Hull:
    """A convex hull.

    Attributes:
        faces: Corners of its triangles as rows of the points, counter-clockwise from
            outside, shape (m, 3).
        normals: Unit vectors outwards, shape (m, 3).
        offsets: Distance of each face's plane from the origin along its normal, shape (m,); no
            corner is beyond it by more than four millionths of the size.
    """

    faces: Indices
    normals: Floats
    offsets: Floats

    def depth(self, points: Floats) -> Floats:
        """Return the depth of points below the surface, shape (n,); negative outside."""
        gaps = self.offsets[:, None] - self.normals @ points.T
        depth: Floats = gaps.min(axis=0)
        return depth


def convex_hull(points: Floats) -> Hull | None:
    """Return the hull of points, shape (n, 3); None if they lie in a plane.

    A point that stands out of it by less than two millionths of the size may be no corner.
    """
    builder = HullBuilder(len(points))
    faces = builder.hull(points)
    if faces is None:
        return None
    normals = builder.normals()
    heights = np.einsum("ijk,ik->ij", points[faces], normals)
    return Hull(faces, normals, heights.max(axis=1))


def hulls_of(clouds: Sequence[Floats]) -> list[Solid]:
    """Return corners and faces of the hulls of points, shapes (n, 3).

    Those in a plane are left out.
    """
    builder = HullBuilder(max(map(len, clouds), default=0))
    found = ((points, builder.hull(points)) for points in clouds)
    return [_used(points, faces) for points, faces in found if faces is not None]


def _used(points: Floats, faces: Indices) -> Solid:
    rows, inverse = np.unique(faces, return_inverse=True)
    return points[rows], inverse.reshape(-1, 3).astype(np.int32)


def spread_directions(count: int) -> Floats:
    """Return unit vectors distributed over the sphere, along a spiral, shape (count, 3).

    After Vogel, "A better way to construct the sunflower head", Mathematical Biosciences 44, 1979.
    """
    turn = math.pi * (3.0 - math.sqrt(5.0)) * np.arange(count)
    z = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    ring = np.sqrt(1.0 - z * z)
    return np.stack([ring * np.cos(turn), ring * np.sin(turn), z], axis=1)
