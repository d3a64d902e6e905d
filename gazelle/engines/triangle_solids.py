"""Shapes of descriptions as triangles, so that they can be cut level wherever they lean."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats, Ints64
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Mesh,
    Pose,
    Sphere,
)

Solid = tuple[Floats, Ints64]

_SIDES = 64  # of what is round

_BOX = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_BOX_FACES = np.array(
    [
        (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
        (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
    ]
)  # fmt: skip


def solid_of(shape: Geometry, pose: Pose) -> Solid | None:
    """Vertices (n, 3) at a pose and faces (m, 3), counter-clockwise from outside; or None.

    Raises:
        FormatError: A mesh cannot be read.
    """
    make = _MAKERS.get(type(shape))
    if make is None or (isinstance(shape, Mesh) and shape.path is None):
        return None
    vertices, faces = make(shape)
    matrix = pose.matrix()
    return vertices @ matrix[:3, :3].T + matrix[:3, 3], faces


def cut(solid: Solid, height: float) -> Floats:
    """Segments where a solid meets a level plane, solid on their left, shape (n, 4)."""
    vertices, faces = solid
    corners = vertices[faces]
    above = corners[:, :, 2] > height
    # The corner that is alone on its side comes first.
    count = above.sum(axis=1)
    cut_ones = np.flatnonzero((count == 1) | (count == 2))
    alone = np.where(count[cut_ones] == 1, above[cut_ones].argmax(1), above[cut_ones].argmin(1))
    turned = (alone[:, None] + np.arange(3)) % 3
    a, b, c = np.moveaxis(np.take_along_axis(corners[cut_ones], turned[:, :, None], axis=1), 1, 0)
    start, end = _between(a, b, height), _between(a, c, height)
    # Seen from outside, the edge to the next corner is on the left of a corner above the plane.
    flip = count[cut_ones] == 1
    first, last = np.where(flip[:, None], start, end), np.where(flip[:, None], end, start)
    lines = np.hstack((first, last))
    long = np.abs(lines[:, :2] - lines[:, 2:]).max(axis=1) > 0.0
    return np.asarray(lines[long])


def _between(a: Floats, b: Floats, height: float) -> Floats:
    share = (height - a[:, 2]) / (b[:, 2] - a[:, 2])
    return np.asarray(a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2]))


def _box(shape: Box) -> Solid:
    return _BOX * np.asarray(shape.size), _BOX_FACES


def _turned(profile: list[tuple[float, float]]) -> Solid:
    """The solid that a profile of radii and heights, from below up, makes around z."""
    angles = np.arange(_SIDES) * (2.0 * np.pi / _SIDES)
    ring = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    rows = [np.column_stack((r * ring, np.full(_SIDES, z))) for r, z in profile]
    low, high = (0.0, 0.0, profile[0][1]), (0.0, 0.0, profile[-1][1])
    here = np.arange(_SIDES)
    after = (here + 1) % _SIDES
    bottom, top = len(profile) * _SIDES, len(profile) * _SIDES + 1
    faces = [np.stack((np.full(_SIDES, bottom), after, here), 1)]
    for level in range(len(profile) - 1):
        base = level * _SIDES
        faces.append(np.stack((here, after, after + _SIDES), 1) + base)
        faces.append(np.stack((here, after + _SIDES, here + _SIDES), 1) + base)
    base = (len(profile) - 1) * _SIDES
    faces.append(np.stack((here + base, after + base, np.full(_SIDES, top)), 1))
    return np.vstack((*rows, low, high)), np.vstack(faces)


def _cylinder(shape: Cylinder) -> Solid:
    half = shape.length / 2.0
    return _turned([(shape.radius, -half), (shape.radius, half)])


def _cone(shape: Cone) -> Solid:
    half = shape.length / 2.0
    return _turned([(shape.radius, -half), (1e-9 * shape.radius, half)])


def _ball(radius: float, stretch: float = 0.0) -> Solid:
    half = stretch / 2.0
    angles = np.linspace(-np.pi / 2.0, np.pi / 2.0, _SIDES // 2 + 2)[1:-1]
    low = [(radius * np.cos(a), radius * np.sin(a) - half) for a in angles if a < 0.0]
    high = [(radius * np.cos(a), radius * np.sin(a) + half) for a in angles if a >= 0.0]
    solid = _turned([*low, (radius, -half), (radius, half), *high])
    solid[0][-2, 2], solid[0][-1, 2] = -half - radius, half + radius
    return solid


def _ellipsoid(shape: Ellipsoid) -> Solid:
    vertices, faces = _ball(1.0)
    return vertices * np.asarray(shape.radii), faces


def _mesh(shape: Mesh) -> Solid:
    from gazelle.formats.mesh import load_mesh

    data = load_mesh(shape)
    return data.vertices, data.faces.astype(np.int64)


_MAKERS: dict[type, Callable[[Any], Solid]] = {
    Box: _box,
    Capsule: lambda shape: _ball(shape.radius, shape.length),
    Cone: _cone,
    Cylinder: _cylinder,
    Ellipsoid: _ellipsoid,
    Mesh: _mesh,
    Sphere: lambda shape: _ball(shape.radius),
}
