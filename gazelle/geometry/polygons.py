"""Polygons in the plane: area, orientation, convex hull, convex parts.

The hull is Andrew's monotone chain (1979); convex parts are slabs between corners.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices

Point = tuple[float, float]
Outline = Sequence[Point]


def convex_polygons(outlines: Sequence[Outline]) -> list[Floats]:
    """Return convex polygons, shape (n, 2), counter-clockwise, that cover outlines.

    What is inside of two outlines is a hole: inside is where a way out crosses an odd
    number of them. An outline is closed whether or not its last point is its first.
    """
    edges = _edges(outlines)
    if not len(edges):
        return []
    levels = np.unique(edges[:, :, 1])
    size = float(np.ptp(edges.reshape(-1, 2), axis=0).max())
    parts: list[_Slab] = []
    open_parts: list[_Slab] = []
    for low, high in itertools.pairwise(levels.tolist()):
        slab = [_Slab(corners, low, high) for corners in _slab(edges, low, high)]
        tops = np.array([part.ends(part.top) for part in open_parts]).reshape(-1, 2)
        open_parts = [_grown(part, _touching(part, open_parts, tops), size) for part in slab]
        parts.extend(part for part in open_parts if part.bottom == low)
    # a part that grew stands in the list as it was begun; its corners are the grown ones
    return [part.corners for part in parts]


@dataclass(slots=True)
class _Slab:
    """A convex polygon between two levels of y."""

    corners: Floats
    bottom: float
    top: float

    def ends(self, level: float) -> tuple[float, float]:
        """Return the least and the greatest x at its bottom or top."""
        x = self.corners[self.corners[:, 1] == level, 0]
        return float(x.min()), float(x.max())


def _touching(part: _Slab, below: list[_Slab], tops: Floats) -> list[_Slab]:
    """Return the parts below whose tops, shape (n, 2), meet the bottom of one: few of many."""
    left, right = part.ends(part.bottom)
    near = (tops[:, 0] <= right) & (tops[:, 1] >= left)
    return [below[place] for place in np.flatnonzero(near)]


def _edges(outlines: Sequence[Outline]) -> Floats:
    """Return all edges that are not level, lower end first, shape (n, 2, 2)."""
    found = []
    for outline in outlines:
        points = np.asarray(outline, np.float64).reshape(-1, 2)
        if len(points) >= 3:
            found.append(np.stack([points, np.roll(points, -1, axis=0)], axis=1))
    if not found:
        return np.empty((0, 2, 2))
    edges: Floats = np.concatenate(found)
    edges = edges[edges[:, 0, 1] != edges[:, 1, 1]]
    down = edges[:, 0, 1] > edges[:, 1, 1]
    edges[down] = edges[down, ::-1]
    return edges


def _slab(edges: Floats, low: float, high: float) -> list[Floats]:
    """Return the trapezoids between two levels, from left to right."""
    crossing = edges[(edges[:, 0, 1] <= low) & (edges[:, 1, 1] >= high)]
    rise = crossing[:, 1, 1] - crossing[:, 0, 1]
    slope = (crossing[:, 1, 0] - crossing[:, 0, 0]) / rise
    below = crossing[:, 0, 0] + slope * (low - crossing[:, 0, 1])
    above = crossing[:, 0, 0] + slope * (high - crossing[:, 0, 1])
    order = np.argsort(below + above, kind="stable").tolist()
    found = []
    for left, right in zip(order[::2], order[1::2], strict=False):
        corners = np.array(
            [(below[left], low), (below[right], low), (above[right], high), (above[left], high)]
        )
        hull = corners[planar_hull(corners)]
        if len(hull) >= 3 and planar_area(hull) > 0.0:
            found.append(hull)
    return found


def _grown(part: _Slab, below: list[_Slab], size: float) -> _Slab:
    """Return a part of the slab below with this one added, if both are convex together."""
    for other in below:
        both = np.concatenate([other.corners, part.corners])
        hull = both[planar_hull(both)]
        lacking = planar_area(hull) - planar_area(other.corners) - planar_area(part.corners)
        if abs(lacking) <= 1e-9 * size * size and other.top == part.bottom:
            other.corners, other.top = hull, part.top
            return other
    return part


def ccw(points: Floats) -> Floats:
    """Return the corners of a polygon in counter-clockwise order."""
    ends = np.roll(points, -1, axis=0)
    twice_area = float((points[:, 0] * ends[:, 1] - points[:, 1] * ends[:, 0]).sum())
    return points if twice_area >= 0.0 else points[::-1]


def convex(points: Floats) -> Sequence[Floats]:
    """Return convex polygons that together cover a counter-clockwise polygon."""
    before, after = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
    if (before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0] >= -1e-12).all():
        return [points]
    outline = tuple((float(x), float(y)) for x, y in points)
    return [ccw(np.asarray(piece, np.float64)) for piece in convex_polygons((outline,))]


def planar_hull(points: Floats) -> Indices:
    """Return the corners of the hull of points, shape (n, 2), counter-clockwise."""
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
    """Return the area of a polygon, shape (n, 2), by the shoelace formula.

    It is positive if the corners are counter-clockwise.
    """
    x, y = points[:, 0], points[:, 1]
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0
