"""Solids as triangles, with the normals that make round ones look round."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Ints32

SIDES = 32
"""Corners of round solids about their axis, and twice the rings of a sphere."""

_WHOLE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
"""A whole picture, on four corners."""


@dataclass(frozen=True, slots=True)
class TriangleMesh:
    """Triangles of a surface.

    Attributes:
        vertices: [m], shape (n, 3).
        normals: Of the surface at the vertices, of unit length, shape (n, 3).
        faces: Corners of each triangle, counter-clockwise from outside, shape (m, 3).
        two_sided: Whether triangles are seen from behind too.
        uv: Texture coordinates of the vertices, to the right and up, shape (n, 2); None for none.
    """

    vertices: Floats
    normals: Floats
    faces: Ints32
    two_sided: bool = False
    uv: Floats | None = None


def box(size: Sequence[float]) -> TriangleMesh:
    """Return a box of a size [m]: six faces with four corners of their own each."""
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
        np.vstack(vertices) * np.asarray(size) / 2.0,
        np.vstack(normals),
        _quads(6),
        uv=np.tile(_WHOLE, (6, 1)),
    )


def ellipsoid(radii: Sequence[float], sides: int = SIDES) -> TriangleMesh:
    """Return an ellipsoid of three radii [m]; with three alike it is a sphere."""
    ball, scale = _ball(sides), np.asarray(radii)
    normals = normalized(ball.normals / np.where(scale == 0.0, 1.0, scale))
    return _without_lines(TriangleMesh(ball.vertices * scale, normals, ball.faces))


def capsule(radius: float, length: float, sides: int = SIDES) -> TriangleMesh:
    """Return a cylinder about z [m] between two half balls."""
    ball = _ball(sides)
    vertices = ball.vertices * radius
    half = len(vertices) // 2
    vertices[:half, 2] += length / 2.0
    vertices[half:, 2] -= length / 2.0
    return _without_lines(TriangleMesh(vertices, ball.normals, ball.faces))


def frustum(below: float, above: float, length: float, sides: int = SIDES) -> TriangleMesh:
    """Return a cylinder or cone about z: a wall between two radii, and lids where it is open [m]."""
    around = np.linspace(0.0, 2.0 * math.pi, sides, endpoint=False)
    flat = np.stack((np.cos(around), np.sin(around)), axis=1)
    rise = (below - above) / length if length else 0.0
    slope = normalized(np.column_stack((flat, np.full(sides, rise))))
    rings = [
        np.column_stack((radius * flat, np.full(sides, z)))
        for radius, z in ((above, length / 2.0), (below, -length / 2.0))
    ]
    wall = TriangleMesh(np.vstack(rings), np.vstack((slope, slope)), _bands(2, sides))
    pieces = [_without_lines(wall)]
    fan = np.stack([(0, i, i + 1) for i in range(1, sides - 1)]).astype(np.int32)
    for side, radius, ring in ((1.0, above, rings[0]), (-1.0, below, rings[1])):
        if radius:
            normals = np.tile((0.0, 0.0, side), (sides, 1))
            pieces.append(TriangleMesh(ring, normals, fan[:, :: int(side)]))
    return joined(pieces)


def rectangle(size: Sequence[float], direction: Sequence[float]) -> TriangleMesh:
    """Return a rectangle [m] across a direction, seen from its front."""
    normal = normalized(np.asarray(direction, np.float64)[None])[0]
    turn = _turn_to(normal)
    x, y = (length / 2.0 for length in size)
    flat = np.array([[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]])
    return TriangleMesh(flat @ turn.T, np.tile(normal, (4, 1)), _quads(1), uv=_WHOLE)


def quadrangles(corners: Floats) -> TriangleMesh:
    """Return flat faces with four corners each [m], shape (n, 4, 3), the last or the first twice or not.

    The corners go counter-clockwise, seen from where the face is seen.
    """
    across = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals = np.repeat(normalized(across), 4, axis=0)
    vertices = np.ascontiguousarray(corners.reshape(-1, 3))
    return _without_lines(TriangleMesh(vertices, normals, _quads(len(corners))))


def joined(pieces: list[TriangleMesh]) -> TriangleMesh:
    """Return several meshes as one."""
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


def _ball(sides: int) -> TriangleMesh:
    """Return a sphere of radius 1, its upper half first; its middle ring is there twice."""
    half = sides // 4
    angles = np.linspace(0.0, math.pi / 2.0, half + 1)
    tilt = np.concatenate((angles, angles + math.pi / 2.0))
    around = np.linspace(0.0, 2.0 * math.pi, sides, endpoint=False)
    flat = np.stack((np.cos(around), np.sin(around)), axis=1)
    points = np.concatenate(
        [np.column_stack((math.sin(t) * flat, np.full(sides, math.cos(t)))) for t in tilt]
    )
    points[-sides:, :2] = 0.0  # the sine of pi is not
    return TriangleMesh(points, normalized(points), _bands(len(tilt), sides))


def _without_lines(mesh: TriangleMesh) -> TriangleMesh:
    """Return a mesh without the triangles that have two corners in one place."""
    corners = mesh.vertices[mesh.faces]
    thick = (corners != np.roll(corners, -1, axis=1)).any(axis=2).all(axis=1)
    return TriangleMesh(mesh.vertices, mesh.normals, np.ascontiguousarray(mesh.faces[thick]))


def _bands(rings: int, sides: int) -> Ints32:
    """Return triangles between rings of vertices, the upper ones first."""
    number = np.arange(rings * sides, dtype=np.int32).reshape(rings, sides)
    following = np.roll(number, -1, axis=1)
    a, b = number[:-1].ravel(), number[1:].ravel()
    c, d = following[1:].ravel(), following[:-1].ravel()
    return np.ascontiguousarray(np.stack((a, b, c, a, c, d), axis=1).reshape(-1, 3))


def _quads(count: int) -> Ints32:
    starts = 4 * np.arange(count, dtype=np.int32)[:, None, None]
    two = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    return np.ascontiguousarray((starts + two).reshape(-1, 3))


def _turn_to(normal: Floats) -> Floats:
    """Return the shortest rotation that turns z to a direction, shape (3, 3)."""
    x, y, z = normal
    if z < -1.0 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    cross = np.array([[0.0, 0.0, x], [0.0, 0.0, y], [-x, -y, 0.0]])
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + z))


def normalized(vectors: Floats) -> Floats:
    """Return vectors of length 1 or 0, shape (..., 3)."""
    lengths = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(lengths == 0.0, 1.0, lengths))
