"""``<link>`` of URDF: inertial, visuals and collisions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from gazelle.description import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Geometry,
    Inertial,
    Link,
    Material,
    Mesh,
    Parameters,
    Pose,
    Sphere,
    Visual,
)
from gazelle.errors import FormatError
from gazelle.formats.write.element import angles_of, element, exact_angles, inside, written
from gazelle.formats.write.writing import Writing

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def write_link(link: Link, shift: Pose, writing: Writing, *, massless: bool = False) -> Parameters:
    """A link whose SDF frame is at ``shift`` in its URDF frame."""
    with inside("link", link):
        return element(
            "link",
            None if massless else write_inertial(link.inertial or Inertial(), shift),
            *(_visual(visual, link, shift, writing) for visual in link.visuals),
            *(_collision(collision, link, shift, writing) for collision in link.collisions),
            name=link.name,
        )


def write_origin(pose: Pose) -> Parameters | None:
    """``<origin>``; None for the identity.

    Raises:
        FormatError: The pose is not finite.
    """
    if pose == Pose():
        return None
    try:
        angles = exact_angles(pose) or angles_of(pose)
    except ValueError:
        raise FormatError("a pose must be finite") from None
    return element("origin", xyz=written(pose.position), rpy=written(angles))


def write_inertial(inertial: Inertial, shift: Pose) -> Parameters:
    """``<inertial>``."""
    tensor = {name: written(getattr(inertial.inertia, name)) for name in _MOMENTS}
    return element(
        "inertial",
        write_origin(_moved(shift, inertial.pose)),
        element("mass", value=written(inertial.mass)),
        element("inertia", **tensor),
    )


def part_names(parts: Sequence[Collision | Visual], tag: str) -> list[str]:
    """The name to write for each part, so that reading gives its own again.

    Readers of URDF put ``_collision`` or ``_visual`` behind a name, and from the second
    part of a link on its number too.
    """
    names = []
    for number, part in enumerate(parts):
        ending = f"_{tag}_{number}" if number else f"_{tag}"
        names.append(part.name.removesuffix(ending).removesuffix(f"_{tag}"))
    return names


def _moved(shift: Pose, pose: Pose) -> Pose:
    return pose if shift == Pose() else shift * pose


def _visual(visual: Visual, link: Link, shift: Pose, writing: Writing) -> Parameters | None:
    with inside("visual", visual):
        shape = _geometry(visual.geometry, visual, writing)
        if shape is None:
            return None
        return element(
            "visual",
            write_origin(_moved(shift, visual.pose)),
            shape,
            _material(visual, writing),
            name=part_names(link.visuals, "visual")[link.visuals.index(visual)],
        )


def _collision(
    collision: Collision, link: Link, shift: Pose, writing: Writing
) -> Parameters | None:
    with inside("collision", collision):
        shape = _geometry(collision.geometry, collision, writing)
        if shape is None:
            return None
        return element(
            "collision",
            write_origin(_moved(shift, collision.pose)),
            shape,
            name=part_names(link.collisions, "collision")[link.collisions.index(collision)],
        )


def plain_material(material: Material) -> Material:
    """What of a material URDF's own words can say: one colour and a texture."""
    color = material.diffuse or material.ambient
    return Material(ambient=color, diffuse=color, texture=material.texture)


def _material(visual: Visual, writing: Writing) -> Parameters | None:
    material = visual.material
    if material is None:
        return None
    color = material.diffuse or material.ambient
    texture = material.texture
    return element(
        "material",
        None if color is None else element("color", rgba=written(color)),
        None if texture is None else element("texture", filename=writing.name(texture)),
        name=f"{visual.name}_material",
    )


def _geometry(shape: Geometry, part: Collision | Visual, writing: Writing) -> Parameters | None:
    writer = SHAPES.get(type(shape))
    kind = type(shape).__name__.lower()
    if writer is None:
        writing.note(f"URDF has no shape '{kind}': '{part.name}' is left out", part.source)
        return None
    if isinstance(shape, Mesh) and (shape.submesh or shape.center_submesh):
        writing.note(f"URDF has no parts of meshes: '{part.name}' gets the whole mesh", part.source)
    if isinstance(shape, Capsule):
        writing.note("capsules came with URDF 1.2: many programs do not read them", part.source)
    return element("geometry", writer(shape, writing))


def _mesh(shape: Mesh, writing: Writing) -> Parameters:
    scale = "" if shape.scale == (1.0, 1.0, 1.0) else written(shape.scale)
    return element("mesh", filename=writing.uri(shape.uri, shape.path), scale=scale)


def _round(shape: Cylinder | Capsule, _: Writing) -> Parameters:
    tag = type(shape).__name__.lower()
    return element(tag, radius=written(shape.radius), length=written(shape.length))


SHAPES: dict[type, Callable[[Any, Writing], Parameters]] = {
    Box: lambda shape, _: element("box", size=written(shape.size)),
    Capsule: _round,
    Cylinder: _round,
    Mesh: _mesh,
    Sphere: lambda shape, _: element("sphere", radius=written(shape.radius)),
}
"""One writer a shape."""
