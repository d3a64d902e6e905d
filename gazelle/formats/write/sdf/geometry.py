"""``<geometry>``: one writer a shape, in the table ``SHAPES``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

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
    Parameters,
    Plane,
    Polyline,
    Sphere,
)
from gazelle.formats.extent import lengths
from gazelle.formats.write.element import element, group, leaf
from gazelle.formats.write.writing import Writing


def model_uri(uri: str, path: Path | None, writing: Writing) -> str:
    """Return the URI as SDF has it: ``package://`` becomes ``model://``, as in libsdformat."""
    if uri.startswith("package://"):
        return f"model://{uri.removeprefix('package://')}"
    return writing.uri(uri, path)


def write_geometry(shape: Geometry, writing: Writing) -> Parameters:
    """Write a shape in its ``<geometry>``."""
    return element("geometry", *SHAPES[type(shape)](shape, writing))


def _empty(shape: Empty, _: Writing) -> list[Parameters]:
    return [
        element("box", leaf("size", shape.file_lengths)) if shape.file_lengths else element("empty")
    ]


def _box(shape: Box, _: Writing) -> list[Parameters]:
    return [element("box", leaf("size", lengths(shape)))]


def _sphere(shape: Sphere, _: Writing) -> list[Parameters]:
    return [element("sphere", leaf("radius", *lengths(shape)))]


def _round(shape: Cylinder | Capsule | Cone, _: Writing) -> list[Parameters]:
    tag = type(shape).__name__.lower()
    radius, length = lengths(shape)
    return [element(tag, leaf("radius", radius), leaf("length", length))]


def _ellipsoid(shape: Ellipsoid, _: Writing) -> list[Parameters]:
    return [element("ellipsoid", leaf("radii", lengths(shape)))]


def _plane(shape: Plane, _: Writing) -> list[Parameters]:
    return [element("plane", leaf("normal", shape.normal), leaf("size", shape.size))]


def _mesh(shape: Mesh, writing: Writing) -> list[Parameters]:
    submesh = None
    if shape.submesh is not None or shape.center_submesh:
        submesh = group(
            "submesh", leaf("name", shape.submesh), leaf("center", shape.center_submesh, False)
        )
    return [
        element(
            "mesh",
            leaf("uri", model_uri(shape.uri, shape.path, writing)),
            leaf("scale", shape.scale, (1.0, 1.0, 1.0)),
            submesh,
        )
    ]


def _heightmap(shape: Heightmap, writing: Writing) -> list[Parameters]:
    return [
        element(
            "heightmap",
            leaf("uri", model_uri(shape.uri, shape.path, writing)),
            leaf("size", shape.size),
            leaf("pos", shape.position),
            leaf("sampling", shape.sampling, 1),
            *shape.extras,
        )
    ]


def _image(shape: Image, writing: Writing) -> list[Parameters]:
    return [
        element(
            "image",
            leaf("uri", model_uri(shape.uri, shape.path, writing)),
            leaf("scale", shape.scale),
            leaf("threshold", shape.threshold),
            leaf("height", shape.height),
            leaf("granularity", shape.granularity),
        )
    ]


def _polyline(shape: Polyline, _: Writing) -> list[Parameters]:
    return [
        element(
            "polyline", *(leaf("point", point) for point in outline), leaf("height", shape.height)
        )
        for outline in shape.outlines
    ]


SHAPES: dict[type, Callable[[Any, Writing], list[Parameters]]] = {
    Box: _box,
    Capsule: _round,
    Cone: _round,
    Cylinder: _round,
    Ellipsoid: _ellipsoid,
    Empty: _empty,
    Heightmap: _heightmap,
    Image: _image,
    Mesh: _mesh,
    Plane: _plane,
    Polyline: _polyline,
    Sphere: _sphere,
}
