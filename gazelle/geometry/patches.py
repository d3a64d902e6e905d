"""Convex solids from the thickened polygons of a surface, so that hollow meshes stay hollow.

A solid keeps to its polygon and grows from there inwards: where a closed body is behind, by
half of what is there at most; behind a sheet by a skin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.geometry.flat_polygons import Polygons, Rims
from gazelle.geometry.hull import Solid
from gazelle.geometry.probing import spread
from gazelle.geometry.surface import WeldedSurface

FINE = (7e-3, 7e-3)
"""Largest deviation of solids from a surface before their number is unlimited: a length [m], or a
share of the size if that is less."""
MOST_PATCHES = 20_000
"""Solids from which on they are coarser than that."""

_FEW = 1000
"""Solids up to which they follow the surface exactly."""
_ROUNDING = 1e-6
"""Tolerance of flatness, as a share of the size."""
_MANY = 40_000
"""Polygons from which on only the last tolerance is tried."""
_FIRST = (5e-4, 2e-3)
"""Tolerances that are tried first [m]."""
_SKIN = (1e-3, 1e-2)
"""Least and greatest thickness of what is open behind [m]."""
_THINNEST = (2e-4, 1e-3)
"""Least thickness of anything: a length [m], or a share of the size if that is less."""
_FLAT = 4e-6
"""Thickness of what has no volume in hulls, as a share of the size."""
_DEEPEST = 0.05
"""Thickness up to which a body is filled behind its surface [m]."""
_INSET, _BESIDE = 0.02, 0.0005
"""Distances from a corner at which its thickness is measured, as shares of the way to the middle."""
_RAYS = 20_000
"""Rays over all of a surface that measure thickness, about, and those beside its corners."""


@dataclass(frozen=True, slots=True)
class Patches:
    """Solids along a surface.

    Attributes:
        solids: Vertices and faces of each.
        gap: Largest distance of their outer sides off the surface [m].
    """

    solids: list[Solid]
    gap: float


def joined_flat(surface: WeldedSurface) -> Polygons:
    """Return the convex polygons of a surface that are flat up to rounding."""
    joined = Polygons(surface)
    joined.join(_ROUNDING * surface.size, notches=False)
    return joined


def thick_patches(joined: Polygons, closed: NDArray[np.bool_]) -> Patches:
    """Return convex solids along a surface.

    They follow it exactly if ``_FEW`` are enough for that, within ``FINE`` if ``MOST_PATCHES``
    are, else as well as those can.

    Args:
        joined: Its flat polygons, which are joined on.
        closed: Whether each triangle belongs to the surface of a closed body, shape (m,).
    """
    surface, gap = joined.surface, _ROUNDING * joined.surface.size
    for tolerance, most in _tolerances(surface.size, joined.count):
        if joined.count > most:
            joined.join(tolerance, notches=True)
            gap = math.hypot(tolerance, tolerance)  # across the plane, and in a notch
    rims = joined.rims()
    ends = np.cumsum(rims.sizes)[:-1]
    corners = np.split(surface.vertices[rims.vertices], ends)
    behind = np.split(behind_rims(surface, rims, closed, skin_of(surface)), ends)
    wide = widths_of(surface, rims) > _ROUNDING * surface.size  # what is not has no hull
    solids = [frustum(corners[row], behind[row]) for row in np.flatnonzero(wide).tolist()]
    return Patches(solids, gap)


def _tolerances(size: float, count: int) -> Iterator[tuple[float, int]]:
    """Yield tolerances of polygons, each with the polygon count above which it applies."""
    fine = min(FINE[0], FINE[1] * size)
    first = [each for each in _FIRST if each < fine] if count <= _MANY else []
    yield from ((tolerance, _FEW) for tolerance in (*first, fine))
    yield from ((fine * 2.0**power, MOST_PATCHES) for power in range(32))


def widths_of(surface: WeldedSurface, rims: Rims) -> Floats:
    """Return the width of each polygon at its middle, about [m]; 0 without three corners."""
    widths = np.zeros(len(rims.sizes))
    real = np.flatnonzero(rims.sizes)
    starts = (np.cumsum(rims.sizes) - rims.sizes)[real]
    points = surface.vertices[rims.vertices]
    away = points - np.repeat(points[starts], rims.sizes[real], axis=0)
    doubled = np.add.reduceat(np.cross(away, np.roll(away, -1, axis=0)), starts)
    longest = np.sqrt(np.maximum.reduceat(np.einsum("ij,ij->i", away, away), starts))
    area = np.einsum("ij,ij->i", doubled, rims.normals[real]) / 2.0
    widths[real] = np.where(rims.sizes[real] >= 3, area / np.maximum(longest, 1e-300), 0.0)
    return widths


def skin_of(surface: WeldedSurface) -> float:
    """Return the thickness assumed for surfaces that do not enclose a volume [m]."""
    return float(np.clip(0.01 * surface.size, *_SKIN))


def behind_rims(
    surface: WeldedSurface, rims: Rims, closed: NDArray[np.bool_], skin: float
) -> Floats:
    """Return a place behind each corner of polygons, within the body, shape (n, 3).

    Polygons of closed bodies are narrower behind at sharp edges, so that they stay within.

    Args:
        surface: Surface of the polygons.
        rims: The polygons.
        closed: Whether each triangle belongs to the surface of a closed body, shape (m,).
        skin: Thickness of what is open behind, at most [m].
    """
    corners, rows, count = surface.vertices[rims.vertices], rims.rows, len(rims.sizes)
    sums = [np.bincount(rows, corners[:, axis], count) for axis in range(3)]
    inwards = (np.stack(sums, axis=1) / np.maximum(rims.sizes, 1)[:, None])[rows] - corners
    inset = corners + _INSET * inwards
    some = np.arange(0, len(rows), 1 + len(rows) // _RAYS)
    over, owners = _over_polygons(surface, rims)
    origins = np.concatenate([over, inset[some], (corners + _BESIDE * inwards)[some]])
    owners = np.concatenate([owners, rows[some], rows[some]])
    distance, leaves = surface.rays.first_hits(origins, -rims.normals[owners])
    solid = closed[rims.faces]
    room = np.minimum(distance / 2.0, np.where(solid[owners] & leaves, _DEEPEST, skin))
    measured = len(owners) - len(some)
    depths = np.full(count, _DEEPEST)
    np.minimum.at(depths, owners[:measured], room[:measured])
    least = max(min(_THINNEST[0], _THINNEST[1] * surface.size), _FLAT * surface.size)
    depths = np.maximum(depths, least)
    straight = ~solid[rows]
    straight[some] |= room[measured:] >= depths[rows[some]]
    upper = np.where(straight[:, None], corners, inset)
    behind: Floats = upper - depths[rows, None] * rims.normals[rows]
    return behind


def _over_polygons(surface: WeldedSurface, rims: Rims) -> tuple[Floats, NDArray[np.intp]]:
    """Return places all over a surface, some in each polygon, and their polygons."""
    places, faces = spread(surface, math.sqrt(float(surface.areas.sum()) / _RAYS))
    owners = rims.owners[faces]
    rows = np.arange(0, len(owners), 1 + len(owners) // (2 * _RAYS))
    rows = np.union1d(rows, np.unique(owners, return_index=True)[1])
    return places[rows], owners[rows]


def prism(rim: Floats, thickness: Floats) -> Solid:
    """Return a convex polygon, shape (n, 3), counter-clockwise from outside, thickened inwards.

    The thickness is a vector that points out of the polygon [m].
    """
    return frustum(rim, rim - thickness)


def frustum(rim: Floats, behind: Floats) -> Solid:
    """Return the body between a convex polygon, counter-clockwise from outside, and one behind it.

    Both have as many corners, shape (n, 3).
    """
    return np.concatenate([rim, behind]), _prism_faces(len(rim))


@lru_cache(maxsize=256)
def _prism_faces(count: int) -> NDArray[np.int32]:
    """Return triangles of a prism over a given number of corners, those of the other end after them."""
    here = np.arange(count, dtype=np.int32)
    after = np.roll(here, -1)
    fan = np.stack([np.zeros(count - 2, np.int32), here[1:-1], here[2:]], axis=1)
    sides = np.concatenate(
        [
            np.stack([here, here + count, after], axis=1),
            np.stack([after, here + count, after + count], axis=1),
        ]
    )
    faces = np.concatenate([fan, fan[:, ::-1] + count, sides]).astype(np.int32)
    faces.setflags(write=False)
    return faces
