"""The triangles of a surface joined to nearly flat, nearly convex polygons.

Edges between triangles are taken out one after another, as long as what is left around them
stays convex: Hertel, Mehlhorn, "Fast triangulation of simple polygons", Fundamentals of
Computation Theory (1983). Here the polygons lie in space. Each has the plane of its largest
triangle, from which its corners may be off by a tolerance, and notches of that depth are filled.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.formats.hull import planar_hull
from gazelle.formats.surface import Surface, twins_of

_COSINE = 0.8
"""Of the angle that two polygons that are joined may make."""

Point = tuple[float, float, float]
Flat = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Polygon:
    """A polygon on a surface.

    Attributes:
        rim: Its corners as vertices of the surface, counter-clockwise from outside; those in
            notches that are filled are left out.
        normal: Of its plane.
        face: One of its triangles.
    """

    rim: list[int]
    normal: Point
    face: int


class Polygons:
    """The polygons of a surface, at first its triangles.

    Half-edge 3 f + i of triangle f runs from its corner i to the next. The lists are by
    half-edge or by triangle; a polygon goes by one of its triangles.
    """

    def __init__(self, surface: Surface) -> None:
        self.surface = surface
        count = len(surface.faces)
        self._points: list[Point] = list(map(tuple, surface.vertices.tolist()))
        self._tail: list[int] = surface.faces.ravel().tolist()
        rows = np.arange(3 * count).reshape(-1, 3)
        self._next: list[int] = np.roll(rows, -1, axis=1).ravel().tolist()
        self._before: list[int] = np.roll(rows, 1, axis=1).ravel().tolist()
        twins = twins_of(surface)
        self._twin: list[int] = twins.tolist()
        self._gone = bytearray(3 * count)
        self._owner = list(range(count))
        self._normal: list[Point] = list(map(tuple, surface.normals.tolist()))
        self._area: list[float] = surface.areas.tolist()
        self._start = list(range(0, 3 * count, 3))
        self._sides = [3] * count
        self._notched = bytearray(count)
        self.count = count
        self._edges, self._flat = _candidates(surface, twins)

    def join(self, tolerance: float, *, notches: bool) -> None:
        """Take out edges, the flattest and longest first.

        Args:
            tolerance: How far corners may be off their polygon's plane [m].
            notches: Whether notches of that depth are filled.
        """
        near = self._flat <= tolerance
        for edge in self._edges[near].tolist():
            if not self._gone[edge]:
                self._take_out(edge, tolerance, tolerance if notches else 0.0)
        kept = np.frombuffer(self._gone, np.uint8)[self._edges] == 0
        self._edges, self._flat = self._edges[kept], self._flat[kept]

    def polygons(self) -> list[Polygon]:
        """What there is now."""
        found = []
        for face in range(len(self._owner)):
            if self._owner[face] != face:
                continue
            rim = [self._tail[edge] for edge in self._ring(face)]
            if self._notched[face]:
                rim = [rim[i] for i in planar_hull(self._level(rim, self._normal[face]))]
            found.append(Polygon(rim, self._normal[face], face))
        return found

    def owner(self, face: int) -> int:
        """The triangle that stands for the polygon that a triangle is part of."""
        owner = self._owner
        while owner[face] != face:
            owner[face] = owner[owner[face]]
            face = owner[face]
        return face

    def _take_out(self, edge: int, tolerance: float, depth: float) -> None:
        """Join the polygons on both sides of an edge, if they may be."""
        nxt, before, twin = self._next, self._before, self._twin
        one, two = self.owner(edge // 3), self.owner(twin[edge] // 3)
        if one == two:
            return
        first = last = edge  # of all edges in a row between the two
        while twin[before[first]] == nxt[twin[first]] and before[first] != edge:
            first = before[first]
        while twin[nxt[last]] == before[twin[last]] and nxt[last] != first:
            last = nxt[last]
        enter, leave = before[first], nxt[twin[first]]
        enter_back, leave_back = before[twin[last]], nxt[last]
        if enter == last or leave == twin[last]:
            return  # one goes all around the other
        small, large = (one, two) if self._area[one] < self._area[two] else (two, one)
        normal = self._normal[large]
        if not self._is_near(small, large, tolerance):
            return
        notch = max(self._notch(enter, leave, normal), self._notch(enter_back, leave_back, normal))
        if notch > depth:
            return
        uneven = notch > 0.0 or self._notched[one] or self._notched[two]
        if uneven and not self._fills(
            [*self._path(leave_back, first), *self._path(leave, twin[last])], normal, depth
        ):
            return
        self._remove(first, last)
        nxt[enter], before[leave] = leave, enter
        nxt[enter_back], before[leave_back] = leave_back, enter_back
        self._owner[small] = large
        self._area[large] += self._area[small]
        self._start[large] = leave
        self._notched[large] = bool(uneven)
        self.count -= 1

    def _remove(self, first: int, last: int) -> None:
        edge = first
        while True:
            self._gone[edge] = self._gone[self._twin[edge]] = 1
            if edge == last:
                return
            edge = self._next[edge]

    def _ring(self, face: int) -> list[int]:
        start = self._start[face]
        return [start, *self._path(self._next[start], start)]

    def _path(self, edge: int, end: int) -> list[int]:
        """Half-edges from one on, without the last."""
        found = []
        while edge != end:
            found.append(edge)
            edge = self._next[edge]
        return found

    def _is_near(self, small: int, large: int, tolerance: float) -> bool:
        """Whether a polygon's corners are near to the plane of another, that looks the same way."""
        points, tail, nxt = self._points, self._tail, self._next
        x, y, z = self._normal[large]
        u, v, w = self._normal[small]
        if x * u + y * v + z * w < _COSINE:
            return False
        a, b, c = points[tail[3 * large]]
        level = a * x + b * y + c * z
        edge = start = self._start[small]
        while True:
            a, b, c = points[tail[edge]]
            if abs(a * x + b * y + c * z - level) > tolerance:
                return False
            edge = nxt[edge]
            if edge == start:
                return True

    def _notch(self, enter: int, leave: int, normal: Point) -> float:
        """How deep a corner lies below the straight line past it [m]; 0 for one that stands out."""
        points, tail, nxt = self._points, self._tail, self._next
        ax, ay, az = points[tail[enter]]
        bx, by, bz = points[tail[leave]]
        cx, cy, cz = points[tail[nxt[leave]]]
        ux, uy, uz = bx - ax, by - ay, bz - az
        vx, vy, vz = cx - bx, cy - by, cz - bz
        nx, ny, nz = normal
        turn = nx * (uy * vz - uz * vy) + ny * (uz * vx - ux * vz) + nz * (ux * vy - uy * vx)
        if turn >= 0.0:
            return 0.0
        across = math.sqrt((ux + vx) ** 2 + (uy + vy) ** 2 + (uz + vz) ** 2)
        if across <= 0.0:
            return math.inf
        depth = -turn / across
        straight = ux * vx + uy * vy + uz * vz > 0.0
        return 0.0 if straight and depth < 1e-9 * across else depth

    def _fills(self, edges: list[int], normal: Point, depth: float) -> bool:
        """Whether no corner of a polygon lies deeper in its hull than this.

        In plain numbers: for a dozen corners they are five times as fast as NumPy.
        """
        (ax, ay, az), (bx, by, bz) = _across(normal)
        points, tail = self._points, self._tail
        flat = []
        for edge in edges:
            x, y, z = points[tail[edge]]
            flat.append((x * ax + y * ay + z * az, x * bx + y * by + z * bz))
        hull = _hull(sorted(flat))
        if len(hull) < 3:
            return False
        corners = set(hull)
        deep = [point for point in flat if point not in corners]
        return all(_is_within(x, y, hull, depth) for x, y in deep)

    def _level(self, vertices: list[int], normal: Point) -> Floats:
        """Vertices in the plane of a normal, shape (n, 2)."""
        flat: Floats = np.array([self._points[v] for v in vertices]) @ plane(np.array(normal)).T
        return flat


