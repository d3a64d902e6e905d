"""The surface of a mesh: cleaned triangles, and what of them hangs together."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Indices
from gazelle.geometry.ray_hits import TriangleRays
from gazelle.geometry.slivers import flip_slivers, half_edge_twins

_BITS = 21
"""Of a coordinate that places are distinguished by: a two-millionth of the size."""
_SLIVER = 2.0
"""Width of triangles that count as none, in such parts."""


@dataclass(frozen=True)
class WeldedSurface:
    """Triangles with shared vertices.

    Attributes:
        vertices: [m], shape (n, 3).
        faces: Corners, counter-clockwise from outside, shape (m, 3); none is degenerate,
            none there twice.
        normals: Unit vectors outwards, shape (m, 3).
        areas: [m²], shape (m,).
    """

    vertices: Floats
    faces: Indices
    normals: Floats
    areas: Floats

    @cached_property
    def size(self) -> float:
        """Diagonal of the bounding box [m]."""
        return float(np.linalg.norm(np.ptp(self.vertices[self.faces].reshape(-1, 3), axis=0)))

    @cached_property
    def twins(self) -> Indices:
        """The half-edge that runs back along each, shape (3 m,); -1 if there is none, or several.

        Half-edge 3 f + i of face f runs from its corner i to the next.
        """
        return half_edge_twins(self.faces, len(self.vertices))

    @cached_property
    def rays(self) -> TriangleRays:
        """Rays against the faces, of which there is at least one."""
        return TriangleRays(self.vertices, self.faces, self.size)

    @property
    def volume(self) -> float:
        """Signed volume [m³], if it is closed; negative if its faces look inwards."""
        a, b, c = (self.vertices[self.faces[:, i]] - self.vertices[0] for i in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0

    def part(self, rows: Indices | NDArray[np.bool_]) -> WeldedSurface:
        """Return some of the faces, with their vertices only."""
        used, inverse = np.unique(self.faces[rows], return_inverse=True)
        faces = inverse.reshape(-1, 3).astype(np.intp)
        return WeldedSurface(self.vertices[used], faces, self.normals[rows], self.areas[rows])

    def is_closed(self) -> bool:
        """Return whether each edge belongs to two faces, which run along it in opposite directions."""
        return bool((self.twins >= 0).all())


def clean(vertices: Floats, faces: NDArray[np.int32]) -> WeldedSurface:
    """Weld corners at the same place; remove duplicate faces, and those without area.

    Where several corners lie on one line, the triangles without area between them are gone, and
    those beside them are divided there, so that a closed surface stays closed.

    Of two faces that are each other's back, as in sheets drawn from both sides, the first
    is kept.
    """
    corners = vertices[faces].reshape(-1, 3)
    step = max(float(np.ptp(corners, axis=0).max()) / (2.0**_BITS - 2.0), 1e-300)
    keys = _packed(np.round((corners - corners.min(axis=0)) / step).astype(np.int64))
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    points = corners[first]
    welded = inverse.reshape(-1, 3).astype(np.intp)
    alike = np.sort(welded, axis=1)
    if len(points) < 1 << _BITS:
        _, kept = np.unique(_packed(alike), return_index=True)
    else:
        _, kept = np.unique(alike, axis=0, return_index=True)
    welded = welded[np.sort(kept)]
    welded = welded[(np.diff(np.sort(welded, axis=1), axis=1) > 0).all(axis=1)]
    welded = flip_slivers(points, welded, _SLIVER * step)
    a, b, c = (points[welded[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    doubled = np.linalg.norm(normals, axis=1)
    real = doubled > step * step
    normals = normals[real] / doubled[real, None]
    return WeldedSurface(points, welded[real], normals, doubled[real] / 2.0)


def _packed(rows: Indices) -> NDArray[np.int64]:
    """Return three numbers below 2^21 a row as one, shape (n,)."""
    return (rows[:, 0] << 2 * _BITS) + (rows[:, 1] << _BITS) + rows[:, 2]


def components(surface: WeldedSurface) -> Indices:
    """Return the index of the connected part of each face, shape (m,); parts share corners.

    They are numbered from 0 in the order of their first faces.
    """
    label = np.arange(len(surface.vertices))
    corners = surface.faces
    while True:  # each vertex takes the least label around it, and that label's own label
        least = label[corners].min(axis=1)
        after = label.copy()
        np.minimum.at(after, corners.ravel(), np.repeat(least, 3))
        after = after[after]
        if np.array_equal(after, label):
            break
        label = after
    _, first, number = np.unique(label[corners[:, 0]], return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.intp)
    rank[np.argsort(first, kind="stable")] = np.arange(len(first))
    return rank[number]
