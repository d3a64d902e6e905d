"""Shapes as triangles, with the normals that make round things look round."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Ints32
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Plane,
    Polyline,
    Sphere,
)
from gazelle.geometry.polygons import convex_polygons

SIDES = 32
"""Of round shapes, about their axis."""

RINGS = 16
"""Of spheres, from pole to pole."""

_WHOLE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
"""A whole picture, on four corners."""

CREASE = math.cos(math.radians(40.0))
"""Faces of a mesh that meet at less than this angle look as one bent face."""


@dataclass(frozen=True, slots=True)
class TriangleMesh:
    """Triangles to be drawn.

    Attributes:
        vertices: [m], shape (n, 3).
        normals: Of the surface at the vertices, of unit length, shape (n, 3).
        faces: Corners of each triangle, counter-clockwise from outside, shape (m, 3).
        two_sided: Whether triangles are seen from behind too.
        uv: Where in a picture the vertices are, to the right and up, shape (n, 2); None for nowhere.
    """

    vertices: Floats
    normals: Floats
    faces: Ints32
    two_sided: bool = False
    uv: Floats | None = None


def box(shape: Box) -> TriangleMesh:
    """Six faces with four corners of their own each."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float64)
    vertices, normals = [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            face = np.empty((4, 3))
            face[:, axis] = side
            # The two other axes in the order that makes the corners go around counter-clockwise.
            first, second = ((axis + 1) % 3, (axis + 2) % 3)[:: int(side)]
            face[:, first], face[:, second] = corners.T
            vertices.append(face)
            normals.append(np.tile(np.eye(3)[axis] * side, (4, 1)))
    return TriangleMesh(
        np.vstack(vertices) * np.asarray(shape.size) / 2.0,
        np.vstack(normals),
        _quads(6),
        uv=np.tile(_WHOLE, (6, 1)),
    )


def sphere(shape: Sphere) -> TriangleMesh:
    """Rings from pole to pole."""
    unit = _ball()
    return _without_lines(TriangleMesh(unit.vertices * shape.radius, unit.normals, unit.faces))


def ellipsoid(shape: Ellipsoid) -> TriangleMesh:
    """A stretched sphere."""
    unit, radii = _ball(), np.asarray(shape.radii)
    normals = _unit(unit.normals / radii)
    return _without_lines(TriangleMesh(unit.vertices * radii, normals, unit.faces))


def capsule(shape: Capsule) -> TriangleMesh:
    """A sphere whose halves are pulled apart."""
    unit = _ball()
    vertices = unit.vertices * shape.radius
    half = len(vertices) // 2
    vertices[:half, 2] += shape.length / 2.0
    vertices[half:, 2] -= shape.length / 2.0
    return _without_lines(TriangleMesh(vertices, unit.normals, unit.faces))


def cylinder(shape: Cylinder) -> TriangleMesh:
    """A round wall and two lids."""
    return _turned(shape.radius, shape.radius, shape.length)


def cone(shape: Cone) -> TriangleMesh:
    """A round wall that ends in a point, and a lid."""
    return _turned(shape.radius, 0.0, shape.length)


def plane(shape: Plane) -> TriangleMesh:
    """A rectangle that is seen from its front."""
    normal = _unit(np.asarray(shape.normal, np.float64)[None])[0]
    turn = _turn_to(normal)
    x, y = (length / 2.0 for length in shape.size)
    flat = np.array([[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]])
    return TriangleMesh(flat @ turn.T, np.tile(normal, (4, 1)), _quads(1), uv=_WHOLE)


def quadrangles(corners: Floats) -> TriangleMesh:
    """Flat faces with four corners each [m], shape (n, 4, 3), the last or the first twice or not.

    The corners go counter-clockwise, seen from where the face is seen.
    """
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals = np.repeat(_unit(across), 4, axis=0)
    vertices = np.ascontiguousarray(corners.reshape(-1, 3))
    return _without_lines(TriangleMesh(vertices, normals, _quads(len(corners))))


def polyline(shape: Polyline) -> TriangleMesh:
    """Prisms on outlines."""
    from gazelle.formats.patches import prism

    pieces = []
    for corners in convex_polygons(shape.outlines):
        rim = np.column_stack([corners, np.full(len(corners), shape.height)])
        pieces.append(creased(*prism(rim, np.array([0.0, 0.0, shape.height]))))
    return joined(pieces)


def terrain(heights: Floats, size: tuple[float, float]) -> TriangleMesh:
    """Heights [m] over a rectangle about the origin, shape (rows along y, columns along x)."""
    rows, columns = heights.shape
    x = np.linspace(-size[0] / 2.0, size[0] / 2.0, columns)
    y = np.linspace(-size[1] / 2.0, size[1] / 2.0, rows)
    grid = np.dstack((*np.meshgrid(x, y), heights))
    along_y, along_x = np.gradient(heights, y, x)
    normals = _unit(np.dstack((-along_x, -along_y, np.ones_like(heights))).reshape(-1, 3))
    number = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)
    a, b = number[:-1, :-1].ravel(), number[:-1, 1:].ravel()
    c, d = number[1:, 1:].ravel(), number[1:, :-1].ravel()
    faces = np.stack((a, b, c, a, c, d), axis=1).reshape(-1, 3)
    return TriangleMesh(grid.reshape(-1, 3), normals, faces)


