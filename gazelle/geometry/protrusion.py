"""Measured distance of convex pieces beyond the surface that they stand for."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.hull import Solid, spread_directions
from gazelle.geometry.probing import spread
from gazelle.geometry.surface import WeldedSurface

_PLACES = 20_000
"""Places on the pieces, about."""
_WAYS = spread_directions(24)
"""Directions in which the surface is looked for, besides that into the piece."""
_FAR = 0.7
"""Distance of places beside which there are more in the end, as a share of the largest."""
_MARGIN = 1.05
"""Factor by which more is stated than was measured."""
_RISE = 2e-5
"""Height of a place over its piece, as a share of the size: a ray must not begin on the surface."""


def protrusion(surface: WeldedSurface, solids: list[Solid], closed: Bools) -> float:
    """Return how far pieces reach beyond a surface [m], rather more than less.

    Args:
        surface: Any triangles.
        solids: Convex pieces.
        closed: Whether each triangle belongs to a closed body, shape (m,).
    """
    hulls = _all_faces(solids)
    gaps, faces = _gaps(surface, hulls, closed)
    far = np.unique(faces[gaps > _FAR * gaps.max(initial=0.0)])
    if len(far):  # more places where it is far: there it is farthest between two places
        gaps = np.append(gaps, _gaps(surface, hulls.part(far), closed)[0])
    return _MARGIN * float(gaps.max(initial=0.0))


def _gaps(surface: WeldedSurface, hulls: WeldedSurface, closed: Bools) -> tuple[Floats, Indices]:
    """Return the distance of places on hulls from a surface [m], 0 inside, and their faces."""
    places, faces = spread(hulls, float(np.sqrt(hulls.areas.sum() / _PLACES)))
    places = places + _RISE * surface.size * hulls.normals[faces]
    nearest, inside = surface.rays.first_hits(places, -hulls.normals[faces])
    for way in _WAYS:
        distance, within = surface.rays.first_hits(places, np.broadcast_to(way, places.shape))
        nearest, inside = np.minimum(nearest, distance), inside | within
    return np.where(inside & closed.all(), 0.0, nearest), faces


def _all_faces(solids: list[Solid]) -> WeldedSurface:
    """Return the faces of solids as one surface."""
    counts = [len(points) for points, _ in solids]
    shifts = np.cumsum([0, *counts[:-1]])
    points: Floats = np.concatenate([points for points, _ in solids])
    faces = np.concatenate([rows + shift for (_, rows), shift in zip(solids, shifts, strict=True)])
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    doubled = np.linalg.norm(normals, axis=1)
    real = doubled > 0.0
    normals = normals[real] / doubled[real, None]
    return WeldedSurface(points, faces[real].astype(np.intp), normals, doubled[real] / 2.0)
