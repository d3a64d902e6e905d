"""Measured distance of convex pieces beyond the surface that they stand for."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.hull import Solid, spread_directions
from gazelle.geometry.probing import spread
from gazelle.geometry.surface import WeldedSurface

_PLACES = 20_000
"""Places on the pieces, about."""
_TOGETHER = 1000
"""Places that are measured at once; the largest distance is known to later ones."""
_WAYS = spread_directions(24)
"""Directions in which backs of a body are looked for, besides that into the piece."""
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
    hulls, is_body = _all_faces(solids), bool(closed.all())
    farthest, faces = _farthest(surface, hulls, is_body)
    if len(faces):  # more places where it is far: there it is farthest between two places
        farthest = max(farthest, _farthest(surface, hulls.part(faces), is_body)[0])
    return _MARGIN * farthest


def _farthest(surface: WeldedSurface, hulls: WeldedSurface, is_body: bool) -> tuple[float, Indices]:  # noqa: FBT001
    """Return the largest distance of places on hulls from a surface [m], and the faces with nearly that.

    Places within a body have none.
    """
    places, faces = spread(hulls, float(np.sqrt(hulls.areas.sum() / _PLACES)))
    farthest, gaps = 0.0, np.zeros(len(places))
    for start in range(0, len(places), _TOGETHER):
        rows = np.arange(start, min(start + _TOGETHER, len(places)))
        gaps[rows] = surface.distances.of(places[rows], _FAR * farthest)
        rows = rows[gaps[rows] > _FAR * farthest]
        if is_body:
            raised = places[rows] + _RISE * surface.size * hulls.normals[faces[rows]]
            gaps[rows[_within(surface, raised, -hulls.normals[faces[rows]])]] = 0.0
        farthest = max(farthest, float(gaps[rows].max(initial=0.0)))
    return farthest, np.unique(faces[gaps > _FAR * farthest])


def _within(surface: WeldedSurface, places: Floats, ways: Floats) -> Bools:
    """Return whether places are in a body: along their ways or others they first meet a back."""
    inside = surface.rays.first_hits(places, ways)[1]
    for way in _WAYS:
        rows = np.flatnonzero(~inside)
        ahead = np.broadcast_to(way, (len(rows), 3))
        inside[rows] = surface.rays.first_hits(places[rows], ahead)[1]
    return inside


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
