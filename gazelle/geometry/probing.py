"""Places in the air close to a surface, which its convex pieces must not hold.

Every place is at the same distance from the surface. The first air that a growing hull reaches is
that at the bottom of a notch, so there are most of them along edges that are bent inwards.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.geometry.ray_hits import first_hits
from gazelle.geometry.surface import WeldedSurface

ROUNDING = 1e-6
"""Height of a triangle over its neighbour's plane that counts as none, as a share of the size."""
_COARSE = 60.0
"""Places along the size of the surface, at least."""
_ALONG = 20_000
"""Places along all edges that are bent inwards, about, at most."""
_INSET = 0.02
"""Distance of probes from the corners beside them, as a share of the way to the middle."""
_SHARP = 0.85
"""Cosine of the turn at an edge up to which there are places on both sides of it."""
_BESIDE = 0.1
"""Distance of these from the edge, as a share of that from the surface."""
_SHARPEST = 0.2
"""Cosine of half the turn at an edge from which on places are not moved farther out."""
_TURNS = (0.7548776662466927, 0.5698402909980532)
"""Steps of the R2 sequence (Roberts, "The unreasonable effectiveness of quasirandom sequences",
2018)."""


@dataclass(frozen=True, slots=True)
class _Feet:
    """Places on a surface, below those in the air.

    Attributes:
        points: [m], shape (n, 3).
        ways: Unit vectors into the air, shape (n, 3).
        lengths: Positions of the points in the air along them [m], shape (n,).
        faces: The triangle of each, shape (n,).
    """

    points: Floats
    ways: Floats
    lengths: Floats
    faces: Indices


def air_beside(surface: WeldedSurface, closed: Bools, distance: float, skin: float) -> Floats:
    """Return places in the air at a distance from a surface, shape (n, 3).

    Gaps narrower than twice the distance have none.

    Args:
        surface: Any triangles.
        closed: Whether each triangle belongs to a closed body, shape (m,); of other triangles
            there is air on both sides.
        distance: From the surface [m].
        skin: Thickness of what is not closed, behind it [m].
    """
    over, rims = _over_faces(surface, distance), _along_rims(surface, distance)
    along = _along_notches(surface, distance)
    found = [_in_air(surface, feet, closed) for feet in (over, rims, along)]
    if not closed.all():
        rows = ~closed[over.faces]
        lengths = over.lengths[rows] + skin
        behind = _Feet(over.points[rows], -over.ways[rows], lengths, over.faces[rows])
        found.append(_in_air(surface, behind, np.zeros_like(closed)))
    return np.concatenate(found)


def _in_air(surface: WeldedSurface, feet: _Feet, closed: Bools) -> Floats:
    """Return the places over some on a surface that are neither in another body nor near it."""
    free, within = first_hits(surface, feet.points, feet.ways)
    kept = (free > 2.0 * feet.lengths) & ~(within & closed[feet.faces])
    return (feet.points + feet.lengths[:, None] * feet.ways)[kept]


def _over_faces(surface: WeldedSurface, distance: float) -> _Feet:
    """Return places all over the triangles, and beside their corners."""
    points, faces = spread(surface, max(4.0 * distance, surface.size / _COARSE))
    corners = surface.vertices[surface.faces]
    inset = corners + _INSET * (corners.mean(axis=1)[:, None] - corners)
    points = np.concatenate([points, inset.reshape(-1, 3)])
    faces = np.concatenate([faces, np.repeat(np.arange(len(surface.faces)), 3)])
    return _Feet(points, surface.normals[faces], np.full(len(points), distance), faces)


def spread(surface: WeldedSurface, spacing: float) -> tuple[Floats, Indices]:
    """Return places spread evenly over triangles, and the triangle of each.

    Args:
        surface: Any triangles.
        spacing: About how far from each other they are [m]; each triangle has one at least.

    Returns:
        Places [m], shape (n, 3), and rows of triangles, shape (n,).
    """
    counts = np.maximum(1, np.ceil(surface.areas / spacing**2)).astype(np.intp)
    faces, place = _counted(counts)
    u, v = ((place * turn + 0.5) % 1.0 for turn in _TURNS)
    mirrored = u + v > 1.0
    u, v = np.where(mirrored, 1.0 - u, u), np.where(mirrored, 1.0 - v, v)
    inset = np.where(counts[faces] == 1, 1.0, _INSET)  # on edges they would be on hulls, too
    u, v = u + inset * (1.0 / 3.0 - u), v + inset * (1.0 / 3.0 - v)
    a, b, c = (surface.vertices[surface.faces[faces, i]] for i in range(3))
    return a + u[:, None] * (b - a) + v[:, None] * (c - a), faces


