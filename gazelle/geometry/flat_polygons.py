"""The triangles of a surface joined to nearly flat, nearly convex polygons.

Edges between triangles are taken out as long as what is left around them stays convex: Hertel,
Mehlhorn, "Fast triangulation of simple polygons", Fundamentals of Computation Theory (1983). Here
the polygons lie in space. Each has the plane of one of its triangles. Across it all vertices of
all of its triangles lie within a tolerance, and notches of that depth are filled.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.polygon_joining import COSINE, PolygonJoiner
from gazelle.geometry.polygon_rings import PolygonRings
from gazelle.geometry.surface import WeldedSurface

_CELL = 8.0
"""Of the cells of which polygons are parts at first, in tolerances."""
_STRAIGHT = 1e-9
"""Share of the longest side's squared length that is rounding."""


@dataclass(frozen=True, slots=True)
class Rims:
    """The polygons on a surface.

    Attributes:
        vertices: The corners of one after the other as vertices of the surface, counter-clockwise
            from outside; those in notches that are filled are left out, shape (n,).
        sizes: Corners of each, shape (k,).
        normals: Of their planes, shape (k, 3).
        faces: One triangle of each, shape (k,).
        owners: The polygon of each triangle of the surface, shape (m,).
    """

    vertices: Indices
    sizes: Indices
    normals: Floats
    faces: Indices
    owners: Indices

    @property
    def rows(self) -> Indices:
        """Index of the polygon that each corner belongs to, shape (n,)."""
        return np.repeat(np.arange(len(self.sizes)), self.sizes)


class Polygons:
    """The polygons of a surface, at first its triangles.

    Half-edge 3 f + i of triangle f runs from its corner i to the next. A polygon goes by the
    triangle whose plane it has.

    Attributes:
        surface: Surface of the triangles.
        count: Number of polygons.
    """

    def __init__(self, surface: WeldedSurface) -> None:
        self.surface = surface
        self.count = len(surface.faces)
        self._label = np.arange(self.count)
        self._notched = np.zeros(self.count, bool)
        self._rings = PolygonRings(surface)
        self._joiner = PolygonJoiner(surface, self._rings, self._label, self._notched)
        self._edges, self._flat = _candidates(surface, surface.twins)

    def join(self, tolerance: float, *, notches: bool) -> None:
        """Remove edges until none is left that may be removed.

        Args:
            tolerance: Largest distance of a polygon's vertices across its plane [m].
            notches: Whether notches of that depth are filled.
        """
        depth = tolerance if notches else 0.0
        edges = self._edges[self._flat <= tolerance]
        everywhere = cells = np.zeros(len(self._label), np.intp)
        if notches:  # polygons that end where others do fit together without notches
            cells = self._cells(_CELL * tolerance)
        longest, level = self._kinds(edges)  # so do halves of quadrangles, and strips of those
        rounds = [(edges[longest], everywhere), (edges[level], cells), (edges, cells)]
        for some, within in [*rounds, (edges, everywhere)] if notches else rounds:
            self.count -= self._joiner.join(some, within, tolerance, depth)
        kept = self._joiner.remaining(self._edges)
        self._edges, self._flat = self._edges[kept], self._flat[kept]

    def rims(self) -> Rims:
        """Return the current polygons; one may have no more than two corners left."""
        faces = np.flatnonzero(self._label == np.arange(len(self._label)))
        number = np.empty(len(self._label), np.intp)
        number[faces] = np.arange(len(faces))
        vertices, sizes = self._rings.around(faces, self._notched[faces])
        normals = self.surface.normals[faces]
        return Rims(vertices, sizes, normals, faces, number[self._label])

    def _cells(self, side: float) -> Indices:
        """Return the number of the cell of a grid that each triangle begins in."""
        places = self.surface.vertices[self.surface.faces[:, 0]] / side
        rows = np.floor(places).astype(np.intp)
        rows -= rows.min(axis=0)
        counts = rows.max(axis=0) + 1
        cells: Indices = (rows[:, 0] * counts[1] + rows[:, 1]) * counts[2] + rows[:, 2]
        return cells

    def _kinds(self, edges: Indices) -> tuple[Bools, Bools]:
        """Return masks of edges: longest of both triangles, and running one way in their planes."""
        along = self.surface.vertices[self.surface.faces]
        along = np.roll(along, -1, axis=1) - along
        lengths = np.einsum("ijk,ijk->ij", along, along)
        longest = lengths.ravel() >= (1.0 - _STRAIGHT) * np.repeat(lengths.max(axis=1), 3)
        u, v = across(self.surface.normals[edges // 3])
        ways = along.reshape(-1, 3)[edges]
        level = np.abs(np.einsum("ij,ij->i", ways, u)) < np.abs(np.einsum("ij,ij->i", ways, v))
        return longest[edges] & longest[self.surface.twins[edges]], level


def across(normals: Floats) -> tuple[Floats, Floats]:
    """Return two unit vectors across each normal, shapes (n, 3), right-handed with it."""
    least = np.abs(normals).argmin(axis=1)
    axes = np.eye(3)[least]
    first = np.cross(axes, normals)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second: Floats = np.cross(normals, first)
    return first, second


def _candidates(surface: WeldedSurface, twins: Indices) -> tuple[Indices, Floats]:
    """Return half-edges between two triangles, one of each pair, and their deviations [m].

    What is flat but for rounding counts as flat.
    """
    edges = np.flatnonzero(twins > np.arange(len(twins)))
    one, two = edges // 3, twins[edges] // 3
    corners = surface.faces.ravel()
    ends = surface.vertices[corners]
    opposite = (
        ends[3 * one + (edges + 2) % 3],
        ends[3 * two + (twins[edges] + 2) % 3],
    )
    base = ends[edges]
    heights = (
        np.abs(np.einsum("ij,ij->i", opposite[1] - base, surface.normals[one])),
        np.abs(np.einsum("ij,ij->i", opposite[0] - base, surface.normals[two])),
    )
    larger = surface.areas[one] >= surface.areas[two]
    flat = np.where(larger, *heights)
    flat[np.einsum("ij,ij->i", surface.normals[one], surface.normals[two]) < COSINE] = np.inf
    rounding = 1e-6 * surface.size
    flat[flat <= rounding] = 0.0
    return edges, flat
