"""Outlines that stand between two heights, as flat faces with four corners each.

All are arrays of corners x, y, z [m], shape (n, 4, 3), counter-clockwise seen from where a face is
seen: from behind, where it is solid, nothing is.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from gazelle.array_types import Floats
from gazelle.geometry.polygons import Point, ccw, convex

NO_FACES: Floats = np.zeros((0, 4, 3))


def walls_between(lines: Floats, low: float, high: float) -> Floats:
    """Return faces on segments x0, y0, x1, y1 [m], shape (n, 4), from a height to another.

    They are seen from the right of the segments, and what is on their left is solid.
    """
    faces = np.empty((len(lines), 4, 3))
    for corner, (x, y, z) in enumerate(((0, 1, low), (2, 3, low), (2, 3, high), (0, 1, high))):
        faces[:, corner, :2], faces[:, corner, 2] = lines[:, [x, y]], z
    return faces


def plates(quads: Floats, height: float) -> Floats:
    """Return level faces with these corners, shape (n, 4, 2), at a height.

    They are seen from above if the corners go counter-clockwise.
    """
    return np.concatenate((quads, np.full((len(quads), 4, 1), height)), axis=2)


def prism(points: Iterable[Point], low: float, high: float) -> Floats:
    """Return all faces of an outline that stands between two heights."""
    ring = ccw(np.asarray(list(points), np.float64))
    sides = walls_between(np.hstack((ring, np.roll(ring, -1, axis=0))), low, high)
    quads = np.vstack([np.zeros((0, 4, 2)), *(_fan_of(polygon) for polygon in convex(ring))])
    return np.vstack((sides, plates(quads[:, ::-1], low), plates(quads, high)))


def in_tiles(faces: Floats, most: int) -> list[Floats]:
    """Return faces in groups of neighbours, at most a given number each.

    Halved along the longer side of where their middles are, again and again, so that a camera can
    leave out what is aside.
    """
    if len(faces) <= most:
        return [faces]
    middles = faces.mean(axis=1)
    axis = int(np.argmax(np.ptp(middles, axis=0)))
    order, half = np.argsort(middles[:, axis], kind="stable"), len(faces) // 2
    return [*in_tiles(faces[order[:half]], most), *in_tiles(faces[order[half:]], most)]


def _fan_of(polygon: Floats) -> Floats:
    """Return a convex polygon as quadrangles from its first corner, shape (n, 4, 2)."""
    count = len(polygon)
    firsts = range(1, count - 1, 2)
    found = [polygon[[0, i, i + 1, i + 2 if i + 2 < count else 0]] for i in firsts]
    return np.array(found).reshape(-1, 4, 2)
