"""Convex pieces that stay within a bound of a surface, as few as merging leaves.

The polygons of the surface are thickened inwards and merged while their hulls hold no air that is
farther than the bound from the surface. So what bulges is followed exactly, and a hollow is
filled by less than the bound.
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.flat_polygons import Polygons
from gazelle.geometry.hull import Solid, hulls_of
from gazelle.geometry.merging import PieceMerger
from gazelle.geometry.patches import behind_rims, joined_flat, skin_of, widths_of
from gazelle.geometry.piece_groups import grouped_by_cells
from gazelle.geometry.probing import ROUNDING, AirBeside
from gazelle.geometry.protrusion import protrusion
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
_MOST_POLYGONS = 50_000
"""Polygons up to which they are merged one by one, and above which those of a cell are one."""
_FINE, _COARSE = 0.25, 0.7
"""Largest deviation of joined polygons from a plane, as a share of the bound."""
_FAR = 8
"""Times too many pieces from which on the next bound is four times as large, and not twice."""
_CELL = 0.5
"""Side of a cell, likewise; hulls of polygons of at most its side each stay within the bound."""


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
    clouds, pairs = _clouds(surface, number, solid, whole, bound)
    if len(clouds) <= 1:
        return hulls_of(clouds), bound
    air = AirBeside(surface, solid, skin)
    if len(clouds) <= _MANY_POLYGONS:  # of more it would take long, and hardly ever be enough
        clouds, pairs = _merged(clouds, pairs, air.at(_CLOSE * bound), 0.0), pairs[:0]
        if len(clouds) <= _FEW_PIECES:
            return hulls_of(clouds), bound
    if len(clouds) <= _MOST_POLYGONS:
        clouds, pairs = _merged(clouds, pairs, air.at(_WITHIN * bound), 0.0), pairs[:0]
        if len(clouds) <= MOST_PIECES:
            return hulls_of(clouds), bound
    solids, gap = _beyond_bound(surface, solid, air, clouds, pairs, bound)
    return solids, max(bound, gap)


def _beyond_bound(
    surface: WeldedSurface,
    solid: Bools,
    air: AirBeside,
    clouds: list[Floats],
    pairs: Indices,
    bound: float,
) -> tuple[list[Solid], float]:
    """Return few pieces of a surface for which the bound is too tight, and how far they reach.

    It is measured: the hull of all is taken where fewer pieces would reach as far.
    """
    hull = hulls_of([np.concatenate(clouds)])
    farthest, level = protrusion(surface, hull, solid), 2.0 * bound
    while level < farthest:
        if len(clouds) > _MOST_POLYGONS:
            grouped = grouped_by_cells(clouds, pairs, _CELL * level)
            if len(grouped[0]) > _MOST_POLYGONS:
                level *= 2.0
                continue
            clouds, pairs = grouped
        clouds, pairs = _merged(clouds, pairs, air.at(_WITHIN * level), level), pairs[:0]
        if len(clouds) <= MOST_PIECES:
            solids = hulls_of(clouds)
            return solids, min(level, protrusion(surface, solids, solid))
        level *= 4.0 if len(clouds) > _FAR * MOST_PIECES else 2.0
    return hull, farthest


def _merged(clouds: list[Floats], pairs: Indices, probes: Floats, reach: float) -> list[Floats]:
    """Return pieces merged where they touch, then where they are within reach [m]."""
    merger = PieceMerger(clouds, probes)
    merger.merge(pairs)
    merger.merge(merger.overlapping(reach))
    return merger.clouds()


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
