"""Hollow shapes as meshes, and how far convex pieces are off their triangles."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import trimesh

from gazelle.array_types import Bools, Floats
from gazelle.geometry.convex_decomposition import ConvexPieces
from gazelle.geometry.hull import convex_hull
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.probing import spread
from gazelle.geometry.surface import WeldedSurface, clean, components

_WAYS = np.array([[0.577, 0.211, 0.788], [-0.3, 0.9, -0.32], [0.1, -0.5, 0.86]])
_PAIRS = 400_000


def extruded(outline: Floats, height: float) -> trimesh.Trimesh:
    """Return a prism over a polygon, counter-clockwise, shape (n, 2)."""
    count = len(outline)
    caps = ears(outline)
    faces = [(c, b, a) for a, b, c in caps]
    faces += [(a + count, b + count, c + count) for a, b, c in caps]
    for i in range(count):
        j = (i + 1) % count
        faces += [(i, j, j + count), (i, j + count, i + count)]
    low, high = (np.column_stack([outline, np.full(count, z)]) for z in (0.0, height))
    return trimesh.Trimesh(np.concatenate([low, high]), faces, process=False)


def ears(outline: Floats) -> list[tuple[int, int, int]]:
    """Return the triangles of a polygon, counter-clockwise, by clipping its ears."""
    left, found = list(range(len(outline))), []
    while len(left) > 3:
        for place, tip in enumerate(left):
            before, after = left[place - 1], left[(place + 1) % len(left)]
            a, b, c = outline[[before, tip, after]]
            if _turn(a, b, c) <= 0.0:
                continue
            rest = outline[[i for i in left if i not in {before, tip, after}]]
            if not (
                (_turn(a, b, rest) >= 0) & (_turn(b, c, rest) >= 0) & (_turn(c, a, rest) >= 0)
            ).any():
                break
        found.append((before, tip, after))
        left.remove(tip)
    return [*found, (left[0], left[1], left[2])]


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    return (b[0] - a[0]) * (c[..., 1] - a[1]) - (b[1] - a[1]) * (c[..., 0] - a[0])


def arc(x: float, y: float, radius: float, start: float, end: float, count: int) -> Floats:
    """Return places on an arc, shape (count, 2)."""
    angle = np.linspace(start, end, count)
    return np.stack([x + radius * np.cos(angle), y + radius * np.sin(angle)], axis=1)


def car() -> trimesh.Trimesh:
    """Return a body with two wheel arches of 0.36 m."""
    arches = [arc(x, 0.0, 0.36, math.pi, 0.0, 33) for x in (-1.4, 1.4)]
    top = np.array([[2.3, 0.0], [2.3, 0.6], [1.9, 0.9], [-1.9, 0.9], [-2.3, 0.6], [-2.3, 0.0]])
    return extruded(np.concatenate([*arches, top]), 1.9)


def revolved(rim: list[tuple[float, float]] | Floats, sections: int = 48) -> trimesh.Trimesh:
    """Return a body of revolution about z."""
    return trimesh.creation.revolve(np.asarray(rim, float), sections=sections)


def bowl() -> trimesh.Trimesh:
    """Return half a ball of radius 1.05 less one of radius 1."""
    angle = np.linspace(0.0, np.pi / 2.0, 13)
    way = np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    return revolved(np.concatenate([1.05 * way, way[::-1]]))


def mug() -> trimesh.Trimesh:
    """Return a vessel with a thick bottom."""
    return revolved([(0, 0), (0.5, 0), (0.5, 1.2), (0.45, 1.2), (0.45, 0.1), (0, 0.1)])


def gear(teeth: int = 16) -> trimesh.Trimesh:
    """Return a wheel with rounded teeth, which two of the same mesh with."""
    angle = np.linspace(0.0, 2.0 * np.pi, 12 * teeth, endpoint=False)
    radius = 1.0 + 0.08 * np.sin(teeth * angle)
    return extruded(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1), 0.25)


def involute_gear(teeth: int = 20) -> trimesh.Trimesh:
    """Return a spur gear of module 0.1 and a pressure angle of 20 degrees, with a little play.

    The triangles of its caps have corners on one line, as exporters make them.
    """
    pitch, module = teeth * 0.05, 0.1
    base, tip, root = pitch * math.cos(math.radians(20)), pitch + 0.095, pitch - 1.2 * module

    def involute(radius: float) -> float:
        return math.sqrt(max((radius / base) ** 2 - 1.0, 0.0)) - math.acos(min(1.0, base / radius))

    half = 0.97 * math.pi / 2.0 / teeth + involute(pitch)
    radii = np.linspace(max(root, base), tip, 7)
    flank = [(float(r), half - involute(r)) for r in radii]
    flank = [(root, flank[0][1]), *flank] if root < base else flank
    tooth = [(r, -turn) for r, turn in flank] + flank[::-1]
    polar = [(r, turn + 2.0 * math.pi * k / teeth) for k in range(teeth) for r, turn in tooth]
    return extruded(np.array([(r * math.cos(a), r * math.sin(a)) for r, a in polar]), 0.2)


def crate(wall: float = 0.02) -> trimesh.Trimesh:
    """Return an open box of five boxes that touch along edges."""
    inner, at = 1.0 - 2.0 * wall, (1.0 - wall) / 2.0
    parts = [
        trimesh.creation.box((1.0, wall, 0.6)).apply_translation((0.0, y, 0.3)) for y in (-at, at)
    ]
    parts += [
        trimesh.creation.box((wall, inner, 0.6)).apply_translation((x, 0.0, 0.3)) for x in (-at, at)
    ]
    floor = trimesh.creation.box((inner, inner, wall)).apply_translation((0.0, 0.0, wall / 2.0))
    return trimesh.util.concatenate([*parts, floor])


def thin_bowl() -> trimesh.Trimesh:
    """Return half a ball with a wall of a hundredth of its radius."""
    angle = np.linspace(0.0, np.pi / 2.0, 13)
    way = np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    return revolved(np.concatenate([1.01 * way, way[::-1]]))


def spoked_wheel(spokes: int = 5, *, rods: bool = False) -> trimesh.Trimesh:
    """Return a rim, a hub and spokes that reach into both, as bodies that overlap."""
    rim = trimesh.creation.annulus(0.9 if rods else 0.85, 1.0, 0.3, sections=48)
    parts = [rim, trimesh.creation.cylinder(0.25, 0.35, sections=24)]
    lying = trimesh.transformations.rotation_matrix(math.pi / 2.0, [0, 1, 0])
    for turn in np.arange(spokes) * 2.0 * math.pi / spokes:
        spoke = trimesh.creation.box((0.8, 0.12, 0.1))
        if rods:
            spoke = trimesh.creation.cylinder(0.05, 0.8, sections=12, transform=lying)
        spoke.apply_translation((0.52, 0.0, 0.0))
        parts.append(
            spoke.apply_transform(trimesh.transformations.rotation_matrix(turn, [0, 0, 1]))
        )
    return trimesh.util.concatenate(parts)


SHAPES: dict[str, Callable[[], trimesh.Trimesh]] = {
    "car body": car,
    "sleeve": lambda: trimesh.creation.annulus(0.3, 0.4, 0.8, sections=64),
    "bowl": bowl,
    "mug": mug,
    "finger": lambda: extruded(
        np.array([(0, 0), (1, 0), (1, 0.3), (0.62, 0.3), (0.5, 0.18), (0.38, 0.3), (0, 0.3)]), 0.3
    ),
    "torus": lambda: trimesh.creation.torus(1.0, 0.3, major_sections=48, minor_sections=24),
    "gear": gear,
    "bracket": lambda: extruded(
        np.array([(0, 0), (1, 0), (1, 0.1), (0.1, 0.1), (0.1, 1), (0, 1)], float), 0.4
    ),
    "thin bowl": thin_bowl,
    "thin mug": lambda: revolved(
        [(0, 0), (0.5, 0), (0.5, 1.2), (0.49, 1.2), (0.49, 0.01), (0, 0.01)]
    ),
    "thin tube": lambda: trimesh.creation.annulus(0.49, 0.5, 1.5, sections=48),
    "funnel": lambda: revolved(
        [(0.1, 0), (0.15, 0), (0.15, 0.5), (0.8, 1.2), (0.75, 1.2), (0.1, 0.52), (0.1, 0)]
    ),
    "crate": crate,
    "involute gear": involute_gear,
    "spoked wheel": spoked_wheel,
    "wheel of rods": lambda: spoked_wheel(9, rods=True),
}


def made(name: str, size: float) -> MeshData:
    """Return a shape whose box has this diagonal [m]."""
    mesh = SHAPES[name]()
    mesh.apply_translation(-mesh.bounds.mean(axis=0))
    mesh.apply_scale(size / float(np.linalg.norm(mesh.extents)))
    return MeshData(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int32))


def protrusion(data: MeshData, pieces: ConvexPieces, count: int = 4000) -> float:
    """Return how far the pieces of a closed mesh reach beyond its triangles at most [m].

    About ``count`` places on the hulls of the pieces are looked at.
    """
    surface = clean(data.vertices, data.faces)
    hulls = [_surface(piece.vertices) for piece in pieces.solids]
    area = sum(float(hull.areas.sum()) for hull in hulls)
    places = np.concatenate([spread(hull, math.sqrt(area / count))[0] for hull in hulls])
    return float(distances(surface, places[~inside(surface, places)]).max(initial=0.0))


def inside(surface: WeldedSurface, places: Floats) -> Bools:
    """Return a mask of the places inside a mesh whose closed parts may overlap, shape (n,).

    From within two of them the first face that a ray meets may be an outer one, so parts are looked at
    one by one. A cavity takes from the body around it.
    """
    number = components(surface)
    winding = np.zeros(len(places), int)
    for part in (surface.part(number == each) for each in range(number.max() + 1)):
        sign = 1 if part.volume > 0.0 else -1
        outwards = clean(part.vertices, part.faces[:, ::sign])
        behind = sum(
            outwards.rays.first_hits(places, np.tile(way, (len(places), 1)))[1].astype(int)
            for way in _WAYS
        )
        winding += sign * (behind >= 2)
    return winding != 0


def uncovered(data: MeshData, pieces: ConvexPieces, count: int = 2000) -> float:
    """Return how far outside of all pieces a place on the triangles is at most [m]."""
    surface = clean(data.vertices, data.faces)
    places, _ = spread(surface, math.sqrt(float(surface.areas.sum()) / count))
    nearest = np.full(len(places), np.inf)
    for piece in pieces.solids:
        hull = convex_hull(piece.vertices)
        if hull is not None:
            nearest = np.minimum(nearest, -hull.depth(places))
    return max(0.0, float(nearest.max()))


def distances(surface: WeldedSurface, points: Floats) -> Floats:
    """Return the distance of each point from the nearest triangle [m], shape (n,)."""
    rows = max(1, _PAIRS // len(surface.faces))
    parts = [_nearest(surface, points[i : i + rows]) for i in range(0, len(points), rows)]
    return np.concatenate(parts) if parts else np.zeros(0)


def _nearest(surface: WeldedSurface, points: Floats) -> Floats:
    corners = surface.vertices[surface.faces]
    away = points[:, None] - corners[:, 0]
    height = np.einsum("pfj,fj->pf", away, surface.normals)
    inside = np.ones(height.shape, bool)
    best = np.full(height.shape, np.inf)
    for i in range(3):
        start, edge = corners[:, i], corners[:, (i + 1) % 3] - corners[:, i]
        off = points[:, None] - start
        inwards = np.cross(surface.normals, edge)
        inside &= np.einsum("pfj,fj->pf", off, inwards) >= 0.0
        share = np.einsum("pfj,fj->pf", off, edge) / np.einsum("fj,fj->f", edge, edge)
        off = off - np.clip(share, 0.0, 1.0)[..., None] * edge
        best = np.minimum(best, np.einsum("pfj,pfj->pf", off, off))
    return np.where(inside, np.abs(height), np.sqrt(best)).min(axis=1)


def _surface(points: Floats) -> WeldedSurface:
    """Return the hull of points as a surface."""
    hull = convex_hull(points)
    if hull is None:
        raise ValueError("a piece has no hull")
    corners = points[hull.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return WeldedSurface(points, hull.faces, hull.normals, np.linalg.norm(across, axis=1) / 2.0)
