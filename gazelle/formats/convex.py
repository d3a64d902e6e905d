"""Meshes as convex pieces, for engines that collide only those.

What is convex, or nearly, stays whole. Of the rest, what stands still is followed along its
surface, polygon by polygon, however many that are (``patches``): a building, a bowl or a flight
of stairs is where it looks to be. What moves is cut into few solid blocks, whose hulls fill
little of the air around it (``blocks``). How far the pieces may be off is measured, and told.
"""

from __future__ import annotations

import hashlib
import logging
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.formats import piece_cache
from gazelle.formats.blocks import Blocks, blocks_of
from gazelle.formats.hull import Hull, Solid, convex_hull, hulls_of, spread_directions
from gazelle.formats.mesh import MeshData
from gazelle.formats.patches import joined_flat, thick_patches
from gazelle.formats.surface import WeldedSurface, clean, components

CACHED = 256
PROMISED = 0.01
"""How far pieces of what stands still are off its surface at most [m]."""
SLOW = 0.02
"""Seconds from which on the pieces are kept on disk."""

_LOG = logging.getLogger(__name__)
_LARGE = 100_000
_PATIENCE = 2.0
"""Triangles, and seconds spent on meshes in this process, from which on one is told to wait."""
_DENT = 0.01
_DEEPEST_DENT = 0.01
"""Depth of dents that are filled: a share of the size, a length [m]."""
_SIDES = (0.0125, 0.008)
_LONGEST_SIDE = 0.04
"""Cubes of the grids in which blocks are cut: shares of the size, a length [m]."""
_FEW_BLOCKS = 24
"""Blocks up to which the finer grid is tried."""
_MOST_MOVING = 2000
"""Solids along its surface that what moves may have."""
_FEW_PATCHES = 128
"""Solids up to which what moves is followed along its surface too."""
_REACH = 0.07
"""How far blocks reach beyond the surface at most, as a share of the size."""
_MANY = 32
"""Convex parts of what moves from which on they are not kept apart."""
_ROUNDING = 1e-5
"""What counts as convex where all edges must be, as a share of the size."""
_MOST_CORNERS = 20_000
"""Vertices up to which it is asked whether dents are small."""
_FIRST_LOOK = 256
"""Places that are looked at first."""
_MAX_PAIRS = 2_000_000
_LOOKS = spread_directions(48)
"""Directions whose outermost corners are looked at first."""

_MEMORY: dict[str, ConvexPieces] = {}
_SPENT = {"seconds": 0.0}


@dataclass(frozen=True, slots=True)
class ConvexPieces:
    """Convex pieces that stand for a mesh.

    Attributes:
        solids: Each is its vertices' convex hull.
        whole: Whether the one piece is the mesh itself, nearly convex.
        gap: How far from the mesh a surface of the pieces may be [m]; inwards of a closed
            body, and up to a centimetre behind sheets, does not count.
        promised: What the gap is, unless the mesh is too rough for that [m].
        closed: Whether the mesh has an inside.
    """

    solids: tuple[MeshData, ...]
    whole: bool
    gap: float
    promised: float
    closed: bool


def convex_pieces(mesh: MeshData, *, static: bool = False) -> list[MeshData]:
    """The solids of ``decompose``."""
    return list(decompose(mesh, static=static).solids)


def decompose(mesh: MeshData, *, static: bool) -> ConvexPieces:
    """Convex pieces that together stand for a mesh; one if it is nearly convex.

    The same mesh gives the same pieces. They are kept in memory, and those that took long on
    disk too.

    Args:
        mesh: Any triangles.
        static: Whether it never moves.
    """
    digest = hashlib.blake2b(b"static" if static else b"moves", digest_size=16)
    digest.update(np.ascontiguousarray(mesh.vertices, np.float64).tobytes())
    digest.update(np.ascontiguousarray(mesh.faces, np.int32).tobytes())
    key = digest.hexdigest()
    if key not in _MEMORY:
        while len(_MEMORY) >= CACHED:
            del _MEMORY[next(iter(_MEMORY))]
        _MEMORY[key] = _made(key, mesh, static=static)
    return _MEMORY[key]


def _made(key: str, mesh: MeshData, *, static: bool) -> ConvexPieces:
    """The pieces of a mesh from disk, or cut."""
    stored = piece_cache.load(key)
    if stored is None:
        if len(mesh.faces) > _LARGE or _SPENT["seconds"] > _PATIENCE:
            _LOG.info("cutting a mesh of %d triangles into convex pieces", len(mesh.faces))
        start = time.perf_counter()
        surface = clean(mesh.vertices, mesh.faces)
        closed = surface.is_closed() and surface.volume > 0.0
        stored = (*_cut(surface, static=static), closed)
        spent = time.perf_counter() - start
        _SPENT["seconds"] += spent
        if spent > SLOW:
            piece_cache.store(key, stored)
    solids, whole, gap, closed = stored
    for vertices, faces in solids:
        vertices.setflags(write=False)
        faces.setflags(write=False)
    size = float(np.linalg.norm(np.ptp(mesh.bounds, axis=0)))
    promised = PROMISED if static else _promised(size)
    return ConvexPieces(tuple(MeshData(*solid) for solid in solids), whole, gap, promised, closed)


def _promised(size: float) -> float:
    """How far pieces of a mesh of this size that moves are off its surface at most [m]."""
    return max(PROMISED, _REACH * size)