def plane(normal: Floats) -> Floats:
    """Two unit vectors across the normal, shape (2, 3), right-handed with it."""
    x, y, z = normal.tolist()
    return np.array(_across((x, y, z)))


def _across(normal: Point) -> tuple[Point, Point]:
    x, y, z = normal
    if abs(x) <= abs(y) and abs(x) <= abs(z):
        u, v, w = 0.0, -z, y
    elif abs(y) <= abs(z):
        u, v, w = z, 0.0, -x
    else:
        u, v, w = -y, x, 0.0
    size = math.sqrt(u * u + v * v + w * w)
    u, v, w = u / size, v / size, w / size
    return (u, v, w), (y * w - z * v, z * u - x * w, x * v - y * u)


def _hull(points: list[Flat]) -> list[Flat]:
    """The corners of the hull of sorted points, counter-clockwise."""
    chains = []
    for order in (points, points[::-1]):
        chain: list[Flat] = []
        for point in order:
            x, y = point
            while len(chain) >= 2:
                (a, b), (c, d) = chain[-2], chain[-1]
                if (c - a) * (y - b) - (d - b) * (x - a) > 0.0:
                    break
                chain.pop()
            chain.append(point)
        chains.append(chain)
    return chains[0][:-1] + chains[1][:-1]


def _is_within(x: float, y: float, hull: list[Flat], depth: float) -> bool:
    """Whether a point in a hull is near to one of its sides."""
    a, b = hull[-1]
    for c, d in hull:
        u, v = c - a, d - b
        if u * (y - b) - v * (x - a) <= depth * math.sqrt(u * u + v * v):
            return True
        a, b = c, d
    return False


def _candidates(surface: Surface, twins: Indices) -> tuple[Indices, Floats]:
    """Half-edges between two triangles, one of each pair, and how far those are from flat [m].

    The flattest and longest come first; what is flat but for rounding counts as flat.
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
    length = np.linalg.norm(ends[twins[edges]] - base, axis=1)
    order = np.lexsort((-length, np.ceil(np.log2(np.maximum(flat, rounding) / rounding))))
    return edges[order], flat[order]
