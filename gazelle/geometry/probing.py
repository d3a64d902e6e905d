"""Places in the air close to a surface, which its convex pieces must not hold.

Every place is at the same distance from the surface. The first air that a growing hull reaches is
that at the bottom of a notch, so there are most of them along edges that are bent inwards.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
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
        faces: The triangle of each, shape (n,).
    """

    points: Floats
    ways: Floats
    faces: Indices


class AirBeside:
    """Places in the air close to a surface.

    Args:
        surface: Any triangles.
        closed: Whether each triangle belongs to a closed body, shape (m,); of other triangles
            there is air on both sides.
        skin: Thickness of what is not closed, behind it [m].
    """

    def __init__(self, surface: WeldedSurface, closed: Bools, skin: float) -> None:
        self._surface, self._closed, self._skin = surface, closed, skin
        corners = surface.vertices[surface.faces]
        inset = corners + _INSET * (corners.mean(axis=1)[:, None] - corners)
        faces = np.repeat(np.arange(len(surface.faces)), 3)
        self._corners = self._cast(_Feet(inset.reshape(-1, 3), surface.normals[faces], faces))
        self._behind_corners = self._cast(self._behind(self._corners.feet))

    def at(self, distance: float) -> Floats:
        """Return places in the air at a distance from the surface [m], shape (n, 3).

        Gaps narrower than twice the distance have none.
        """
        over = _over_faces(self._surface, distance)
        rims, out = _along_rims(self._surface, distance)
        notches, up = _along_notches(self._surface, distance)
        return np.concatenate(
            [
                self._corners.places(distance, self._closed),
                self._behind_corners.places(distance + self._skin, None),
                self._cast(over).places(distance, self._closed),
                self._cast(self._behind(over)).places(distance + self._skin, None),
                self._cast(rims).places(out, self._closed),
                self._cast(notches).places(up, self._closed),
            ]
        )

    def _behind(self, feet: _Feet) -> _Feet:
        """Return places on triangles that are not closed, with the ways behind them."""
        rows = ~self._closed[feet.faces]
        return _Feet(feet.points[rows], -feet.ways[rows], feet.faces[rows])

    def _cast(self, feet: _Feet) -> _Rays:
        """Cast rays from places on the surface along their ways."""
        return _Rays(feet, *self._surface.rays.first_hits(feet.points, feet.ways))


@dataclass(frozen=True, slots=True)
class _Rays:
    """Rays into the air.

    Attributes:
        feet: Their origins and directions.
        free: Distance to what they meet first [m], shape (n,).
        within: Whether they meet it from behind, shape (n,).
    """

    feet: _Feet
    free: Floats
    within: Bools

    def places(self, lengths: Floats | float, closed: Bools | None) -> Floats:
        """Return the places along the rays that are neither in another body nor near it.

        Args:
            lengths: Positions along the rays [m], shape (n,).
            closed: Whether each triangle of the surface belongs to a closed body; None if
                none does.
        """
        kept = self.free > 2.0 * lengths
        if closed is not None:
            kept &= ~(self.within & closed[self.feet.faces])
        along = np.broadcast_to(lengths, len(kept))[kept, None]
        return self.feet.points[kept] + along * self.feet.ways[kept]


def _over_faces(surface: WeldedSurface, distance: float) -> _Feet:
    """Return places all over the triangles."""
    points, faces = spread(surface, max(4.0 * distance, surface.size / _COARSE))
    return _Feet(points, surface.normals[faces], faces)


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


def _along_rims(surface: WeldedSurface, distance: float) -> tuple[_Feet, Floats]:
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
    return _Feet(points, leaps, faces[edges[rows]]), far[rows]


def _along_notches(surface: WeldedSurface, distance: float) -> tuple[_Feet, Floats]:
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
    return _Feet(points, ways[rows], one[rows]), lengths[rows]


def _counted(counts: Indices) -> tuple[Indices, Indices]:
    """Return each row as often as its count says, and numbers from 0 within each."""
    rows = np.repeat(np.arange(len(counts)), counts)
    return rows, np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts)
