"""The triangles of any shape of a description."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.array_types import Bytes
from gazelle.description import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Image,
    Mesh,
    Plane,
    Polyline,
    Sphere,
)
from gazelle.geometry import triangles
from gazelle.geometry.triangles import TriangleMesh, joined
from gazelle.rendering.tessellation import creased, polyline, terrain


@dataclass(frozen=True, slots=True)
class ShapePiece:
    """Triangles of one material.

    Attributes:
        mesh: The triangles.
        color: Red, green and blue as the mesh file says; None if it does not.
        texture: The picture on it: a file, or pixels of shape (height, width, 3); None for none.
        alpha: 0 for what cannot be seen to 1.
    """

    mesh: TriangleMesh
    color: tuple[float, float, float] | None = None
    texture: Path | Bytes | None = None
    alpha: float = 1.0


def pieces_of(shape: Geometry) -> tuple[ShapePiece, ...]:
    """Return a shape by looks; one piece unless it is a mesh file of several.

    Raises:
        FormatError: Its file cannot be read.
    """
    if not isinstance(shape, Mesh) or shape.path is None:
        return (ShapePiece(triangles_of(shape)),)
    from gazelle.formats.mesh import load_mesh_parts
    from gazelle.formats.mesh_materials import texture_file

    pieces = []
    for part in load_mesh_parts(shape):
        material = part.material
        texture: Path | Bytes | None = material.pixels
        if material.texture:
            texture = texture_file(shape.path, material.texture)
        mesh = creased(part.vertices, np.ascontiguousarray(part.faces), material.uv)
        pieces.append(ShapePiece(mesh, material.color, texture, material.alpha))
    return tuple(pieces)


def triangles_of(shape: Geometry) -> TriangleMesh:
    """Return triangles with normals; empty for a shape with a missing file.

    Raises:
        FormatError: Its file cannot be read.
    """
    return _READERS[type(shape)](shape)


def _mesh(shape: Mesh) -> TriangleMesh:
    return joined([piece.mesh for piece in pieces_of(shape)]) if shape.path else _nothing(shape)


def _heightmap(shape: Heightmap) -> TriangleMesh:
    if shape.path is None:
        return _nothing(shape)
    from gazelle.formats.terrain import load_heights

    flat = terrain(load_heights(shape), shape.size[:2])
    return TriangleMesh(flat.vertices + shape.position, flat.normals, flat.faces)


def _image(shape: Image) -> TriangleMesh:
    if shape.path is None:
        return _nothing(shape)
    from gazelle.formats.terrain import load_boxes

    pieces = []
    for x, y, width, depth in load_boxes(shape).tolist():
        cube = triangles.box((width, depth, shape.height))
        middle = (x, y, shape.height / 2.0)
        pieces.append(TriangleMesh(cube.vertices + middle, cube.normals, cube.faces))
    return joined(pieces)


def _nothing(_: Geometry) -> TriangleMesh:
    return joined([])


_READERS: dict[type, Callable[[Any], TriangleMesh]] = {
    Box: lambda shape: triangles.box(shape.size),
    Capsule: lambda shape: triangles.capsule(shape.radius, shape.length),
    Cone: lambda shape: triangles.frustum(shape.radius, 0.0, shape.length),
    Cylinder: lambda shape: triangles.frustum(shape.radius, shape.radius, shape.length),
    Ellipsoid: lambda shape: triangles.ellipsoid(shape.radii),
    Empty: _nothing,
    Heightmap: _heightmap,
    Image: _image,
    Mesh: _mesh,
    Plane: lambda shape: triangles.rectangle(shape.size, shape.normal),
    Polyline: polyline,
    Sphere: lambda shape: triangles.ellipsoid((shape.radius,) * 3),
}
