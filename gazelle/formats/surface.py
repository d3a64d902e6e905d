"""The surface of a mesh: cleaned triangles, what is connected, how thick the body behind is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_PAIRS = 4_000_000
"""Pairs of ray and triangle that are looked at in one go, for the sake of memory."""


@dataclass(frozen=True, slots=True)
class Surface:
    """Triangles whose equal corners are one vertex.

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

    @property
    def size(self) -> float:
        """Diagonal of the bounding box [m]."""
        return float(np.linalg.norm(np.ptp(self.vertices[self.faces].reshape(-1, 3), axis=0)))

    @property
    def volume(self) -> float:
        """Signed volume [m³], if it is closed; negative if its faces look inwards."""
        a, b, c = (self.vertices[self.faces[:, i]] - self.vertices[0] for i in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0

    def part(self, rows: Indices) -> Surface:
        """Some of the faces, with their vertices only."""
        used, inverse = np.unique(self.faces[rows], return_inverse=True)
        faces = inverse.reshape(-1, 3).astype(np.intp)
        return Surface(self.vertices[used], faces, self.normals[rows], self.areas[rows])

    def edges(self) -> Indices:
        """The edges of each face with their ends in order, shape (m, 3, 2)."""
        pairs = np.stack([self.faces, np.roll(self.faces, -1, axis=1)], axis=2)
        return np.sort(pairs, axis=2)

    def is_closed(self) -> bool:
        """Whether each edge belongs to two faces, which run along it in opposite ways."""
        tails, heads = self.faces, np.roll(self.faces, -1, axis=1)
        count = np.int64(len(self.vertices))
        forward = (tails * count + heads).ravel()
        backward = (heads * count + tails).ravel()
        forward.sort()
        backward.sort()
        return bool((np.diff(forward) > 0).all() and np.array_equal(forward, backward))


def clean(vertices: Floats, faces: NDArray[np.int32]) -> Surface:
    """Weld corners at the same place; leave out faces without area, and all but one of each.

    Of two faces that are each other's back, as in sheets drawn from both sides, the first
    is kept.
    """
    corners = vertices[faces].reshape(-1, 3)
    step = max(float(np.ptp(corners, axis=0).max()) * 1e-7, 1e-300)
    keys = np.round((corners - corners.min(axis=0)) / step).astype(np.int64)
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    points = corners[first]
    welded = inverse.reshape(-1, 3).astype(np.intp)
    _, kept = np.unique(np.sort(welded, axis=1), axis=0, return_index=True)
    welded = welded[np.sort(kept)]
    a, b, c = (points[welded[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    doubled = np.linalg.norm(normals, axis=1)
    real = doubled > step * step
    normals = normals[real] / doubled[real, None]
    return Surface(points, welded[real], normals, doubled[real] / 2.0)


def components(surface: Surface) -> list[Indices]:
    """The rows of the faces that hang together by their corners, largest area first."""
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
    of_face = label[corners[:, 0]]
    order = np.argsort(of_face, kind="stable")
    groups = np.split(order, np.flatnonzero(np.diff(of_face[order])) + 1)
    return sorted(groups, key=lambda rows: (-float(surface.areas[rows].sum()), int(rows[0])))


def first_hits(surface: Surface, origins: Floats, directions: Floats) -> Floats:
    """Distance [m] along each ray to the first triangle, shape (n,); infinite if none.

    Triangles are hit from both sides; those nearer than a millionth of the size are not.
    Moeller, Trumbore, "Fast, minimum storage ray/triangle intersection", Journal of
    Graphics Tools 2 (1997).
    """
    found = np.full(len(origins), np.inf)
    rows = max(1, _PAIRS // max(1, len(surface.faces)))
    a = surface.vertices[surface.faces[:, 0]]
    ab = surface.vertices[surface.faces[:, 1]] - a
    ac = surface.vertices[surface.faces[:, 2]] - a
    nearest = surface.size * 1e-6
    for start in range(0, len(origins), rows):
        part = slice(start, start + rows)
        found[part] = _hits(origins[part], directions[part], a, ab, ac, nearest)
    return found


def _hits(
    origins: Floats, directions: Floats, a: Floats, ab: Floats, ac: Floats, nearest: float
) -> Floats:
    turned = np.cross(directions[:, None], ac[None])
    scale = np.einsum("rfi,fi->rf", turned, ab)
    with np.errstate(divide="ignore", invalid="ignore"):
        back = 1.0 / scale
        from_a = origins[:, None] - a[None]
        u = np.einsum("rfi,rfi->rf", from_a, turned) * back
        across = np.cross(from_a, ab[None])
        v = np.einsum("ri,rfi->rf", directions, across) * back
        distance = np.einsum("fi,rfi->rf", ac, across) * back
        hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1.0 + 1e-9) & (distance > nearest)
    first: Floats = np.where(hit, distance, np.inf).min(axis=1)
    return first
