"""Meshes as convex pieces, for engines that collide only those.

What is convex, or nearly, stays whole. Of the rest, what stands still is followed along its
surface, polygon by polygon, however many that are (``patches``): a building, a bowl or a flight
of stairs is where it looks to be. What moves is made of fewer pieces, merged from those within a
bound of half a centimetre or a hundredth of the size (``bounded_pieces``).
"""

from __future__ import annotations

import hashlib
import logging
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.geometry import piece_cache
from gazelle.geometry.bounded_pieces import pieces_within
from gazelle.geometry.hull import Hull, Solid, convex_hull, spread_directions
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.patches import joined_flat, thick_patches
from gazelle.geometry.probing import spread
from gazelle.geometry.surface import (
    WeldedSurface,
    clean,
    closed_parts,
    components,
    turned,
    volumes_of,
)
from gazelle.native.processors import processors

CACHED = 256
PROMISED = 0.01
"""Largest deviation of static models' pieces from their surface [m]."""
MOVING = 0.005
_SHARE = 0.01
"""Largest distance of the pieces of a moving mesh from its surface: a length [m], and a share of its size."""
SLOW = 0.02
"""Seconds from which on the pieces are kept on disk."""

_LOG = logging.getLogger(__name__)
_LARGE = 10_000
"""Triangles of meshes above which a log line announces a wait."""
_EVERY = 2.0
"""Least time between lines that report how far that is [s]."""
_DENT = 0.01
_DEEPEST_DENT = 0.01
"""Depth of dents that are filled: a share of the size, a length [m]."""
_SMALLEST = 1e-6
"""Size of a mesh below which it has no area for engines [m]."""
_ROUNDING = 1e-5
"""Tolerance of convexity where all edges must be convex, as a share of the size."""
_MOST_CORNERS = 100_000
"""Vertices up to which small dents are looked for."""
_FIRST_LOOK = 256
"""Places that are looked at first."""
_LOOKS_ALONG = 60.0
"""Sample places on a hull along its size, to measure the depth of the surface below."""
_MAX_PAIRS = 2_000_000
_LOOKS = spread_directions(48)
"""Directions of the outermost corners that are checked first."""

_MEMORY: dict[str, ConvexPieces] = {}


@dataclass(frozen=True, slots=True)
class ConvexPieces:
    """Convex pieces that stand for a mesh.

    Attributes:
        solids: Each is its vertices' convex hull.
        whole: Whether the one piece is the mesh itself, nearly convex.
        gap: Largest distance of surfaces of the pieces from the mesh [m]; inwards of a closed
            body, and up to a centimetre behind sheets, does not count.
        promised: Gap, unless the mesh is too rough for it [m].
        closed: Whether the mesh has an inside.
    """

    solids: tuple[MeshData, ...]
    whole: bool
    gap: float
    promised: float
    closed: bool


def decompose(mesh: MeshData, *, static: bool) -> ConvexPieces:
    """Return convex pieces that together approximate a mesh; one if it is nearly convex.

    The same mesh gives the same pieces. They are kept in memory, and those that took long on
    disk too.

    Args:
        mesh: Any triangles.
        static: Whether it never moves.
    """
    return decompose_all([(mesh, static)])[0]


def decompose_all(meshes: Sequence[tuple[MeshData, bool]]) -> list[ConvexPieces]:
    """Return the pieces of several meshes, as ``decompose`` does, computed by all processors.

    Args:
        meshes: Each with a flag: whether it never moves.
    """
    keys = [_key_of(mesh, static) for mesh, static in meshes]
    wanted = dict(zip(keys, meshes, strict=True))
    found = {key: _MEMORY[key] for key in wanted if key in _MEMORY}
    for key in wanted.keys() - found.keys():
        stored = piece_cache.load(key)
        if stored is not None:
            found[key] = _pieces(stored, *wanted[key])
    found |= _cut_all({key: each for key, each in wanted.items() if key not in found})
    _MEMORY.update(found)
    for key in list(_MEMORY)[:-CACHED]:
        del _MEMORY[key]
    return [found[key] for key in keys]


def _key_of(mesh: MeshData, static: bool) -> str:  # noqa: FBT001
    digest = hashlib.blake2b(b"static" if static else b"moves", digest_size=16)
    digest.update(np.ascontiguousarray(mesh.vertices, np.float64).tobytes())
    digest.update(np.ascontiguousarray(mesh.faces, np.int32).tobytes())
    return digest.hexdigest()


