"""A surface as nearly flat, nearly convex patches, each thickened into a convex solid.

The solids follow the surface, so that what is hollow stays hollow. They grow inwards, by
half the thickness of the body there at most.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.formats.hull import convex_hull, planar_area, planar_hull
from gazelle.formats.surface import Floats, Indices, Surface, first_hits

MAX_PATCHES = 128

_FINEST = 0.002
_COARSEST = 0.05
"""Deviation from flat and convex that is allowed, as shares of the mesh's size."""
_SKIN = (0.001, 0.01)
"""Least and greatest thickness of a sheet that nothing is behind [m]."""
_DEEPEST = 0.05
"""Thickness up to which a solid is filled behind its surface [m]."""
_COSINE = 0.8
"""Of the angle that a face may make with the one its patch began with."""
_MAX_RAYS = 10_000_000
"""Pairs of ray and triangle for the thickness of all patches together."""

Solid = tuple[Floats, NDArray[np.int32]]


def thick_patches(surface: Surface) -> list[Solid]:
    """Vertices and faces of convex solids along a surface, ``MAX_PATCHES`` at most.

    The tolerance grows until there are few enough; of too many still, the largest are kept.
    """
    share = _FINEST
    patches = _patches(surface, share * surface.size)
    while len(patches) > MAX_PATCHES and share < _COARSEST:
        share *= 2.0
        patches = _patches(surface, share * surface.size)
    if len(patches) > MAX_PATCHES:
        patches.sort(key=lambda patch: -patch.area)
        patches = patches[:MAX_PATCHES]
    depths = _depths(surface, patches)
    return [_solid(surface, patch, depth) for patch, depth in zip(patches, depths, strict=True)]


@dataclass(slots=True)
class _Patch:
    """Faces that make one piece.

    Attributes:
        rows: Of the faces.
        normal: Of the plane that they are near to.
        area: Of the faces, seen along the normal [m²].
        corners: Vertices on the rim of the hull, counter-clockwise.
    """

    rows: list[int]
    normal: Floats
    area: float
    corners: Indices


def _patches(surface: Surface, tolerance: float) -> list[_Patch]:
    found: list[_Patch] = []
    for region in _flat_regions(surface, tolerance):
        found.extend(_convex_parts(surface, region, tolerance))
    return found


@dataclass(slots=True)
class _Region:
    """Connected faces near one plane.

    Attributes:
        rows: Of the faces, in the order in which they were reached.
        normal: Of the plane.
        links: Neighbours among them by face.
    """

    rows: list[int]
    normal: Floats
    links: dict[int, list[int]] = field(default_factory=dict)