def creased(
    vertices: Floats, faces: Ints32, uv: Floats | None = None, *, crease: float = CREASE
) -> TriangleMesh:
    """A mesh with normals: the mean of the faces about a vertex that are nearly level.

    Each corner of a triangle takes the mean over the triangles at its vertex whose normals are
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
    flat = _unit(weighted)
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
    normals = _unit(np.where((normals == 0.0).all(axis=1, keepdims=True), flat[owner], normals))
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


def joined(pieces: list[TriangleMesh]) -> TriangleMesh:
    """Several meshes as one."""
    starts = np.cumsum([0, *(len(piece.vertices) for piece in pieces)])
    places = [p.uv if p.uv is not None else np.zeros((len(p.vertices), 2)) for p in pieces]
    nowhere = all(piece.uv is None for piece in pieces)
    return TriangleMesh(
        np.vstack([np.zeros((0, 3)), *(piece.vertices for piece in pieces)]),
        np.vstack([np.zeros((0, 3)), *(piece.normals for piece in pieces)]),
        np.vstack(
            [
                np.zeros((0, 3), np.int32),
                *(p.faces + np.int32(s) for p, s in zip(pieces, starts, strict=False)),
            ]
        ),
        two_sided=any(piece.two_sided for piece in pieces),
        uv=None if nowhere else np.vstack(places),
    )


def _ball() -> TriangleMesh:
    """A sphere of radius 1, its upper half first; its middle ring is there twice."""
    half = RINGS // 2
    angles = np.linspace(0.0, math.pi / 2.0, half + 1)
    tilt = np.concatenate((angles, angles + math.pi / 2.0))
    around = np.linspace(0.0, 2.0 * math.pi, SIDES, endpoint=False)
    flat = np.stack((np.cos(around), np.sin(around)), axis=1)
    points = np.concatenate(
        [np.column_stack((math.sin(t) * flat, np.full(SIDES, math.cos(t)))) for t in tilt]
    )
    points[-SIDES:, :2] = 0.0  # the sine of pi is not
    return TriangleMesh(points, _unit(points), _bands(len(tilt)))


def _turned(below: float, above: float, length: float) -> TriangleMesh:
    """A wall from one radius at the bottom to another at the top, with lids where it is open."""
    around = np.linspace(0.0, 2.0 * math.pi, SIDES, endpoint=False)
    flat = np.stack((np.cos(around), np.sin(around)), axis=1)
    rise = (below - above) / length if length else 0.0
    slope = _unit(np.column_stack((flat, np.full(SIDES, rise))))
    rings = [
        np.column_stack((radius * flat, np.full(SIDES, z)))
        for radius, z in ((above, length / 2.0), (below, -length / 2.0))
    ]
    wall = TriangleMesh(np.vstack(rings), np.vstack((slope, slope)), _bands(2))
    pieces = [_without_lines(wall)]
    fan = np.stack([(0, i, i + 1) for i in range(1, SIDES - 1)]).astype(np.int32)
    for side, radius, ring in ((1.0, above, rings[0]), (-1.0, below, rings[1])):
        if radius:
            normals = np.tile((0.0, 0.0, side), (SIDES, 1))
            pieces.append(TriangleMesh(ring, normals, fan[:, :: int(side)]))
    return joined(pieces)


def _without_lines(mesh: TriangleMesh) -> TriangleMesh:
    """A mesh without the triangles that have two corners in one place."""
    corners = mesh.vertices[mesh.faces]
    thick = (corners != np.roll(corners, -1, axis=1)).any(axis=2).all(axis=1)
    return TriangleMesh(mesh.vertices, mesh.normals, np.ascontiguousarray(mesh.faces[thick]))


def _bands(rings: int) -> Ints32:
    """Triangles between rings of vertices, the upper ones first."""
    number = np.arange(rings * SIDES, dtype=np.int32).reshape(rings, SIDES)
    following = np.roll(number, -1, axis=1)
    a, b = number[:-1].ravel(), number[1:].ravel()
    c, d = following[1:].ravel(), following[:-1].ravel()
    return np.ascontiguousarray(np.stack((a, b, c, a, c, d), axis=1).reshape(-1, 3))


def _quads(count: int) -> Ints32:
    starts = 4 * np.arange(count, dtype=np.int32)[:, None, None]
    two = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    return np.ascontiguousarray((starts + two).reshape(-1, 3))


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


def _turn_to(normal: Floats) -> Floats:
    """The shortest rotation that turns z to a direction, shape (3, 3)."""
    x, y, z = normal
    if z < -1.0 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    cross = np.array([[0.0, 0.0, x], [0.0, 0.0, y], [-x, -y, 0.0]])
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + z))


def _unit(vectors: Floats) -> Floats:
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(lengths == 0.0, 1.0, lengths))
