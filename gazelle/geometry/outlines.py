"""Many polygons in the plane at once: what of them is not convex, and how deep that is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Indices

_ROUNDING = 1e-9
"""Share of the squared length at which a turn counts as none."""
_FULL = 1e-6
"""Tolerance of the sum of a convex polygon's turns about one full turn [rad]."""


@dataclass(frozen=True, slots=True)
class Planar:
    """Polygons, each in a plane of its own, corners counter-clockwise.

    Attributes:
        points: Corners of one after the other [m], shape (n, 2).
        rows: Owner of each, rising, shape (n,).
        count: Largest number of polygons.
    """

    points: Floats
    rows: Indices
    count: int


def hull_rows(polygons: Planar) -> Bools:
    """Return a mask of the corners of the polygons' hulls, shape (n,).

    A corner that does not stand out of its polygon is not on the hull: such corners are left out
    until there is none. That gives hulls where rims do not cross themselves.
    """
    kept = np.ones(len(polygons.points), bool)
    left = np.arange(len(kept))
    while len(left):
        points, rows = polygons.points[left], polygons.rows[left]
        before, after = _neighbours(rows)
        u, v = points - points[before], points[after] - points
        turn = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
        least = _ROUNDING * (np.einsum("ij,ij->i", u, u) + np.einsum("ij,ij->i", v, v))
        inside = turn <= least
        if not inside.any():
            break
        kept[left[inside]] = False
        changed = np.zeros(polygons.count, bool)
        changed[rows[inside]] = True
        left = left[changed[rows] & ~inside]
    return kept


def filled(polygons: Planar, depth: float) -> Bools:
    """Return whether all corners off the hull are no deeper in it than this, shape (k,).

    Deep is what is far from the side of the hull across its own notch: in a thin ring that is
    nearly closed all corners are close to some side.
    """
    kept = hull_rows(polygons)
    fits = _turns_once(polygons, kept)
    points, rows = polygons.points[kept], polygons.rows[kept]
    _, after = _neighbours(rows)
    sides = np.bincount(rows, minlength=polygons.count)
    starts = np.cumsum(sides) - sides
    checked = np.flatnonzero(~kept & fits[polygons.rows])
    owner = polygons.rows[checked]
    passed = np.cumsum(kept)[checked] - 1 - starts[owner]
    side = starts[owner] + passed % np.maximum(sides[owner], 1)
    along, away = points[after[side]] - points[side], polygons.points[checked] - points[side]
    height = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    height /= np.hypot(along[:, 0], along[:, 1])
    fits[owner[height > depth]] = False
    return fits


def _turns_once(polygons: Planar, kept: Bools) -> Bools:
    """Return whether kept corners are at least three and go around once, shape (k,)."""
    points, rows = polygons.points[kept], polygons.rows[kept]
    before, after = _neighbours(rows)
    u, v = points - points[before], points[after] - points
    turn = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    angles = np.arctan2(turn, np.einsum("ij,ij->i", u, v))
    whole = np.bincount(rows, angles, minlength=polygons.count)
    enough = np.bincount(rows, minlength=polygons.count) >= 3
    return np.asarray(enough & (np.abs(whole - 2.0 * np.pi) < _FULL))


def _neighbours(rows: Indices) -> tuple[Indices, Indices]:
    """Return the corners before and after each in its polygon, shapes (n,)."""
    here = np.arange(len(rows))
    starts = np.flatnonzero(np.r_[True, rows[1:] != rows[:-1]][: len(rows)])
    ends = np.r_[starts[1:], len(rows)] - 1 if len(rows) else starts
    before, after = here - 1, here + 1
    before[starts], after[ends] = ends, starts
    return before, after
