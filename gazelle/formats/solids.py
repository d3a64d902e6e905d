"""Bodies that described shapes enclose: their volume, centre and inertia."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Geometry,
    Inertia,
    Inertial,
    Mesh,
    Polyline,
    Pose,
    Sphere,
)
from gazelle.formats.mesh import load_mesh
from gazelle.geometry import solids
from gazelle.geometry.patches import prism
from gazelle.geometry.polygons import convex_polygons
from gazelle.geometry.solids import UnitSolid

WATER = 1000.0
"""The density that SDF takes where a file gives none [kg/m³]."""


def solid_of(shape: Geometry) -> UnitSolid | None:
    """Return the body enclosed by a shape; None without volume or of unknown extent.

    Raises:
        FormatError: A mesh cannot be read.
    """
    maker = _MAKERS.get(type(shape))
    if maker is None:
        return None
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            found = maker(shape)
    except OverflowError:  # a size that no number can hold the cube of
        return None
    return found if found is not None and found.is_body() else None


def inertial_of(solid: UnitSolid) -> Inertial:
    """Return mass and inertia of a body with its mass [kg] in place of the volume."""
    x, y, z = solid.center.tolist()
    return Inertial(solid.volume, Pose(x, y, z), Inertia.from_matrix(solid.inertia))


def _mesh(shape: Mesh) -> UnitSolid | None:
    if shape.path is None:
        return None
    data = load_mesh(shape)
    return solids.solid_of_triangles(data.vertices, data.faces)


def _polyline(shape: Polyline) -> UnitSolid | None:
    parts = []
    for corners in convex_polygons(shape.outlines):
        rim = np.column_stack([corners, np.full(len(corners), shape.height)])
        parts.append(solids.solid_of_triangles(*prism(rim, np.array([0.0, 0.0, shape.height]))))
    return solids.joined(parts)


_MAKERS: dict[type, Callable[[Any], UnitSolid | None]] = {
    Box: lambda shape: solids.box(shape.size),
    Capsule: lambda shape: solids.capsule(shape.radius, shape.length),
    Cone: lambda shape: solids.cone(shape.radius, shape.length),
    Cylinder: lambda shape: solids.cylinder(shape.radius, shape.length),
    Ellipsoid: lambda shape: solids.ellipsoid(shape.radii),
    Mesh: _mesh,
    Polyline: _polyline,
    Sphere: lambda shape: solids.ellipsoid((shape.radius,) * 3),
}
