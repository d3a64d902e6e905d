"""Small elements of URDF: origin, inertial, geometry, material."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from gazelle.description import (
    Box,
    Capsule,
    Color,
    Cylinder,
    Empty,
    Geometry,
    Inertia,
    Inertial,
    Mesh,
    Parameters,
    Pose,
    Sphere,
)
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats import values
from gazelle.formats.extent import extent, replaced, scale
from gazelle.formats.reading import Reading

_MOMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


def read_origin(node: Parameters | None) -> Pose:
    """Read ``<origin xyz rpy>``; also with a quaternion ``quat_xyzw``, as URDF 1.2 allows."""
    if node is None:
        return Pose()
    x, y, z = values.attribute_vector(node, "xyz", (0.0, 0.0, 0.0))
    quaternion = node.attributes.get("quat_xyzw", "")
    if quaternion:
        numbers = values.parse_reals(node, quaternion, "attribute 'quat_xyzw'", 4)
        pose = Pose.from_quaternion((x, y, z), numbers)
    else:
        pose = Pose(x, y, z, *values.attribute_vector(node, "rpy", (0.0, 0.0, 0.0)))
    if not all(map(math.isfinite, (*pose.position, *pose.quaternion))):
        raise values.fail(node, "an origin must be finite")
    return pose


def read_inertial(node: Parameters | None, reading: Reading) -> Inertial | None:
    """Read ``<inertial>``; a mass of zero is allowed here and means "no body of its own".

    As in libsdformat, a mass or moment of inertia that is missing or not a number is zero.

    Raises:
        FormatError: The mass is negative or not finite.
    """
    if node is None:
        return None
    try:
        mass_node = _required(node, "mass")
        mass = values.attribute_real(mass_node, "value")
    except FormatError as error:
        reading.tolerate(error, "the link has no mass")
        return None
    if not (mass >= 0.0 and math.isfinite(mass)):
        raise values.fail(mass_node, f"the mass must not be negative, found {mass:g}")
    origin = read_origin(node.find("origin"))
    return Inertial(mass, origin, _read_moments(node, reading), node.source)


def _read_moments(node: Parameters, reading: Reading) -> Inertia:
    try:
        inertia = _required(node, "inertia")
    except FormatError as error:
        reading.tolerate(error, "zero was taken")
        return Inertia(0.0, 0.0, 0.0)
    moments, errors = dict.fromkeys(_MOMENTS, 0.0), {}
    for name in _MOMENTS:
        try:
            moments[name] = values.attribute_real(inertia, name)
        except FormatError as error:
            errors[name] = error
    if errors:
        reading.tolerate(next(iter(errors.values())), f"0 was taken for {', '.join(errors)}")
    return Inertia(**moments)


def _required(node: Parameters, tag: str) -> Parameters:
    child = node.find(tag)
    if child is None:
        raise values.fail(node, f"an <{node.tag}> needs <{tag}>")
    return child


_ROUND = TypeVar("_ROUND", Cylinder, Capsule)


def _round(kind: type[_ROUND], node: Parameters, reading: Reading) -> _ROUND:
    radius, length = (values.attribute_real(node, name) for name in ("radius", "length"))
    return kind(
        extent(node, radius, "the radius", reading),
        extent(node, length, "the length", reading),
        file_lengths=replaced(radius, length),
    )


def read_box(node: Parameters, reading: Reading) -> Box | Empty:
    """Read ``<box size>``; one without any size, which stands for a frame, touches nothing."""
    sides = values.parse_reals(node, values.attribute(node, "size"), "attribute 'size'", 3)
    if not any(sides):
        reading.note("a box without size is left out", node)
        return Empty(file_lengths=sides)
    x, y, z = (extent(node, side, "the size of a box", reading) for side in sides)
    return Box((x, y, z), file_lengths=replaced(*sides))


def read_sphere(node: Parameters, reading: Reading) -> Sphere:
    """Read ``<sphere radius>``."""
    radius = values.attribute_real(node, "radius")
    return Sphere(extent(node, radius, "the radius", reading), file_lengths=replaced(radius))


def read_cylinder(node: Parameters, reading: Reading) -> Cylinder:
    """Read ``<cylinder radius length>``."""
    return _round(Cylinder, node, reading)


def read_capsule(node: Parameters, reading: Reading) -> Capsule:
    """Read ``<capsule radius length>``, of URDF 1.2."""
    return _round(Capsule, node, reading)


def read_mesh(node: Parameters, reading: Reading) -> Mesh:
    """Read ``<mesh filename scale>``."""
    uri = values.attribute(node, "filename")
    return Mesh(
        uri=uri,
        path=reading.find(uri, node),
        scale=scale(node, values.attribute_vector(node, "scale", (1.0, 1.0, 1.0)), reading),
        source=node.source,
    )


SHAPES: dict[str, Callable[[Parameters, Reading], Geometry]] = {
    "box": read_box,
    "capsule": read_capsule,
    "cylinder": read_cylinder,
    "mesh": read_mesh,
    "sphere": read_sphere,
}


def read_geometry(node: Parameters, reading: Reading) -> Geometry:
    """Read the shape in the ``<geometry>`` of a collision or visual.

    Raises:
        FormatError: There is none, or an unknown one.
    """
    geometry = node.find("geometry")
    if geometry is None or not geometry.children:
        raise values.fail(geometry or node, f"a <{node.tag}> needs a <geometry> with a shape")
    for child in geometry.children:
        reader = SHAPES.get(child.tag)
        if reader is not None:
            return reader(child, reading)
    shape = geometry.children[0]
    raise values.fail(shape, f"unknown shape <{shape.tag}>", hint=did_you_mean(shape.tag, SHAPES))


def shape_if_any(node: Parameters, reading: Reading) -> Geometry | None:
    """Return the shape; None where it is unreadable: urdfdom reports it, and skips that part."""
    try:
        return read_geometry(node, reading)
    except FormatError as error:
        reading.tolerate(error, f"the <{node.tag}> was left out")
        return None


@dataclass(frozen=True, slots=True)
class Paint:
    """A URDF material: colour and texture, either of which may be missing."""

    color: Color | None = None
    texture: Path | None = None


def read_paint(node: Parameters, reading: Reading) -> Paint:
    """Read ``<material><color rgba><texture filename>``."""
    color = node.find("color")
    texture = node.find("texture")
    rgba = None
    if color is not None and color.attributes.get("rgba"):
        rgba = values.parse_color(color, color.attributes["rgba"])
        if max(rgba) > 1.0:
            written = color.attributes["rgba"]
            text = f"a colour has values from 0 to 1, found '{written}'"
            reading.note(text, color, "divide them by 255")
    return Paint(rgba, None if texture is None else _texture(texture, reading))


def _texture(node: Parameters, reading: Reading) -> Path | None:
    uri = node.attributes.get("filename", "")
    found = reading.find(uri, node, required=False) if uri else None
    if uri and found is None:
        looked = reading.resolver.looked_in(uri, reading.folder)
        reading.note(f"the texture '{uri}' is not found: the colour is used", node, looked)
    return found
