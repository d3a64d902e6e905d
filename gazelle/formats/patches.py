"""The polygons of a surface thickened into convex solids, so that what is hollow stays hollow.

A solid keeps to its polygon and grows from there inwards: where a closed body is behind, by
half of what is there at most; behind a sheet by a skin.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.formats.flat import Polygon, Polygons
from gazelle.formats.mujoco_geometry import first_hits
from gazelle.formats.surface import Surface

FINE = 5e-3
"""How far solids may be off a surface before there are as many as it takes [m]."""
MOST_PATCHES = 20_000
"""Solids from which on they are coarser than that."""

_FEW = 4000
"""Solids up to which they follow the surface exactly."""
_ROUNDING = 1e-6
"""What counts as flat, as a share of the size."""
_FIRST = (5e-4, 2e-3, 5e-3)
"""Tolerances that are tried first [m]."""
_SKIN = (1e-3, 1e-2)
"""Least and greatest thickness of what is open behind [m]."""
_THINNEST = 2e-4
"""Least thickness of anything [m]."""
_DEEPEST = 0.05
"""Thickness up to which a body is filled behind its surface [m]."""
_INSET = 0.02
"""How far from a corner the thickness there is measured, as a share of the way to the middle."""
_MOST_RAYS = 20_000

Solid = tuple[Floats, NDArray[np.int32]]


@dataclass(frozen=True, slots=True)
class Patches:
    """Solids along a surface.

    Attributes:
        solids: Vertices and faces of each.
        gap: How far their outer sides are off the surface at most [m].
    """

    solids: list[Solid]
    gap: float


def joined_flat(surface: Surface) -> Polygons:
    """The convex polygons of a surface that are flat but for rounding."""
    joined = Polygons(surface)
    joined.join(_ROUNDING * surface.size, notches=False)
    return joined


def thick_patches(joined: Polygons, closed: NDArray[np.bool_]) -> Patches:
    """Convex solids along a surface.

    They follow it exactly if ``_FEW`` are enough for that, within ``FINE`` if ``MOST_PATCHES``
    are, else as well as those can.

    Args:
        joined: Its flat polygons, which are joined on.
        closed: Whether each triangle belongs to the surface of a closed body, shape (m,).
    """
    surface, gap = joined.surface, _ROUNDING * joined.surface.size
    for tolerance, most in _tolerances(surface.size):
        if joined.count > most:
            joined.join(tolerance, notches=most > _FEW)
            gap += tolerance
    polygons = joined.polygons()
    depths = _depths(joined, polygons, closed)
    solids = [
        prism(surface.vertices[polygon.rim], depth * np.array(polygon.normal))
        for polygon, depth in zip(polygons, depths.tolist(), strict=True)
        if len(polygon.rim) >= 3  # a sliver has no hull
    ]
    return Patches(solids, gap)


def _tolerances(size: float) -> Iterator[tuple[float, int]]:
    """How far polygons may be off, and how many are needed for that to be allowed."""
    yield from ((tolerance, _FEW) for tolerance in _FIRST if tolerance < 0.01 * size)
    yield from ((FINE * 2.0**power, MOST_PATCHES) for power in range(32))


def _depths(joined: Polygons, polygons: list[Polygon], closed: NDArray[np.bool_]) -> Floats:
    """How thick each solid is [m]."""
    surface = joined.surface
    number = {polygon.face: row for row, polygon in enumerate(polygons)}
    faces = np.arange(0, len(surface.faces), 1 + len(surface.faces) // _MOST_RAYS)
    owners = [np.array([number[joined.owner(face)] for face in faces.tolist()])]
    origins = [surface.vertices[surface.faces[faces]].mean(axis=1)]
    rims = np.concatenate([polygon.rim for polygon in polygons])
    sizes = np.array([len(polygon.rim) for polygon in polygons])
    of_rim = np.repeat(np.arange(len(polygons)), sizes)
    middles = np.stack(
        [np.bincount(of_rim, surface.vertices[rims, axis]) / sizes for axis in range(3)], axis=1
    )
    some = np.arange(0, len(rims), 1 + len(rims) // _MOST_RAYS)
    owners.append(of_rim[some])
    corners = surface.vertices[rims[some]]
    origins.append(corners + _INSET * (middles[owners[1]] - corners))
    rows = np.concatenate(owners)
    inwards = -np.array([polygon.normal for polygon in polygons])[rows]
    distance, leaves = first_hits(surface, np.concatenate(origins), inwards)
    skin = float(np.clip(0.01 * surface.size, *_SKIN))
    body = closed[[polygon.face for polygon in polygons]][rows] & leaves
    room = np.minimum(distance / 2.0, np.where(body, _DEEPEST, skin))
    depths = np.full(len(polygons), _DEEPEST)
    np.minimum.at(depths, rows, room)
    thickness: Floats = np.maximum(depths, min(_THINNEST, skin))
    return thickness


def prism(rim: Floats, thickness: Floats) -> Solid:
    """A convex polygon, shape (n, 3), counter-clockwise from outside, thickened inwards.

    The thickness is a vector that points out of the polygon [m].
    """
    count = len(rim)
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
    return np.concatenate([rim, rim - thickness]), faces
