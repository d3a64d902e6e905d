"""Convex pieces that stay within a bound of a surface, as few as merging leaves.

The polygons of the surface are thickened inwards and merged while their hulls hold no air that is
farther than the bound from the surface. So what bulges is followed exactly, and a hollow is
filled by less than the bound.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.flat_polygons import Polygons
from gazelle.geometry.hull import Solid, hulls_of
from gazelle.geometry.merging import PieceMerger
from gazelle.geometry.patches import behind_rims, joined_flat, skin_of, widths_of
from gazelle.geometry.probing import ROUNDING, AirBeside
from gazelle.geometry.surface import WeldedSurface

MOST_PIECES = 1000
"""Pieces up to which the bound is kept."""

_FEW_PIECES = 256
"""Pieces up to which they keep to a part of the bound, so that what has little play fits."""
_CLOSE, _WITHIN = 0.4, 0.8
"""Distance from the surface of the air that is kept free, as a share of the bound."""
_MANY_POLYGONS = 3000
_TOO_MANY_POLYGONS = 5000
"""Polygons up to which they are merged as they are, and above which they are joined coarsely."""
_FINE, _COARSE = 0.25, 0.7
"""Largest deviation of joined polygons from a plane, as a share of the bound."""


def pieces_within(
    surface: WeldedSurface, number: Indices, closed: Bools, whole: Bools, bound: float
) -> tuple[list[Solid], float]:
    """Return solids that cover a surface, and how far they reach beyond it at most [m].

    Args:
        surface: Faces of closed parts look outwards.
        number: The part of each face, shape (m,).
        closed: Whether each part is closed, shape (parts,).
        whole: Whether each part is convex, and stays as it is, shape (parts,).
        bound: Largest distance of pieces beyond the surface [m]; more where more than
            ``MOST_PIECES`` would be needed.
    """
    solid, skin = closed[number], min(skin_of(surface), max(bound, 1e-3))
    start, pairs = _clouds(surface, number, solid, whole, bound)
    if len(start) <= 1:
        return hulls_of(start), bound
    air = AirBeside(surface, solid, skin)
    for distance, most in _distances(bound):
        if len(start) > _MANY_POLYGONS and distance < _WITHIN * bound:
            continue  # it would take long, and hardly ever be enough
        if distance > bound:
            start, pairs = _clouds(surface, number, solid, whole, distance)
        merger = PieceMerger(start, air.at(distance))
        merger.merge(pairs)
        merger.merge(merger.overlapping())
        clouds = merger.clouds()
        if len(clouds) <= most:
            break
    return hulls_of(clouds), max(bound, distance / _WITHIN)


def _distances(bound: float) -> Iterator[tuple[float, int]]:
    """Yield distances to try, and how many pieces may be needed for each."""
    yield _CLOSE * bound, _FEW_PIECES
    yield from ((_WITHIN * bound * 2.0**power, MOST_PIECES) for power in range(16))


def _clouds(
    surface: WeldedSurface, number: Indices, solid: Bools, whole: Bools, bound: float
) -> tuple[list[Floats], Indices]:
    """Return the points of each convex part and thickened polygon, and which polygons touch."""
    clouds, rest = _convex_clouds(surface, number, whole), ~whole[number]
    if not rest.any():
        return clouds, np.zeros((0, 2), np.intp)
    joined = joined_flat(surface if rest.all() else surface.part(rest))
    for share, count in ((_FINE, _MANY_POLYGONS), (_COARSE, _TOO_MANY_POLYGONS)):
        if joined.count > count:
            joined.join(share * bound, notches=True)
    thick, row = _thickened(joined, solid[rest], max(bound, 1e-3))
    row = np.where(row >= 0, row + len(clouds), -1)
    twins = joined.surface.twins
    edges = np.flatnonzero(twins >= 0)
    ends = np.sort(np.stack([row[edges // 3], row[twins[edges] // 3]], axis=1), axis=1)
    ends = np.unique(ends[(ends[:, 0] >= 0) & (ends[:, 0] != ends[:, 1])], axis=0)
    return clouds + thick, ends


def _convex_clouds(surface: WeldedSurface, number: Indices, whole: Bools) -> list[Floats]:
    """Return the corners of each convex part."""
    faces = np.flatnonzero(whole[number])
    order = faces[np.argsort(number[faces], kind="stable")]
    ends = np.flatnonzero(np.diff(number[order], append=-1)) + 1
    rows = np.split(surface.faces[order], ends[:-1]) if len(order) else []
    return [surface.vertices[np.unique(corners)] for corners in rows]


def _thickened(joined: Polygons, solid: Bools, skin: float) -> tuple[list[Floats], Indices]:
    """Return the points of each polygon and those behind it, and the row of each triangle.

    Polygons without a width are left out; their triangles have the row -1.
    """
    surface, rims = joined.surface, joined.rims()
    behind = behind_rims(surface, rims, solid, skin)
    real = np.flatnonzero(widths_of(surface, rims) > ROUNDING * surface.size)
    row = np.full(len(rims.sizes), -1)
    row[real] = np.arange(len(real))
    corners = np.repeat(rims.owners, 3) * len(surface.vertices) + surface.faces.ravel()
    owners, vertices = np.divmod(np.unique(corners), len(surface.vertices))
    kept = row[owners] >= 0
    owners, points = owners[kept], surface.vertices[vertices[kept]]
    back = row[rims.rows] >= 0
    owners = np.concatenate([owners, rims.rows[back]])
    order = np.argsort(owners, kind="stable")
    owners, points = owners[order], np.concatenate([points, behind[back]])[order]
    starts, ends = (np.searchsorted(owners, real, side=side) for side in ("left", "right"))
    clouds = [points[i:j] for i, j in zip(starts.tolist(), ends.tolist(), strict=True)]
    return clouds, row[rims.owners]
