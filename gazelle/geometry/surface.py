"""The surface of a mesh: cleaned triangles, and what of them hangs together."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.half_edges import half_edge_twins, unlike_neighbors
from gazelle.geometry.ray_hits import TriangleRays
from gazelle.geometry.slivers import flip_slivers
from gazelle.geometry.triangle_distances import TriangleDistances

_BITS = 21
"""Of a coordinate that places are distinguished by: a two-millionth of the size."""
_SLIVER = 2.0
"""Width of triangles that count as none, in such parts."""
_NOTHING = 1e-10
"""Volume of what is no body, as a share of the cube of the size."""


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
        used = self.vertices.T[:, self.faces.ravel()]
        return float(np.linalg.norm(np.ptp(used, axis=1)))

    @cached_property
    def twins(self) -> Indices:
        """The half-edge that runs back along each, shape (3 m,); -1 if there is none.

        Half-edge 3 f + i of face f runs from its corner i to the next. Where bodies touch along an
        edge, each has its own two faces there.
        """
        return half_edge_twins(self.vertices, self.faces)

    @cached_property
    def rays(self) -> TriangleRays:
        """Rays against the faces, of which there is at least one."""
        return TriangleRays(self.vertices, self.faces, self.size)

    @cached_property
    def distances(self) -> TriangleDistances:
        """Distances from the faces, of which there is at least one."""
        return TriangleDistances(self.rays)

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
    is kept. Where two bodies touch they are one, and neither is. Triangles that face another way than
    most of what they hang together with are turned over.
    """
    corners = vertices[faces].reshape(-1, 3)
    step = max(float(np.ptp(corners, axis=0).max()) / (2.0**_BITS - 2.0), 1e-300)
    keys = _packed(np.round((corners - corners.min(axis=0)) / step).astype(np.int64))
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    points = corners[first]
    welded = inverse.reshape(-1, 3).astype(np.intp)
    a, b, c = welded.T
    welded = welded[(a != b) & (b != c) & (c != a)]
    welded = flip_slivers(points, _single(points, welded), _SLIVER * step)
    normals, doubled = _normals(points, welded)
    real = doubled > step * step
    return _one_way(WeldedSurface(points, welded[real], normals[real], doubled[real] / 2.0))


def _one_way(surface: WeldedSurface) -> WeldedSurface:
    """Return a surface whose triangles face as most of those do that they hang together with."""
    unlike = unlike_neighbors(surface.vertices, surface.faces)
    if not len(unlike):
        return surface
    number = components(surface)
    ends = np.unique(number[unlike], axis=0)
    source, target = np.concatenate([ends, ends[:, ::-1]]).T
    group, side = np.arange(number.max() + 1), np.ones(number.max() + 1)
    while True:  # each part takes the least number beside it, and faces against that part
        least = group.copy()
        np.minimum.at(least, target, group[source])
        rows = np.flatnonzero((least < group)[target] & (group[source] == least[target]))
        if not len(rows):
            break
        side[target[rows]], group = -side[source[rows]], least
    side, group = side[number], group[number]
    side *= np.sign(np.bincount(group, side * surface.areas))[group]
    return turned(surface, side < 0.0)


def turned(surface: WeldedSurface, rows: Bools) -> WeldedSurface:
    """Return a surface with some of its faces turned over."""
    if not rows.any():
        return surface
    faces, normals = surface.faces.copy(), surface.normals.copy()
    faces[rows], normals[rows] = faces[rows, ::-1], -normals[rows]
    return WeldedSurface(surface.vertices, faces, normals, surface.areas)


def _normals(points: Floats, faces: Indices) -> tuple[Floats, Floats]:
    """Return the unit normal and twice the area of each triangle; zeros of one without area."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    doubled: Floats = np.linalg.norm(normals, axis=1)
    return normals / np.maximum(doubled, 1e-300)[:, None], doubled


def _single(points: Floats, faces: Indices) -> Indices:
    """Return triangles without duplicates and backs, and without those between bodies."""
    ranks = np.argsort(faces, axis=1)
    alike = np.take_along_axis(faces, ranks, axis=1)
    keys = _packed(alike) if len(points) < 1 << _BITS else _numbered(alike)
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(faces):
        return faces
    odd = (ranks[:, 1] - ranks[:, 0]) % 3 == 2
    kept = np.sort(np.unique(2 * inverse + odd, return_index=True)[1])
    faces, place = faces[kept], inverse[kept]
    order = np.argsort(place, kind="stable")
    pair = np.flatnonzero(place[order[1:]] == place[order[:-1]])
    one, back = order[pair], order[pair + 1]
    side = _sides(WeldedSurface(points, faces, *_normals(points, faces)))
    touch = (side[one] == side[back]) & (side[one] != 0)
    gone = np.where((side[one] == 0) & (side[back] != 0), one, back)
    return np.delete(faces, np.concatenate([gone, one[touch], back[touch]]), axis=0)


def _sides(surface: WeldedSurface) -> Indices:
    """Return 1 for triangles of closed parts that look outwards, -1 inwards, 0 for sheets."""
    number = components(surface)
    volume = volumes_of(surface, number)
    volume[np.abs(volume) <= _NOTHING * surface.size**3] = 0.0
    sides = np.where(closed_parts(surface, number), np.sign(volume), 0.0)
    return sides.astype(np.intp)[number]


def _numbered(rows: Indices) -> NDArray[np.int64]:
    """Return the number of each row among the distinct ones, shape (n,)."""
    return np.unique(rows, axis=0, return_inverse=True)[1].ravel().astype(np.int64)


def _packed(rows: Indices) -> NDArray[np.int64]:
    """Return three numbers below 2^21 a row as one, shape (n,)."""
    return (rows[:, 0] << 2 * _BITS) + (rows[:, 1] << _BITS) + rows[:, 2]


def components(surface: WeldedSurface) -> Indices:
    """Return the index of the connected part of each face, shape (m,); parts share edges.

    They are numbered from 0 in the order of their first faces.
    """
    label = np.arange(len(surface.faces))
    twins = surface.twins.reshape(-1, 3)
    a, b, c = np.where(twins >= 0, twins // 3, label[:, None]).T.copy()
    while True:  # each face takes the least label around it, and that label's own label
        least = np.minimum(label, np.minimum(np.minimum(label[a], label[b]), label[c]))
        after = label.copy()
        np.minimum.at(after, label, least)
        after = after[np.minimum(after, least)]
        if np.array_equal(after, label):
            break
        label = after
    _, number = np.unique(label, return_inverse=True)
    return number.astype(np.intp)


def closed_parts(surface: WeldedSurface, number: Indices) -> Bools:
    """Return whether each connected part of a surface is closed, shape (parts,)."""
    open_faces = (surface.twins < 0).reshape(-1, 3).any(axis=1)
    return np.asarray(np.bincount(number, open_faces) == 0)


def volumes_of(surface: WeldedSurface, number: Indices) -> Floats:
    """Return the signed volume of each part [m³]; negative if faces look inwards."""
    corners = surface.vertices[surface.faces] - surface.vertices.mean(axis=0)
    each = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    return np.bincount(number, each).astype(np.float64)