def _neighbours(surface: Surface) -> list[list[int]]:
    """The faces that share an edge with each face."""
    edges = surface.edges().reshape(-1, 2)
    keys = edges[:, 0] * np.int64(len(surface.vertices)) + edges[:, 1]
    order = np.argsort(keys, kind="stable")
    groups = np.split(order // 3, np.flatnonzero(np.diff(keys[order])) + 1)
    found: list[list[int]] = [[] for _ in range(len(surface.faces))]
    for group in groups:
        faces = group.tolist()
        for face in faces:
            found[face].extend(other for other in faces if other != face)
    return found


def _flat_regions(surface: Surface, tolerance: float) -> list[_Region]:
    """All faces in regions that grow from the largest face left, as far as they stay flat."""
    neighbours = _neighbours(surface)
    taken = np.zeros(len(surface.faces), bool)
    regions = []
    for seed in np.argsort(-surface.areas, kind="stable").tolist():
        if taken[seed]:
            continue
        normal = surface.normals[seed]
        heights = (surface.vertices - surface.vertices[surface.faces[seed, 0]]) @ normal
        region = _Region([seed], normal)
        taken[seed] = True
        for row in region.rows:
            own = [other for other in neighbours[row] if not taken[other]]
            for other in own:
                flat = bool((np.abs(heights[surface.faces[other]]) <= tolerance).all())
                if flat and float(surface.normals[other] @ normal) >= _COSINE and not taken[other]:
                    taken[other] = True
                    region.rows.append(other)
        inside = set(region.rows)
        region.links = {r: [n for n in neighbours[r] if n in inside] for r in region.rows}
        regions.append(region)
    return regions


def _convex_parts(surface: Surface, region: _Region, tolerance: float) -> list[_Patch]:
    """A region cut into parts that fill their hulls in the plane."""
    flat = surface.vertices @ _plane(region.normal).T
    areas = surface.areas * np.abs(surface.normals @ region.normal)
    used = np.unique(surface.faces[region.rows])
    corners = used[planar_hull(flat[used])]
    whole = _Patch(region.rows, region.normal, float(areas[region.rows].sum()), corners)
    if _fills(whole, flat, tolerance):
        return [whole]
    left = dict.fromkeys(region.rows)
    parts = []
    while left:
        parts.append(_grown(surface, region, flat, areas, left, tolerance))
    return parts


def _grown(
    surface: Surface,
    region: _Region,
    flat: Floats,
    areas: Floats,
    left: dict[int, None],
    tolerance: float,
) -> _Patch:
    """The first face left, with neighbours as long as the part stays convex."""
    seed = next(iter(left))
    del left[seed]
    patch = _Patch([seed], region.normal, float(areas[seed]), _rim(surface.faces[seed], flat))
    grew = True
    while grew:
        grew = False
        near = dict.fromkeys(n for row in patch.rows for n in region.links[row] if n in left)
        for other in near:
            points = np.union1d(patch.corners, surface.faces[other])
            area = patch.area + float(areas[other])
            larger = _Patch([*patch.rows, other], patch.normal, area, _rim(points, flat))
            if _fills(larger, flat, tolerance):
                patch, grew = larger, True
                del left[other]
    return patch


def _rim(rows: Indices, flat: Floats) -> Indices:
    return rows[planar_hull(flat[rows])]


def _fills(patch: _Patch, flat: Floats, tolerance: float) -> bool:
    """Whether the patch's hull in the plane covers little that its faces do not."""
    covered = planar_area(flat[patch.corners])
    return covered - patch.area <= 0.01 * covered + 4.0 * tolerance * tolerance


def _plane(normal: Floats) -> Floats:
    """Two unit vectors across the normal, shape (2, 3), right-handed with it."""
    axis = np.zeros(3)
    axis[int(np.abs(normal).argmin())] = 1.0
    first = np.cross(axis, normal)
    first /= np.linalg.norm(first)
    return np.stack([first, np.cross(normal, first)])


def _depths(surface: Surface, patches: list[_Patch]) -> Floats:
    """How thick each solid may be [m]: half the way to what is behind, sheets a skin."""
    skin = float(np.clip(0.01 * surface.size, *_SKIN))
    rays = _MAX_RAYS // max(1, len(surface.faces) * len(patches))
    if rays < 4:
        return np.full(len(patches), skin)
    origins, directions, owners = [], [], []
    for number, patch in enumerate(patches):
        rows = patch.rows[:: max(1, -(-4 * len(patch.rows) // min(rays, 32)))]
        triangles = surface.vertices[surface.faces[rows]]
        centres = triangles.mean(axis=1)
        samples = np.concatenate(
            [centres, *(0.9 * triangles[:, i] + 0.1 * centres for i in range(3))]
        )
        origins.append(samples)
        directions.append(np.broadcast_to(-patch.normal, samples.shape))
        owners.append(np.full(len(samples), number))
    hits = first_hits(surface, np.concatenate(origins), np.concatenate(directions))
    nearest = np.full(len(patches), np.inf)
    np.minimum.at(nearest, np.concatenate(owners), hits)
    return np.where(np.isfinite(nearest), np.minimum(nearest / 2.0, _DEEPEST), skin)


def _solid(surface: Surface, patch: _Patch, depth: float) -> Solid:
    """The hull of a patch and of the same patch moved inwards."""
    outside = surface.vertices[np.unique(surface.faces[patch.rows])]
    points = np.concatenate([outside, outside - patch.normal * depth])
    flat = float(np.ptp(outside @ patch.normal)) <= 1e-6 * surface.size
    hull = None if flat else convex_hull(points, 1e-5 * surface.size)
    if hull is None:
        return prism(surface.vertices[patch.corners], patch.normal * depth)
    rows, inverse = np.unique(hull.faces, return_inverse=True)
    return points[rows], inverse.reshape(-1, 3).astype(np.int32)


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
