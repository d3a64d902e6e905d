"""Meshes, outlines and terrain as triangles with normals."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats, Ints32
from gazelle.description import Polyline
from gazelle.geometry.polygons import convex_polygons
from gazelle.geometry.triangles import TriangleMesh, joined, normalized

CREASE = math.cos(math.radians(40.0))
"""Faces of a mesh that meet at less than this angle look as one bent face."""


def polyline(shape: Polyline) -> TriangleMesh:
    """Return prisms on outlines."""
    from gazelle.geometry.patches import prism

    pieces = []
    for corners in convex_polygons(shape.outlines):
        rim = np.column_stack([corners, np.full(len(corners), shape.height)])
        pieces.append(creased(*prism(rim, np.array([0.0, 0.0, shape.height]))))
    return joined(pieces)


def terrain(heights: Floats, size: tuple[float, float]) -> TriangleMesh:
    """Return heights [m] as triangles about the origin, shape (rows along y, columns along x)."""
    rows, columns = heights.shape
    x = np.linspace(-size[0] / 2.0, size[0] / 2.0, columns)
    y = np.linspace(-size[1] / 2.0, size[1] / 2.0, rows)
    grid = np.dstack((*np.meshgrid(x, y), heights))
    along_y, along_x = np.gradient(heights, y, x)
    normals = normalized(np.dstack((-along_x, -along_y, np.ones_like(heights))).reshape(-1, 3))
    number = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    a, b = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    c, d = number[1:, 1:].ravel(), number[1:, :-1].ravel()
    faces = np.stack((a, b, c, a, c, d), axis=1).reshape(-1, 3)
    return TriangleMesh(grid.reshape(-1, 3), normals, faces)


def creased(
    vertices: Floats, faces: Ints32, uv: Floats | None = None, *, crease: float = CREASE
) -> TriangleMesh:
    """Return a mesh with normals: the mean of the faces about a vertex that are nearly level.

    Each corner of a triangle takes the mean over the triangles at its vertex with normals
    within the crease of its own, weighted by their areas. Corners that agree share a vertex.

    Args:
        vertices: [m], shape (n, 3).
        faces: Shape (m, 3).
        uv: Of the corners of each triangle, shape (m, 3, 2), if they are anywhere in a picture.
        crease: Cosine of the greatest angle between faces that look as one.
    """
    weighted = np.cross(
        vertices[faces[:, 1]] - vertices[faces[:, 0]], vertices[faces[:, 2]] - vertices[faces[:, 0]]
    )
    flat = normalized(weighted)
    corner = faces.ravel()  # the vertex of each corner
    owner = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(corner, kind="stable")
    count = np.bincount(corner, minlength=len(vertices))
    first = np.concatenate(([0], np.cumsum(count)))
    normals = np.zeros((len(corner), 3))
    for turn in range(int(count.max(initial=0))):  # the n-th neighbour of every corner
        has = np.flatnonzero(count[corner] > turn)
        other = owner[order[first[corner[has]] + turn]]
        near = (flat[owner[has]] * flat[other]).sum(axis=1) > crease
        normals[has[near]] += weighted[other[near]]
    normals = normalized(
        np.where((normals == 0.0).all(axis=1, keepdims=True), flat[owner], normals)
    )
    places = np.zeros((len(corner), 0)) if uv is None else uv.reshape(-1, 2)
    keys = np.column_stack((corner, np.round(normals * 1e4), places))
    _, kept, renumbered = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return TriangleMesh(
        np.ascontiguousarray(vertices[corner[kept]]),
        np.ascontiguousarray(normals[kept]),
        renumbered.reshape(-1, 3).astype(np.int32),
        two_sided=not _is_closed(vertices, faces),
        uv=None if uv is None else np.ascontiguousarray(places[kept]),
    )


def _is_closed(vertices: Floats, faces: Ints32) -> bool:
    """Return whether a mesh is closed, consistently oriented, and not inside out."""
    _, welded = np.unique(vertices, axis=0, return_inverse=True)
    corners = welded.reshape(-1)[faces].astype(np.int64)
    edges = np.stack((corners, np.roll(corners, -1, axis=1)), axis=-1).reshape(-1, 2)
    edges = edges[edges[:, 0] != edges[:, 1]]
    wide = len(vertices) + 1
    forth = np.sort(edges[:, 0] * wide + edges[:, 1])
    back = np.sort(edges[:, 1] * wide + edges[:, 0])
    if not np.array_equal(forth, back):
        return False
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return float((a * np.cross(b, c)).sum()) > 0.0
