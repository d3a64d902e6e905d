"""The outline of a robot on the floor, from its collision shapes."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Link,
    Mesh,
    Model,
    Polyline,
    Pose,
    Sphere,
)
from gazelle.formats.mesh import bounds
from gazelle.geometry.polygons import planar_hull

_ROUND = 12
"""Corners in place of a circle."""


def outline_of(model: Model) -> Floats | None:
    """Return the footprint of a robot, in its frame, shape (n, 2) [m]; None without a shape."""
    corners = [
        pose.apply(point)[:2]
        for link, place in links_of(model, Pose())
        for collision in link.collisions
        for pose in (place * collision.pose,)
        for point in _corners(collision)
    ]
    points = np.array(corners, np.float64).reshape(-1, 2)
    if len(points) < 3:
        return None
    found: Floats = points[planar_hull(points)]
    return found if len(found) >= 3 else None


def links_of(model: Model, pose: Pose) -> Iterator[tuple[Link, Pose]]:
    """Yield the links of a model and of nested ones, each with its pose, for a pose of the model."""
    for link in model.links:
        yield link, pose * link.pose
    for inner in model.models:
        yield from links_of(inner, pose * inner.pose)


def _corners(collision: Collision) -> list[tuple[float, float, float]]:
    """Return points whose hull is, or contains, a shape."""
    shape = collision.geometry
    if isinstance(shape, Box):
        return _box(*(side / 2.0 for side in shape.size))
    if isinstance(shape, Sphere):
        return _box(shape.radius, shape.radius, shape.radius)
    if isinstance(shape, Cylinder | Capsule):
        turns = 2.0 * np.pi * np.arange(_ROUND) / _ROUND
        half = shape.length / 2.0 + (shape.radius if isinstance(shape, Capsule) else 0.0)
        return [
            (shape.radius * float(np.cos(turn)), shape.radius * float(np.sin(turn)), z)
            for turn in turns
            for z in (-half, half)
        ]
    if isinstance(shape, Polyline):
        return [(x, y, z) for ring in shape.outlines for x, y in ring for z in (0.0, shape.height)]
    if isinstance(shape, Mesh):
        low, high = bounds(shape)
        (x0, y0, z0), (x1, y1, z1) = low, high
        return list(itertools.product((x0, x1), (y0, y1), (z0, z1)))
    return []


def _box(x: float, y: float, z: float) -> list[tuple[float, float, float]]:
    return list(itertools.product((-x, x), (-y, y), (-z, z)))
