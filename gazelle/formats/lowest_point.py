"""Height of the lowest point of a model's collisions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Mesh,
    Model,
    Polyline,
    Pose,
    Sphere,
)
from gazelle.formats.mesh import load_mesh


def lowest_point(model: Model) -> float:
    """Return the least z of all collisions, in the frame that ``model.pose`` is given in [m].

    Joints are at zero. Planes, terrain and meshes that are not found do not count; the result is
    infinite where nothing does.

    Raises:
        FormatError: A mesh cannot be read.
    """
    return min(_lows(model), default=math.inf)


def _lows(model: Model) -> Iterator[float]:
    for placed in model.walk():
        for link in placed.model.links:
            for collision in link.collisions:
                shape = collision.geometry
                depth = _DEPTHS.get(type(shape))
                if depth is not None and not (isinstance(shape, Mesh) and shape.path is None):
                    pose: Pose = placed.pose * link.pose * collision.pose
                    matrix = pose.matrix()
                    yield float(matrix[2, 3]) - depth(shape, matrix[2, :3])


def _round_depth(radius: float, up: Floats) -> float:
    """Return how far a disc about z reaches down from its centre [m]."""
    return radius * math.hypot(float(up[0]), float(up[1]))


def _cone_depth(shape: Cone, up: Floats) -> float:
    half = 0.5 * shape.length * float(up[2])
    return max(half + _round_depth(shape.radius, up), -half)


def _polyline_depth(shape: Polyline, up: Floats) -> float:
    points = np.array([(*point, 0.0) for outline in shape.outlines for point in outline])
    return float(-(points @ up).min(initial=math.inf)) + max(0.0, -shape.height * float(up[2]))


# How far each shape reaches below its origin, by the world's vertical in its own frame [m].
_DEPTHS: dict[type, Callable[[Any, Floats], float]] = {
    Box: lambda shape, up: float(np.abs(up) @ np.asarray(shape.size)) / 2.0,
    Sphere: lambda shape, _: shape.radius,
    Cylinder: lambda shape, up: (
        0.5 * shape.length * abs(float(up[2])) + _round_depth(shape.radius, up)
    ),
    Capsule: lambda shape, up: 0.5 * shape.length * abs(float(up[2])) + shape.radius,
    Ellipsoid: lambda shape, up: float(np.linalg.norm(up * np.asarray(shape.radii))),
    Cone: _cone_depth,
    Polyline: _polyline_depth,
    Mesh: lambda shape, up: float(-(load_mesh(shape).vertices @ up).min()),
}
