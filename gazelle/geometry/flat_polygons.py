"""The triangles of a surface joined to nearly flat, nearly convex polygons.

Edges between triangles are taken out as long as what is left around them stays convex: Hertel,
Mehlhorn, "Fast triangulation of simple polygons", Fundamentals of Computation Theory (1983). Here
the polygons lie in space. Each has the plane of one of its triangles. Across it all vertices of
all of its triangles lie within a tolerance, and notches of that depth are filled.

Edges are taken out in rounds: of those left each polygon has a best, and one that is the best
of both of its polygons is tried. No two of a round touch the same polygon, so that a round is a
few operations on arrays (Luby, "A simple parallel algorithm for the maximal independent set
problem", SIAM Journal on Computing 15, 1986).
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.outlines import Planar, filled, hull_rows
from gazelle.geometry.surface import WeldedSurface

_CELL = 8.0
"""Of the cells of which polygons are parts at first, in tolerances."""
_COSINE = 0.8
"""Of the angle that two polygons that are joined may make."""
_SWEEPS = 3
"""Times that polygons without a partner look for one in a round."""
_STRAIGHT = 1e-9
"""Depth over length of a notch that is rounding."""


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
        rows = np.arange(3 * self.count).reshape(-1, 3)
        self._tail = surface.faces.ravel()
        self._next = np.roll(rows, -1, axis=1).ravel()
        self._before = np.roll(rows, 1, axis=1).ravel()
        self._twin = surface.twins
        self._gone = np.zeros(3 * self.count, bool)
        self._label = np.arange(self.count)
        self._start = 3 * np.arange(self.count)
        self._area = surface.areas.copy()
        self._notched = np.zeros(self.count, bool)
        self._low = np.zeros(self.count)
        self._high = np.zeros(self.count)
        self._edges, self._flat = _candidates(surface, self._twin)

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
            places = self.surface.vertices[self.surface.faces[:, 0]] / (_CELL * tolerance)
            cells = np.unique(np.floor(places), axis=0, return_inverse=True)[1].ravel()
        longest, level = self._kinds(edges)  # so do halves of quadrangles, and strips of those
        self._join_within(edges[longest], everywhere, tolerance, depth)
        self._join_within(edges[level], cells, tolerance, depth)
        self._join_within(edges, cells, tolerance, depth)
        if notches:
            self._join_within(edges, everywhere, tolerance, depth)
        kept = ~self._gone[self._edges]
        self._edges, self._flat = self._edges[kept], self._flat[kept]

    def _join_within(self, edges: Indices, cells: Indices, tolerance: float, depth: float) -> None:
        """Remove edges between polygons of the same cell, in rounds.

        What may not be taken out waits until one of its polygons has grown.
        """
        waiting = edges[:0]
        while True:
            pairs = self._pairs(edges, cells)
            notch = self._notches(pairs)
            may = (notch <= depth) & self._alike(pairs)
            if not may.any():
                break
            waiting = np.concatenate([waiting, pairs.first[~may]])
            pairs, notch = pairs.only(may), notch[may]
            rows = self._ranked(pairs)
            rows = rows[_apart(pairs.small[rows], pairs.large[rows], len(self._label))]
            grown = self._take_out(pairs.only(rows), notch[rows] > 0.0, tolerance, depth)
            changed = np.zeros(len(self._label), bool)
            changed[grown] = True
            one, two = self._label[waiting // 3], self._label[self._twin[waiting] // 3]
            woken = changed[one] | changed[two]
            edges = np.concatenate([np.delete(pairs.first, rows), waiting[woken]])
            waiting = waiting[~woken]

    def rims(self) -> Rims:
        """Return the current polygons; one may have no more than two corners left."""
        faces = np.flatnonzero(self._label == np.arange(len(self._label)))
        number = np.empty(len(self._label), np.intp)
        number[faces] = np.arange(len(faces))
        edges, rows = self._rings(faces)
        vertices = self._tail[edges]
        uneven = self._notched[faces][rows]
        kept = np.ones(len(vertices), bool)
        if uneven.any():
            kept[uneven] = hull_rows(self._planar(vertices[uneven], rows[uneven], faces))
        sizes = np.bincount(rows[kept], minlength=len(faces))
        normals = self.surface.normals[faces]
        return Rims(vertices[kept], sizes, normals, faces, number[self._label])

    def _pairs(self, edges: Indices, cells: Indices) -> _Pairs:
        """Return the pairs of polygons on both sides of edges.

        One for each row of edges between them.
        """
        nxt, before, twin, label = self._next, self._before, self._twin, self._label
        one, two = label[edges // 3], label[twin[edges] // 3]
        apart = (one != two) & ~self._gone[edges] & (cells[one] == cells[two])
        edges, one, two = edges[apart], one[apart], two[apart]
        edges = np.where(one < two, edges, twin[edges])
        first = edges.copy()
        rows = np.arange(len(edges))
        while len(rows):
            back = before[first[rows]]
            on = (twin[back] == nxt[twin[first[rows]]]) & (back != edges[rows])
            rows, back = rows[on], back[on]
            first[rows] = back
        seen = np.zeros(len(nxt), bool)
        seen[first] = True
        first = np.flatnonzero(seen)
        last = first.copy()
        rows = np.arange(len(first))
        while len(rows):
            after = nxt[last[rows]]
            on = (twin[after] == before[twin[last[rows]]]) & (after != first[rows])
            rows, after = rows[on], after[on]
            last[rows] = after
        one, two = label[first // 3], label[twin[first] // 3]
        swapped = self._area[one] < self._area[two]
        small, large = np.where(swapped, one, two), np.where(swapped, two, one)
        leave, enter_back = nxt[twin[first]], before[twin[last]]
        return _Pairs(small, large, first, last, before[first], leave, enter_back, nxt[last])

    def _alike(self, pairs: _Pairs) -> Bools:
        """Return whether pairs of polygons face the same way, and neither surrounds the other."""
        normals = self.surface.normals
        along = np.einsum("ij,ij->i", normals[pairs.small], normals[pairs.large])
        around = (pairs.enter == pairs.last) | (pairs.leave == self._twin[pairs.last])
        return np.asarray((along >= _COSINE) & ~around)

    def _kinds(self, edges: Indices) -> tuple[Bools, Bools]:
        """Return masks of edges: longest of both triangles, and running one way in their planes."""
        along = self.surface.vertices[self.surface.faces]
        along = np.roll(along, -1, axis=1) - along
        lengths = np.einsum("ijk,ijk->ij", along, along)
        longest = lengths.ravel() >= (1.0 - _STRAIGHT) * np.repeat(lengths.max(axis=1), 3)
        u, v = across(self.surface.normals[edges // 3])
        ways = along.reshape(-1, 3)[edges]
        level = np.abs(np.einsum("ij,ij->i", ways, u)) < np.abs(np.einsum("ij,ij->i", ways, v))
        return longest[edges] & longest[self._twin[edges]], level

    def _ranked(self, pairs: _Pairs) -> Indices:
        """Return rows of pairs, first those that are small and share much of their rims."""
        ends = self.surface.vertices[self._tail[np.stack([pairs.first, pairs.leave_back])]]
        seam = np.einsum("ij,ij->i", ends[1] - ends[0], ends[1] - ends[0])
        area = self._area[pairs.small] + self._area[pairs.large]
        # Where all are alike, as in a grid, few would be the best of both of their polygons.
        noise = np.random.default_rng(0).uniform(0.99, 1.01, len(seam))
        return np.argsort(noise * area / np.maximum(seam, 1e-300), kind="stable")

    def _take_out(self, pairs: _Pairs, uneven: Bools, tolerance: float, depth: float) -> Indices:
        """Join pairs of polygons that may be joined, each at most once; returns those that grew.

        Those that grew.
        """
        low, high = self._heights(pairs)
        near = high - low <= tolerance
        pairs, uneven, low, high = pairs.only(near), uneven[near], low[near], high[near]
        uneven |= self._notched[pairs.small] | self._notched[pairs.large]
        if uneven.any():
            fits = ~uneven
            fits[uneven] = self._fills(pairs.only(uneven), depth)
            pairs, uneven, low, high = pairs.only(fits), uneven[fits], low[fits], high[fits]
        self._low[pairs.large], self._high[pairs.large] = low, high
        removed, _ = self._walk(pairs.first, self._next[pairs.last])
        self._gone[removed] = self._gone[self._twin[removed]] = True
        self._next[pairs.enter], self._before[pairs.leave] = pairs.leave, pairs.enter
        self._next[pairs.enter_back] = pairs.leave_back
        self._before[pairs.leave_back] = pairs.enter_back
        parent = np.arange(len(self._label))
        parent[pairs.small] = pairs.large
        self._label = parent[self._label]
        self._area[pairs.large] += self._area[pairs.small]
        self._start[pairs.large] = pairs.leave
        self._notched[pairs.large] = uneven
        self.count -= len(pairs.small)
        return pairs.large

    def _heights(self, pairs: _Pairs) -> tuple[Floats, Floats]:
        """Return the range of both polygons' vertices over the larger ones' planes [m]."""
        partner = np.full(len(self._label), -1)
        partner[pairs.small] = pairs.large
        other = partner[self._label]
        rows = np.flatnonzero(other >= 0)
        other = other[rows]
        corners = self.surface.vertices[self.surface.faces[rows]]
        base = self.surface.vertices[self.surface.faces[other, 0]]
        heights = np.einsum("ijk,ik->ij", corners - base[:, None], self.surface.normals[other])
        low, high = self._low.copy(), self._high.copy()
        np.minimum.at(low, other, heights.min(axis=1))
        np.maximum.at(high, other, heights.max(axis=1))
        return low[pairs.large], high[pairs.large]

    def _notches(self, pairs: _Pairs) -> Floats:
        """Return the depth of the corners at the ends of seams below straight lines past them [m]."""
        normals = self.surface.normals[pairs.large]
        return np.maximum(
            self._notch(pairs.enter, pairs.leave, normals),
            self._notch(pairs.enter_back, pairs.leave_back, normals),
        )

    def _notch(self, enter: Indices, leave: Indices, normals: Floats) -> Floats:
        """Return the depth of each corner below the straight line past it [m]; 0 if it stands out."""
        points, tail = self.surface.vertices, self._tail
        u = points[tail[leave]] - points[tail[enter]]
        v = points[tail[self._next[leave]]] - points[tail[leave]]
        (x, y, z), (a, b, c), (d, e, f) = normals.T, u.T, v.T
        turn = x * (b * f - c * e) + y * (c * d - a * f) + z * (a * e - b * d)
        across = np.sqrt((a + d) ** 2 + (b + e) ** 2 + (c + f) ** 2)
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = np.where(across > 0.0, -turn / across, np.inf)
        straight = (np.einsum("ij,ij->i", u, v) > 0.0) & (depth < _STRAIGHT * across)
        return np.where((turn >= 0.0) | straight, 0.0, depth)

    def _fills(self, pairs: _Pairs, depth: float) -> Bools:
        """Return whether no corner of joined polygons lies deeper in its hull than this."""
        there, there_rows = self._walk(pairs.leave_back, pairs.first)
        back, back_rows = self._walk(pairs.leave, self._twin[pairs.last])
        edges, rows = np.concatenate([there, back]), np.concatenate([there_rows, back_rows])
        order = np.argsort(rows, kind="stable")
        edges, rows = edges[order], rows[order]
        return filled(self._planar(self._tail[edges], rows, pairs.large), depth)

    def _planar(self, vertices: Indices, rows: Indices, faces: Indices) -> Planar:
        """Return corners in the planes of their polygons, defined by these faces."""
        points = self.surface.vertices[vertices]
        flat = [np.einsum("ij,ij->i", points, u[rows]) for u in across(self.surface.normals[faces])]
        return Planar(np.stack(flat, axis=1), rows, len(faces))

    def _rings(self, faces: Indices) -> tuple[Indices, Indices]:
        """Return the half-edges around polygons, polygon by polygon, and their polygons."""
        start = self._start[faces]
        edges, rows = self._walk(self._next[start], start)
        edges, rows = np.concatenate([start, edges]), np.concatenate([np.arange(len(faces)), rows])
        order = np.argsort(rows, kind="stable")
        return edges[order], rows[order]

    def _walk(self, edges: Indices, ends: Indices) -> tuple[Indices, Indices]:
        """Return half-edges from some on, without the last, and the walk that found each."""
        found, walks = [edges[:0]], [edges[:0]]
        rows = np.flatnonzero(edges != ends)
        here = edges[rows]
        while len(rows):
            found.append(here)
            walks.append(rows)
            here = self._next[here]
            on = here != ends[rows]
            rows, here = rows[on], here[on]
        return np.concatenate(found), np.concatenate(walks)


@dataclass(frozen=True, slots=True)
class _Pairs:
    """Two polygons each that may be joined, and the half-edges of one around the seam.

    Attributes:
        small: The polygon of less area, shape (n,).
        large: The other, whose plane they keep.
        first: Half-edge of the seam.
        last: Half-edge of the seam.
        enter: Before the first.
        leave: After the twin of the first.
        enter_back: Before the twin of the last.
        leave_back: After the last.
    """

    small: Indices
    large: Indices
    first: Indices
    last: Indices
    enter: Indices
    leave: Indices
    enter_back: Indices
    leave_back: Indices

    def only(self, rows: NDArray[Any]) -> _Pairs:
        """Return some of them."""
        return _Pairs(*(getattr(self, each.name)[rows] for each in fields(self)))


def _apart(one: Indices, two: Indices, count: int) -> Indices:
    """Return rows of ranked pairs without common polygons, the first of each polygon first."""
    found = []
    rows = np.arange(len(one))
    best = np.empty(count, np.intp)
    taken = np.zeros(count, bool)
    for _ in range(_SWEEPS):
        ends = np.stack([two[rows], one[rows]], axis=1).ravel()
        best[ends[::-1]] = np.repeat(rows, 2)[::-1]  # the first of each is written last
        chosen = rows[(best[one[rows]] == rows) & (best[two[rows]] == rows)]
        found.append(chosen)
        taken[one[chosen]] = taken[two[chosen]] = True
        rows = rows[~(taken[one[rows]] | taken[two[rows]])]
        if not len(rows):
            break
    return np.concatenate(found)


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
    flat[np.einsum("ij,ij->i", surface.normals[one], surface.normals[two]) < _COSINE] = np.inf
    rounding = 1e-6 * surface.size
    flat[flat <= rounding] = 0.0
    return edges, flat
