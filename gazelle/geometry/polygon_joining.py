# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="no-any-return"
"""Polygons on a surface joined in rounds, without Python's lock.

Of the edges left each polygon has a best, and one that is the best of both of its polygons is
tried. No two of a round touch the same polygon (Luby, "A simple parallel algorithm for the maximal
independent set problem", SIAM Journal on Computing 15, 1986).
"""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.geometry.polygon_rings import PolygonRings
from cython.cimports.libc.math import sqrt

from gazelle.array_types import Bools, Indices
from gazelle.geometry.surface import WeldedSurface

COSINE = 0.8
"""Of the angle that two polygons that are joined may make."""

_COSINE = cython.declare(cython.double, COSINE)
_SWEEPS = cython.declare(cython.int, 3)
"""Times that polygons without a partner look for one in a round."""
_STRAIGHT = cython.declare(cython.double, 1e-9)
"""Depth over length of a notch that is rounding."""
_NEVER = cython.declare(cython.double, 1e300)
_LEAST = cython.declare(cython.double, 1e-300)


@cython.final
@cython.cclass
class PolygonJoiner:
    """The state of polygons that are joined, at first triangles.

    Half-edge 3 f + i of triangle f runs from its corner i to the next. A polygon goes by the
    triangle whose plane it has.

    Args:
        surface: Surface of the triangles.
        rings: The rims of the polygons.
        label: The polygon of each triangle, shape (n,), which is written.
        notched: Whether each polygon has notches, shape (n,), which is written.
    """

    def __init__(
        self, surface: WeldedSurface, rings: PolygonRings, label: Indices, notched: Bools
    ) -> None:
        count = len(surface.faces)
        self.rings = rings
        self.points = np.ascontiguousarray(surface.vertices, np.float64)
        self.normals = np.ascontiguousarray(surface.normals, np.float64)
        self.tail = np.ascontiguousarray(surface.faces.ravel(), np.intp)
        self.twin = np.ascontiguousarray(surface.twins, np.intp)
        self.label, self.notched = label, notched.view(np.uint8)
        self.area = surface.areas.copy()
        self.low, self.high = np.zeros((2, count))
        self.sibling = np.arange(count)
        self.gone, self.seen = np.zeros((2, 3 * count), np.uint8)
        self.changed, self.taken = np.zeros((2, count), np.uint8)
        self.best = np.full(count, -1)
        self.lowest = self.highest = 0.0
        # Where all are alike, as in a grid, few would be the best of both of their polygons.
        self.noise = np.random.default_rng(0).uniform(0.99, 1.01, 3 * count // 2 + 1)

    def join(self, edges: Indices, cells: Indices, tolerance: float, depth: float) -> int:
        """Remove edges between polygons of the same cell, in rounds; returns how many it removed.

        What may not be taken out waits until one of its polygons has grown.

        Args:
            edges: Half-edges, one of each pair that may be removed.
            cells: The cell of each polygon.
            tolerance: Largest distance of a polygon's vertices across its plane [m].
            depth: Depth of notches that are filled [m].
        """
        count = cython.declare(cython.Py_ssize_t, len(edges))
        self.edges = np.array(edges, np.intp)
        self.cells = np.ascontiguousarray(cells, np.intp)
        self.waiting, self.first, self.last = np.empty((3, count), np.intp)
        self.small, self.large, self.rows = np.empty((3, count), np.intp)
        self.rank, self.notch = np.empty((2, count))
        self.chosen = np.empty(count, np.uint8)
        slab = cython.declare(cython.double, tolerance)
        deepest = cython.declare(cython.double, depth)
        with cython.nogil:
            joined = self.join_all(count, slab, deepest)
        return int(joined)

    def remaining(self, edges: Indices) -> Bools:
        """Return a mask of the half-edges that are not removed."""
        return np.asarray(self.gone)[edges] == 0

    def join_all(self, count: int, tolerance: float, depth: float) -> int:
        """Remove some of the edges; returns how many polygons there are less."""
        joined, waiting = 0, 0
        while True:
            pairs = self.find_pairs(self.find_seams(count))
            count = self.keep_fitting(pairs, waiting, depth)
            if count == 0:
                return joined
            waiting += pairs - count
            self.choose(count)
            kept = 0
            for row in range(count):
                if self.chosen[row]:
                    joined += self.take_out(row, tolerance, depth)
                else:
                    self.edges[kept] = self.first[row]
                    kept += 1
            left = 0
            for row in range(waiting):
                edge = self.waiting[row]
                one, two = self.label[edge // 3], self.label[self.twin[edge] // 3]
                if self.changed[one] or self.changed[two]:
                    self.edges[kept] = edge
                    kept += 1
                else:
                    self.waiting[left] = edge
                    left += 1
            for row in range(count):
                self.changed[self.large[row]] = 0
            count, waiting = kept, left

    def find_seams(self, count: int) -> int:
        """Write the first half-edge of each row of edges between two polygons; returns how many.

        That of the polygon with the lesser number.
        """
        after, before = self.rings.after, self.rings.before
        for row in range(count):
            edge = self.edges[row]
            one, two = self.label[edge // 3], self.label[self.twin[edge] // 3]
            if one == two or self.gone[edge] or self.cells[one] != self.cells[two]:
                continue
            edge = edge if one < two else self.twin[edge]
            first, back = edge, before[edge]
            while self.twin[back] == after[self.twin[first]] and back != edge:
                first, back = back, before[back]
            self.seen[first] = 1
        found = 0
        for edge in range(self.seen.shape[0]):
            if self.seen[edge]:
                self.seen[edge] = 0
                self.first[found] = edge
                found += 1
        return found

    def find_pairs(self, count: int) -> int:
        """Write the polygons on both sides of each seam, and its last half-edge."""
        after, before = self.rings.after, self.rings.before
        for row in range(count):
            first = self.first[row]
            last, ahead = first, after[first]
            while self.twin[ahead] == before[self.twin[last]] and ahead != first:
                last, ahead = ahead, after[ahead]
            one, two = self.label[first // 3], self.label[self.twin[first] // 3]
            swapped = self.area[one] < self.area[two]
            self.last[row] = last
            self.small[row], self.large[row] = (one, two) if swapped else (two, one)
        return count

    def keep_fitting(self, count: int, waiting: int, depth: float) -> int:
        """Move what may not be joined to what waits; returns how many pairs are left."""
        kept = 0
        for row in range(count):
            notch = self.deeper_notch(row)
            if not (notch <= depth and self.are_alike(row)):
                self.waiting[waiting] = self.first[row]
                waiting += 1
                continue
            self.first[kept], self.last[kept] = self.first[row], self.last[row]
            self.small[kept], self.large[kept] = self.small[row], self.large[row]
            self.notch[kept] = notch
            self.rank[kept] = self.rank_of(kept)
            kept += 1
        return kept

    def are_alike(self, row: int) -> bool:
        """Return whether a pair of polygons face the same way, and neither surrounds the other."""
        one, two = self.small[row], self.large[row]
        along: cython.double = 0.0
        for axis in range(3):
            along += self.normals[one, axis] * self.normals[two, axis]
        first, last = self.first[row], self.last[row]
        if along < _COSINE or self.rings.before[first] == last:
            return False
        return self.rings.after[self.twin[first]] != self.twin[last]

    def deeper_notch(self, row: int) -> float:
        """Return the depth of the corners at the ends of a seam below straight lines past them [m]."""
        first, last, large = self.first[row], self.last[row], self.large[row]
        after, before = self.rings.after, self.rings.before
        one = self.notch_between(before[first], after[self.twin[first]], large)
        other = self.notch_between(before[self.twin[last]], after[last], large)
        return max(other, one)

    def notch_between(self, enter: int, leave: int, face: int) -> float:
        """Return the depth of a corner below the straight line past it [m]; 0 if it stands out."""
        a, b = self.tail[enter], self.tail[leave]
        c = self.tail[self.rings.after[leave]]
        ux, uy, uz = (
            self.points[b, 0] - self.points[a, 0],
            self.points[b, 1] - self.points[a, 1],
            self.points[b, 2] - self.points[a, 2],
        )
        vx, vy, vz = (
            self.points[c, 0] - self.points[b, 0],
            self.points[c, 1] - self.points[b, 1],
            self.points[c, 2] - self.points[b, 2],
        )
        turn = self.normals[face, 0] * (uy * vz - uz * vy)
        turn = turn + self.normals[face, 1] * (uz * vx - ux * vz)
        turn = turn + self.normals[face, 2] * (ux * vy - uy * vx)
        if turn >= 0.0:
            return 0.0
        x, y, z = ux + vx, uy + vy, uz + vz
        across = sqrt(x * x + y * y + z * z)
        if across <= 0.0:
            return _NEVER
        depth = -turn / across
        ahead = ux * vx + uy * vy + uz * vz
        return 0.0 if ahead > 0.0 and depth < _STRAIGHT * across else depth

    def rank_of(self, row: int) -> float:
        """Return the rank of a pair, small where it is small and shares much of its rims."""
        start = self.tail[self.first[row]]
        end = self.tail[self.rings.after[self.last[row]]]
        seam: cython.double = 0.0
        for axis in range(3):
            way = self.points[end, axis] - self.points[start, axis]
            seam += way * way
        area = self.area[self.small[row]] + self.area[self.large[row]]
        return self.noise[row] * area / (max(_LEAST, seam))

    def choose(self, count: int) -> None:
        """Mark pairs without common polygons, the best of each polygon."""
        left = 0
        for row in range(count):
            self.chosen[row] = 0
            self.rows[row] = row
        left = count
        for _ in range(_SWEEPS):
            for k in range(left):
                self.best[self.small[self.rows[k]]] = -1
                self.best[self.large[self.rows[k]]] = -1
            for k in range(left):
                self.offer(self.small[self.rows[k]], self.rows[k])
                self.offer(self.large[self.rows[k]], self.rows[k])
            for k in range(left):
                row = self.rows[k]
                one, two = self.small[row], self.large[row]
                if self.best[one] == row and self.best[two] == row:
                    self.chosen[row] = self.taken[one] = self.taken[two] = 1
            kept = 0
            for k in range(left):
                row = self.rows[k]
                if not self.taken[self.small[row]] and not self.taken[self.large[row]]:
                    self.rows[kept] = row
                    kept += 1
            left = kept
        for row in range(count):
            self.taken[self.small[row]] = self.taken[self.large[row]] = 0

    def offer(self, polygon: int, row: int) -> None:
        """Store a pair as the best of a polygon, unless one before is at least as good."""
        best = self.best[polygon]
        if best < 0 or self.rank[row] < self.rank[best]:
            self.best[polygon] = row

    def take_out(self, row: int, tolerance: float, depth: float) -> bool:
        """Join a pair of polygons if it is flat and convex enough; returns whether it was."""
        small, large = self.small[row], self.large[row]
        self.measure(small, large)
        if self.highest - self.lowest > tolerance:
            return False
        first, last = self.first[row], self.last[row]
        uneven = self.notch[row] > 0.0 or self.notched[small] or self.notched[large]
        if uneven and not self.fills(first, last, large, depth):
            return False
        self.low[large], self.high[large] = self.lowest, self.highest
        after, before = self.rings.after, self.rings.before
        end, edge = after[last], first
        enter, leave = before[first], after[self.twin[first]]
        enter_back = before[self.twin[last]]
        while edge != end:
            self.gone[edge] = self.gone[self.twin[edge]] = 1
            edge = after[edge]
        after[enter], before[leave] = leave, enter
        after[enter_back], before[end] = end, enter_back
        face = small
        while True:
            self.label[face] = large
            face = self.sibling[face]
            if face == small:
                break
        self.sibling[small], self.sibling[large] = self.sibling[large], self.sibling[small]
        self.area[large] += self.area[small]
        self.rings.start[large] = leave
        self.notched[large] = uneven
        self.changed[large] = 1
        return True

    def measure(self, small: int, large: int) -> None:
        """Write the range of both polygons' vertices over the larger one's plane [m]."""
        base = self.tail[3 * large]
        low, high, face = self.low[large], self.high[large], small
        while True:
            for edge in range(3 * face, 3 * face + 3):
                height: cython.double = 0.0
                for axis in range(3):
                    way = self.points[self.tail[edge], axis] - self.points[base, axis]
                    height += way * self.normals[large, axis]
                low = min(low, height)
                high = max(high, height)
            face = self.sibling[face]
            if face == small:
                break
        self.lowest, self.highest = low, high

    def fills(self, first: int, last: int, large: int, depth: float) -> bool:
        """Return whether no corner of two joined polygons lies deeper in its hull than this."""
        self.rings.begin(large)
        self.rings.add(self.rings.after[last], first)
        self.rings.add(self.rings.after[self.twin[first]], self.twin[last])
        self.rings.find_hull()
        return self.rings.turns_once() and self.rings.deepest() <= depth
