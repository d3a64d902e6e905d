"""Meshes as convex pieces, for engines that collide only those.

What hangs together and is convex, or nearly, stays whole. The rest is cut up: by CoACD
(Wei, Liu, Ling, Su, "Approximate convex decomposition for 3D meshes with collision-aware
concavity and tree search", ACM Transactions on Graphics 41, 2022) where the package
``coacd`` is installed and the mesh is closed, else along its surface. No piece fills what
is hollow by more than a hundredth of the mesh's size, at most a centimetre.
"""

from __future__ import annotations

import hashlib
import time
from functools import lru_cache

import numpy as np

from gazelle.formats import piece_cache
from gazelle.formats.coacd import decompose, method
from gazelle.formats.hull import Hull, convex_hull
from gazelle.formats.mesh import MeshData
from gazelle.formats.patches import Solid, thick_patches
from gazelle.formats.surface import Floats, Indices, Surface, clean, components

CACHED = 256
SLOW = 0.2
"""Seconds from which on the pieces are kept on disk."""

_DENT = 0.01
_DEEPEST_DENT = 0.01
"""Depth of dents that are filled: a share of the size, and a length [m]."""
_OPEN = 0.01
"""Share of the hull's surface that may be open."""
_MANY = 64
"""Loose parts from which on the mesh is first tried as a whole."""
_MAX_PAIRS = 20_000_000


def convex_pieces(mesh: MeshData) -> list[MeshData]:
    """Convex pieces that together fill what the mesh fills; one if it is nearly convex.

    Each piece is its vertices' convex hull. The same mesh gives the same pieces. They are
    kept in memory, and those that took long on disk too.
    """
    digest = hashlib.blake2b(method().encode(), digest_size=16)
    digest.update(np.ascontiguousarray(mesh.vertices, np.float64).tobytes())
    digest.update(np.ascontiguousarray(mesh.faces, np.int32).tobytes())
    return list(_cached(digest.hexdigest(), _Mesh(mesh)))


class _Mesh:
    """A mesh that the cache tells apart by its digest alone."""

    def __init__(self, data: MeshData) -> None:
        self.data: MeshData | None = data

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Mesh)

    def __hash__(self) -> int:
        return 0


@lru_cache(maxsize=CACHED)
def _cached(digest: str, mesh: _Mesh) -> tuple[MeshData, ...]:
    data, mesh.data = mesh.data, None  # the cache keeps the key, and need not keep the mesh
    stored = piece_cache.load(digest)
    if stored is not None or data is None:
        return tuple(MeshData(*solid) for solid in stored or ())
    start = time.perf_counter()
    solids = _pieces(data)
    if time.perf_counter() - start > SLOW:
        piece_cache.store(digest, solids)
    for vertices, faces in solids:
        vertices.setflags(write=False)
        faces.setflags(write=False)
    return tuple(MeshData(*solid) for solid in solids)


def _pieces(mesh: MeshData) -> list[Solid]:
    surface = clean(mesh.vertices, mesh.faces)
    if not len(surface.faces):
        return []
    groups = components(surface)
    if len(groups) > _MANY and _is_convex(surface):
        return [_whole(surface)]
    parts = [surface.part(rows) for rows in groups]
    hollow = _cavities(parts)
    solids: list[Solid] = []
    rest: list[Indices] = []
    for rows, part, nested in zip(groups, parts, hollow, strict=True):
        pieces = None if nested else _solid_pieces(part)
        if pieces is None:
            rest.append(rows)
        else:
            solids += pieces
    if rest:
        solids += thick_patches(surface.part(np.concatenate(rest)))
    return solids


def _solid_pieces(part: Surface) -> list[Solid] | None:
    """The part whole if it is nearly convex, else cut up if that can be done."""
    if _is_convex(part):
        return [_whole(part)]
    return decompose(part) if part.is_closed() else None


def _whole(surface: Surface) -> Solid:
    return surface.vertices, surface.faces.astype(np.int32)


def _cavities(parts: list[Surface]) -> list[bool]:
    """Whether each part is the wall of a cavity inside another, or has one inside.

    The wall of a cavity is closed and looks inwards.
    """
    lows = np.array([part.vertices.min(axis=0) for part in parts])
    highs = np.array([part.vertices.max(axis=0) for part in parts])
    found = [False] * len(parts)
    for i, part in enumerate(parts):
        around = (lows < lows[i]).all(axis=1) & (highs > highs[i]).all(axis=1)
        if around.any() and part.volume < 0.0 and part.is_closed():
            found[i] = True
            for j in np.flatnonzero(around):
                found[j] = True
    return found


def _is_convex(surface: Surface) -> bool:
    """Whether the surface follows its hull, and covers it, but for small dents."""
    tolerance = min(_DENT * surface.size, _DEEPEST_DENT)
    hull = convex_hull(surface.vertices, 0.05 * tolerance)
    if hull is None:
        return False
    triangles = surface.vertices[surface.faces]
    middles = (triangles + np.roll(triangles, 1, axis=1)).reshape(-1, 3) / 2.0
    points = np.concatenate([surface.vertices, triangles.mean(axis=1), middles])
    rows = max(1, _MAX_PAIRS // len(hull.offsets))
    for start in range(0, len(points), rows):
        if float(hull.depth(points[start : start + rows]).max()) > tolerance:
            return False
    return _covers(surface, hull, tolerance)


def _covers(surface: Surface, hull: Hull, tolerance: float) -> bool:
    """Whether faces lie along nearly all of the hull."""
    if surface.is_closed():
        return True
    corners = surface.vertices[hull.faces]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(sides, axis=1) / 2.0
    if len(areas) * len(surface.faces) > _MAX_PAIRS:
        return float(surface.areas.sum()) >= (1.0 - _OPEN) * float(areas.sum())
    return _uncovered(surface, hull, areas, tolerance) <= _OPEN * float(areas.sum())


def _uncovered(surface: Surface, hull: Hull, areas: Floats, tolerance: float) -> float:
    """Area of the hull's sides, each as a whole, that no faces lie along [m²]."""
    heights = hull.normals @ surface.vertices.T - hull.offsets[:, None]
    near = (np.abs(heights) <= tolerance)[:, surface.faces].all(axis=2)
    along = near @ surface.areas
    lacking = 0.0
    left = np.ones(len(areas), bool)
    for side in range(len(areas)):
        if not left[side]:
            continue
        same = left & (hull.normals @ hull.normals[side] > 1.0 - 1e-6)
        same &= np.abs(hull.offsets - hull.offsets[side]) <= tolerance
        left &= ~same
        lacking += max(0.0, float(areas[same].sum() - along[side]))
    return lacking