def _cut(surface: WeldedSurface, *, static: bool) -> tuple[list[Solid], bool, float]:
    """Solids, whether the one is the whole, and how far they are off."""
    if not len(surface.faces):
        return [], False, 0.0
    number = components(surface)
    parts = int(number.max()) + 1
    closed = np.bincount(number, (surface.twins < 0).reshape(-1, 3).any(axis=1)) == 0
    volume = _volumes(surface, number)
    whole = closed & _convex_parts(surface, number)
    if static:
        whole &= volume > 0.0  # what looks inwards all around is a room
        whole[_with_cavities(surface, number, closed & (volume < 0.0))] = False
    dent = min(_DENT * surface.size, _DEEPEST_DENT)
    outwards = bool((volume >= 0.0).all())
    if (parts == 1 and whole[0]) or (closed.all() and outwards and _is_convex(surface, dent)):
        return [(surface.vertices, surface.faces.astype(np.int32))], True, dent
    if not static and int(whole.sum()) > _MANY:
        whole[:] = False  # bolts and the like, that a few blocks hold together
    solids = _solids_of(surface, number, np.flatnonzero(whole))
    rest = ~whole[number]
    if not rest.any():
        return solids, False, _ROUNDING * surface.size
    remains = surface.part(rest)
    along = joined_flat(remains)
    blocks = None if static or along.count <= _FEW_PATCHES else _blocks(remains, along.count)
    if blocks is not None:
        return solids + hulls_of(blocks.hulls), False, blocks.gap
    patches = thick_patches(along, closed[number[rest]])
    return solids + patches.solids, False, patches.gap


def _solids_of(
    surface: WeldedSurface, number: NDArray[np.intp], parts: NDArray[np.intp]
) -> list[Solid]:
    """Some parts of a surface, each as it is."""
    order = np.argsort(number, kind="stable")
    starts = np.searchsorted(number[order], parts)
    ends = np.searchsorted(number[order], parts, side="right")
    rows = [order[i:j] for i, j in zip(starts.tolist(), ends.tolist(), strict=True)]
    return [(part.vertices, part.faces.astype(np.int32)) for part in map(surface.part, rows)]


def _blocks(surface: WeldedSurface, polygons: int) -> Blocks | None:
    """Blocks, on a finer grid if few are enough.

    None if they are farther from the surface than promised, and there is another way: its
    polygons are not too many for what moves.
    """
    found: Blocks | None = None
    patient, promised = polygons > _MOST_MOVING, _promised(surface.size)
    for share in _SIDES:
        finer = blocks_of(surface, min(share * surface.size, _LONGEST_SIDE), patient=patient)
        if finer is None or (finer.gap > promised and (found is not None or not patient)):
            break
        found = finer
        if len(found.hulls) > _FEW_BLOCKS:
            break
    return found


def _volumes(surface: WeldedSurface, number: NDArray[np.intp]) -> Floats:
    """Signed volume within the faces of each part [m³]; negative if they look inwards."""
    corners = surface.vertices[surface.faces] - surface.vertices.mean(axis=0)
    each = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    volumes: Floats = np.bincount(number, each).astype(np.float64)
    return volumes


def _convex_parts(surface: WeldedSurface, number: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether each part is bent one way only along all of its edges.

    A closed surface that is, is convex (Van Heijenoort, "On locally convex manifolds",
    Communications on Pure and Applied Mathematics 5, 1952).
    """
    twins = surface.twins
    edges = np.flatnonzero(twins >= 0)
    here, there = edges // 3, twins[edges]
    far = surface.vertices[surface.faces.ravel()[there - there % 3 + (there + 2) % 3]]
    base = surface.vertices[surface.faces.ravel()[edges]]
    height = np.einsum("ij,ij->i", far - base, surface.normals[here])
    sign = np.where(_volumes(surface, number) < 0.0, -1.0, 1.0)
    bent = height * sign[number[here]] > _ROUNDING * surface.size
    reflex = np.bincount(number[here], bent, minlength=int(number.max()) + 1)
    return np.asarray(reflex == 0)


def _with_cavities(
    surface: WeldedSurface, number: NDArray[np.intp], inwards: NDArray[np.bool_]
) -> NDArray[np.intp]:
    """The parts that have one of those that look inwards inside of them."""
    if not inwards.any():
        return np.zeros(0, np.intp)
    lows, highs = np.full((len(inwards), 3), np.inf), np.full((len(inwards), 3), -np.inf)
    corners = surface.vertices[surface.faces]
    np.minimum.at(lows, number, corners.min(axis=1))
    np.maximum.at(highs, number, corners.max(axis=1))
    around = np.zeros(len(inwards), bool)
    for part in np.flatnonzero(inwards).tolist():
        around |= (lows < lows[part]).all(axis=1) & (highs > highs[part]).all(axis=1)
    return np.flatnonzero(around)


def _is_convex(surface: WeldedSurface, tolerance: float) -> bool:
    """Whether nothing of the surface lies deeper in its hull than this; too much to tell: no."""
    if len(surface.vertices) > _MOST_CORNERS:
        return False
    points = np.concatenate([surface.vertices[surface.faces].mean(axis=1), surface.vertices])
    # what is deep in the hull of a few corners is deeper in that of all, which takes long
    few = surface.vertices[np.unique((_LOOKS @ surface.vertices.T).argmax(axis=1))]
    inner = convex_hull(few)
    if inner is not None and _is_deep(inner, points, tolerance):
        return False
    hull = convex_hull(surface.vertices)
    return hull is not None and not _is_deep(hull, points, tolerance)


def _is_deep(hull: Hull, points: Floats, tolerance: float) -> bool:
    """Whether a point lies deeper in a hull than this."""
    start, rows = 0, _FIRST_LOOK
    while start < len(points):
        if float(hull.depth(points[start : start + rows]).max()) > tolerance:
            return True
        start, rows = start + rows, max(_FIRST_LOOK, _MAX_PAIRS // len(hull.offsets))
    return False