def _cut_all(meshes: Mapping[str, tuple[MeshData, bool]]) -> dict[str, ConvexPieces]:
    """Return the pieces of meshes, by key, and report how far that is."""
    triangles = sum(len(mesh.faces) for mesh, _ in meshes.values())
    if triangles > _LARGE:
        text = "cutting meshes of %d triangles into convex pieces: 0 of %d"
        _LOG.info(text, triangles, len(meshes))
    found, said = {}, time.perf_counter()
    # The largest first, or the last one would keep the others waiting.
    keys = sorted(meshes, key=lambda key: len(meshes[key][0].faces), reverse=True)
    with ThreadPoolExecutor(processors()) as pool:
        tasks = {pool.submit(_cut_one, key, *meshes[key]): key for key in keys}
        try:
            for task in as_completed(tasks):
                found[tasks[task]] = task.result()
                if time.perf_counter() - said > _EVERY:
                    said = time.perf_counter()
                    _LOG.info(
                        "cutting meshes into convex pieces: %d of %d", len(found), len(meshes)
                    )
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    return found


def _cut_one(key: str, mesh: MeshData, static: bool) -> ConvexPieces:  # noqa: FBT001
    """Return the pieces of a mesh, and store what took long."""
    start = time.perf_counter()
    surface = clean(mesh.vertices, mesh.faces)
    closed = surface.is_closed() and surface.volume > 0.0
    cut = (*_cut(surface, static=static), closed)
    if time.perf_counter() - start > SLOW:
        piece_cache.store(key, cut)
    return _pieces(cut, mesh, static)


def _pieces(cut: piece_cache.Stored, mesh: MeshData, static: bool) -> ConvexPieces:  # noqa: FBT001
    solids, whole, gap, closed = cut
    for vertices, faces in solids:
        vertices.setflags(write=False)
        faces.setflags(write=False)
    size = float(np.linalg.norm(np.ptp(mesh.bounds, axis=0)))
    promised = min(PROMISED, _SHARE * size) if static else _bound(size)
    return ConvexPieces(tuple(MeshData(*solid) for solid in solids), whole, gap, promised, closed)


def _bound(size: float) -> float:
    """Return how far pieces of a mesh of this size that moves are off its surface at most [m]."""
    return min(_SHARE * size, MOVING)


def _cut(surface: WeldedSurface, *, static: bool) -> tuple[list[Solid], bool, float]:
    """Return solids, whether there is one for the whole, and their deviation."""
    if not len(surface.faces) or surface.size < _SMALLEST:
        return [], False, 0.0
    number = components(surface)
    closed = closed_parts(surface, number)
    volume = volumes_of(surface, number)
    cavities, around = _cavities(surface, number, closed & (volume < 0.0))
    if not static:  # what looks inwards and moves is no room
        inverted = closed & (volume < 0.0) & ~cavities
        surface, volume = turned(surface, inverted[number]), np.where(inverted, -volume, volume)
    whole = closed & _convex_parts(surface, number) & (volume > 0.0) & ~around
    dent = min(_DENT * surface.size, _DEEPEST_DENT if static else MOVING)
    outwards = bool((volume >= 0.0).all())
    if whole.all() and len(whole) == 1:
        return [(surface.vertices, surface.faces.astype(np.int32))], True, 0.0
    if closed.all() and outwards and _is_convex(surface, dent):
        return [(surface.vertices, surface.faces.astype(np.int32))], True, dent
    if not static:
        solids, gap = pieces_within(surface, number, closed, whole, _bound(surface.size))
        return solids, False, gap
    solids = _solids_of(surface, number, np.flatnonzero(whole))
    rest = ~whole[number]
    if not rest.any():
        return solids, False, _ROUNDING * surface.size
    patches = thick_patches(joined_flat(surface.part(rest)), closed[number[rest]])
    return solids + patches.solids, False, patches.gap


def _solids_of(
    surface: WeldedSurface, number: NDArray[np.intp], parts: NDArray[np.intp]
) -> list[Solid]:
    """Return some parts of a surface as solids."""
    order = np.argsort(number, kind="stable")
    starts = np.searchsorted(number[order], parts)
    ends = np.searchsorted(number[order], parts, side="right")
    rows = [order[i:j] for i, j in zip(starts.tolist(), ends.tolist(), strict=True)]
    return [(part.vertices, part.faces.astype(np.int32)) for part in map(surface.part, rows)]


