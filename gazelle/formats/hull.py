"""Convex hulls: of points in space (Quickhull, to a tolerance) and in the plane.

Quickhull: Barber, Dobkin, Huhdanpaa, "The Quickhull algorithm for convex hulls", ACM
Transactions on Mathematical Software 22 (1996). The hull in the plane is Andrew's
monotone chain (1979).
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices

_ATTEMPTS = 4
_MAX_PAIRS = 20_000_000


@dataclass(frozen=True, slots=True)
class Hull:
    """A convex hull.

    Attributes:
        faces: Corners of its triangles as rows of the points, counter-clockwise from
            outside, shape (m, 3).
        normals: Unit vectors outwards, shape (m, 3).
        offsets: Distance of each face's plane from the origin along its normal, shape (m,).
    """

    faces: Indices
    normals: Floats
    offsets: Floats

    def depth(self, points: Floats) -> Floats:
        """How deep points inside lie below the surface, shape (n,); negative outside."""
        gaps = self.offsets[:, None] - self.normals @ points.T
        depth: Floats = gaps.min(axis=0)
        return depth


@dataclass(slots=True)
class _Face:
    corners: tuple[int, int, int]
    normal: Floats
    offset: float
    outside: Indices


class _SpoiledError(Exception):
    """The hull is none by rounding: a face has no area, or the faces around a hole no ring."""


def convex_hull(points: Floats, tolerance: float) -> Hull | None:
    """The hull of points, shape (n, 3); None if they lie in a plane.

    Points that stand out of it by less than the tolerance may be left out. Where rounding
    spoils the hull, points are shaken by about the tolerance, always in the same way.
    """
    for attempt in range(_ATTEMPTS):
        shake = attempt * tolerance
        noise = np.random.default_rng(attempt).uniform(-shake, shake, points.shape)
        with suppress(_SpoiledError):
            hull = _hull(points + noise, tolerance if attempt == 0 else 1e-3 * tolerance)
            if hull is None or _holds(hull, points, 4.0 * (tolerance + shake)):
                return hull
    return None


def _holds(hull: Hull, points: Floats, tolerance: float) -> bool:
    rows = max(1, _MAX_PAIRS // len(hull.offsets))
    parts = (points[start : start + rows] for start in range(0, len(points), rows))
    return all(float(hull.depth(part).min()) >= -tolerance for part in parts)


def _hull(points: Floats, tolerance: float) -> Hull | None:
    first = _tetrahedron(points, tolerance)
    if first is None:
        return None
    builder = _Builder(points, tolerance)
    builder.start(first)
    builder.grow()
    faces = list(builder.faces.values())
    return Hull(
        np.array([face.corners for face in faces], dtype=np.intp),
        np.array([face.normal for face in faces]),
        np.array([face.offset for face in faces]),
    )


def _tetrahedron(points: Floats, tolerance: float) -> tuple[int, int, int, int] | None:
    """Four points far from each other, positively oriented."""
    if len(points) < 4:
        return None
    a = int(points[:, 0].argmin())
    b = int(np.linalg.norm(points - points[a], axis=1).argmax())
    along = points[b] - points[a]
    length = float(np.linalg.norm(along))
    if length <= tolerance:
        return None
    aside = np.cross(points - points[a], along / length)
    c = int(np.linalg.norm(aside, axis=1).argmax())
    normal = np.cross(along, points[c] - points[a])
    size = float(np.linalg.norm(normal))
    if size / length <= tolerance:
        return None
    heights = (points - points[a]) @ (normal / size)
    d = int(np.abs(heights).argmax())
    if abs(heights[d]) <= tolerance:
        return None
    return (a, b, c, d) if heights[d] < 0.0 else (a, c, b, d)


class _Builder:
    """Faces by number, and the face to the left of each directed edge."""

    def __init__(self, points: Floats, tolerance: float) -> None:
        self.faces: dict[int, _Face] = {}
        self._points = points
        self._tolerance = tolerance
        self._edges: dict[tuple[int, int], int] = {}
        self._count = 0
        self._waiting: list[int] = []

    def start(self, corners: tuple[int, int, int, int]) -> None:
        a, b, c, d = corners
        free = np.setdiff1d(np.arange(len(self._points)), corners)
        for triangle in ((a, b, c), (a, d, b), (b, d, c), (c, d, a)):
            free = self._add(triangle, free)

    def grow(self) -> None:
        while self._waiting:
            number = self._waiting.pop()
            face = self.faces.get(number)
            if face is None or not len(face.outside):
                continue
            heights = self._points[face.outside] @ face.normal
            self._reach(int(face.outside[heights.argmax()]), number)

    def _add(self, corners: tuple[int, int, int], free: Indices) -> Indices:
        """Add a face, which takes the free points outside of it; what is left of them."""
        a, b, c = self._points[list(corners)].tolist()
        normal = _unit_normal(a, b, c)
        offset = float(normal @ self._points[corners[0]])
        above = self._points[free] @ normal - offset > self._tolerance
        number = self._count
        self._count += 1
        self.faces[number] = _Face(corners, normal, offset, free[above])
        for i in range(3):
            self._edges[corners[i], corners[(i + 1) % 3]] = number
        if above.any():
            self._waiting.append(number)
        return free[~above]

    def _reach(self, top: int, start: int) -> None:
        """Replace all faces that see a point by a cone to it."""
        point = self._points[top]
        visible, rim, pending = {start}, [], [start]
        while pending:
            corners = self.faces[pending.pop()].corners
            for i in range(3):
                edge = (corners[i], corners[(i + 1) % 3])
                other = self._edges[edge[1], edge[0]]
                if other in visible:
                    continue
                face = self.faces[other]
                if float(face.normal @ point) - face.offset > self._tolerance:
                    visible.add(other)
                    pending.append(other)
                else:
                    rim.append(edge)
        free = np.concatenate([self.faces.pop(number).outside for number in sorted(visible)])
        free = free[free != top]
        if len({tail for tail, _ in rim}) < len(rim):
            raise _SpoiledError
        for tail, head in rim:
            free = self._add((tail, head, top), free)


def _unit_normal(a: list[float], b: list[float], c: list[float]) -> Floats:
    """Across a triangle; in plain numbers, which for three are ten times as fast as NumPy.

    Raises:
        _SpoiledError: The triangle has no area.
    """
    ux, uy, uz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    vx, vy, vz = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    size = math.sqrt(x * x + y * y + z * z)
    if size == 0.0:
        raise _SpoiledError
    return np.array((x / size, y / size, z / size))


def planar_hull(points: Floats) -> Indices:
    """The corners of the hull of points in the plane, shape (n, 2), counter-clockwise."""
    order = np.lexsort((points[:, 1], points[:, 0]))
    rows = [(float(points[i, 0]), float(points[i, 1]), int(i)) for i in order]
    lower, upper = _chain(rows), _chain(rows[::-1])
    return np.array(lower[:-1] + upper[:-1], dtype=np.intp)


def _chain(rows: list[tuple[float, float, int]]) -> list[int]:
    chain: list[tuple[float, float, int]] = []
    for row in rows:
        while len(chain) >= 2 and _turn(chain[-2], chain[-1], row) <= 0.0:
            chain.pop()
        chain.append(row)
    return [index for _, _, index in chain]


def _turn(
    a: tuple[float, float, int], b: tuple[float, float, int], c: tuple[float, float, int]
) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def planar_area(points: Floats) -> float:
    """Area of a polygon, shape (n, 2), positive if counter-clockwise (shoelace formula)."""
    x, y = points[:, 0], points[:, 1]
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0