def _along_rims(surface: WeldedSurface, distance: float) -> _Feet:
    """Return places beside sharp edges that are bent outwards, and beside open ones.

    Each is level with the face on the other side of the edge, just below its plane: what would
    lie across an opening as a thin lid holds it, though it is far from all others.
    """
    twins = surface.twins
    faces = np.arange(len(twins)) // 3
    bend = np.einsum("ij,ij->i", surface.normals[faces], surface.normals[twins // 3])
    edges = np.flatnonzero((twins < 0) | (bend < _SHARP))
    tails, heads = surface.faces.ravel(), np.roll(surface.faces, -1, axis=1).ravel()
    start, way = surface.vertices[tails[edges]], surface.vertices[heads[edges]]
    way = way - start
    length = np.linalg.norm(way, axis=1)
    ways = way / length[:, None]
    is_open = twins[edges] < 0
    here = surface.normals[faces[edges]]
    level = np.where(is_open[:, None], here, surface.normals[twins[edges] // 3])
    outwards = np.cross(level, ways) * np.where(is_open, -1.0, 1.0)[:, None]
    rise = np.where(is_open, 1.0, np.einsum("ij,ij->i", here, outwards))
    height = 2.0 * surface.areas[faces[edges]] / length
    beside = np.minimum(_BESIDE * distance, _INSET * height)[:, None]
    foot = beside * np.where(is_open[:, None], -here, np.cross(here, ways))
    depth = np.einsum("ij,ij->i", foot, level)[:, None] * level
    reach = distance / np.maximum(rise, _SHARPEST)
    leap = reach[:, None] * outwards + depth - foot
    far = np.linalg.norm(leap, axis=1)
    spacing = max(4.0 * distance, surface.size / _COARSE, float(length.sum()) / _ALONG)
    counts = np.where(rise > 0.0, np.ceil(length / spacing), 0.0).astype(np.intp)
    rows, place = _counted(counts)
    points = (start + foot)[rows] + ((place + 0.5) / counts[rows])[:, None] * way[rows]
    leaps = (leap / np.maximum(far, 1e-300)[:, None])[rows]
    return _Feet(points, leaps, far[rows], faces[edges[rows]])


def _along_notches(surface: WeldedSurface, distance: float) -> _Feet:
    """Return places along edges that are bent inwards, between the planes of both sides."""
    twins, tails = surface.twins, surface.faces.ravel()
    edges = np.flatnonzero(twins > np.arange(len(twins)))
    one, back = edges // 3, twins[edges]
    far = surface.vertices[tails[back - back % 3 + (back + 2) % 3]]
    start = surface.vertices[tails[edges]]
    end = surface.vertices[np.roll(surface.faces, -1, axis=1).ravel()[edges]]
    height = np.einsum("ij,ij->i", far - start, surface.normals[one])
    bent = np.flatnonzero(height > ROUNDING * surface.size)
    start, end, one = start[bent], end[bent], one[bent]
    ways = surface.normals[one] + surface.normals[back[bent] // 3]
    doubled = np.linalg.norm(ways, axis=1)
    ways /= np.maximum(doubled, 1e-300)[:, None]
    lengths = distance / np.maximum(doubled / 2.0, _SHARPEST)
    length = np.linalg.norm(end - start, axis=1)
    spacing = max(2.0 * distance, float(length.sum()) / _ALONG)
    counts = np.ceil(length / spacing).astype(np.intp) + 1
    rows, place = _counted(counts)
    share = np.clip(place / (counts[rows] - 1), _INSET, 1.0 - _INSET)
    points = start[rows] + share[:, None] * (end - start)[rows]
    return _Feet(points, ways[rows], lengths[rows], one[rows])


def _counted(counts: Indices) -> tuple[Indices, Indices]:
    """Return each row as often as its count says, and numbers from 0 within each."""
    rows = np.repeat(np.arange(len(counts)), counts)
    return rows, np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts)