def _convex_parts(surface: WeldedSurface, number: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Return a mask of the parts with all edges bent the same way.

    A closed surface that is, is convex (Van Heijenoort, "On locally convex manifolds",
    Communications on Pure and Applied Mathematics 5, 1952).
    """
    twins = surface.twins
    edges = np.flatnonzero(twins >= 0)
    here, there = edges // 3, twins[edges]
    far = surface.vertices[surface.faces.ravel()[there - there % 3 + (there + 2) % 3]]
    base = surface.vertices[surface.faces.ravel()[edges]]
    height = np.einsum("ij,ij->i", far - base, surface.normals[here])
    sign = np.where(volumes_of(surface, number) < 0.0, -1.0, 1.0)
    bent = height * sign[number[here]] > _ROUNDING * surface.size
    reflex = np.bincount(number[here], bent, minlength=int(number.max()) + 1)
    return np.asarray(reflex == 0)


def _cavities(
    surface: WeldedSurface, number: NDArray[np.intp], inwards: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which parts that look inwards lie within others, and which parts are around those."""
    within, around = np.zeros(len(inwards), bool), np.zeros(len(inwards), bool)
    if not inwards.any():
        return within, around
    lows, highs = np.full((len(inwards), 3), np.inf), np.full((len(inwards), 3), -np.inf)
    corners = surface.vertices[surface.faces]
    np.minimum.at(lows, number, corners.min(axis=1))
    np.maximum.at(highs, number, corners.max(axis=1))
    for part in np.flatnonzero(inwards).tolist():
        outer = (lows < lows[part]).all(axis=1) & (highs > highs[part]).all(axis=1)
        within[part] = outer.any()
        around |= outer
    return within, around


def _is_convex(surface: WeldedSurface, tolerance: float) -> bool:
    """Return whether the surface is nowhere deeper in its hull than this; no if too large to test."""
    if len(surface.vertices) > _MOST_CORNERS:
        return False
    _, first = np.unique(surface.faces, return_index=True)
    points = np.concatenate([surface.vertices[surface.faces].mean(axis=1), surface.vertices])
    normals = np.concatenate([surface.normals, surface.normals[first // 3]])
    # what is deep in the hull of a few corners is deeper in that of all, which takes long
    few = surface.vertices[np.unique((_LOOKS @ surface.vertices.T).argmax(axis=1))]
    inner = convex_hull(few)
    if inner is not None and _is_deep(inner, points, tolerance):
        return False
    hull = convex_hull(surface.vertices)
    if hull is None:
        return False
    if len(points) * len(hull.offsets) > _MAX_PAIRS:  # most lie right below the hull
        above = _below(surface, hull, points, normals)
        points = points[(above > tolerance) & np.isfinite(above)]
    return not _is_deep(hull, points, tolerance) and not _spans(surface, hull, tolerance)


def _spans(surface: WeldedSurface, hull: Hull, tolerance: float) -> bool:
    """Return whether the hull of a surface lies higher above it than this somewhere.

    In a vessel with thin walls no place of the surface is deep in the hull.
    """
    places, rows = spread(_hull_surface(surface, hull), surface.size / _LOOKS_ALONG)
    ways = hull.normals[rows]
    below, _ = surface.rays.first_hits(places + tolerance * ways, -ways)
    return bool((below > 2.01 * tolerance).any())


def _hull_surface(surface: WeldedSurface, hull: Hull) -> WeldedSurface:
    """Return the hull of a surface as a surface."""
    corners = surface.vertices[hull.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(across, axis=1) / 2.0
    return WeldedSurface(surface.vertices, hull.faces, hull.normals, areas)


def _below(surface: WeldedSurface, hull: Hull, points: Floats, ways: Floats) -> Floats:
    """Return how far the hull of a surface is from points along ways [m]; infinite if on it."""
    return _hull_surface(surface, hull).rays.first_hits(points, ways)[0]


def _is_deep(hull: Hull, points: Floats, tolerance: float) -> bool:
    """Return whether a point lies deeper in a hull than this."""
    start, rows = 0, _FIRST_LOOK
    while start < len(points):
        if float(hull.depth(points[start : start + rows]).max()) > tolerance:
            return True
        start, rows = start + rows, max(_FIRST_LOOK, _MAX_PAIRS // len(hull.offsets))
    return False
