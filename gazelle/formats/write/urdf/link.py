"""``<link>`` of URDF: inertial, visuals and collisions."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.description import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Empty,
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
from gazelle.formats.extent import lengths
from gazelle.formats.urdf.applied import LUMP
from gazelle.formats.write.element import angles_of, element, exact_angles, inside, written
from gazelle.formats.write.writing import Writing

_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def write_link(link: Link, shift: Pose, writing: Writing, *, massless: bool = False) -> Parameters:
    """Write a link whose SDF frame is at ``shift`` in its URDF frame.

    Of its collisions only those of the first surface are in it: see ``surfaces``.
    """
    with inside("link", link):
        parts: tuple[Collision | Visual, ...] = (*link.visuals, *link.collisions)
        for part in parts:
            _note_lost(part, writing)
        return element(
            "link",
            None if massless else write_inertial(link.inertial or Inertial(), shift),
            *(_visual(visual, shift, writing) for visual in visuals_of(link)),
            *write_collisions(link, 0, shift, writing),
            name=link.name,
        )


def write_collisions(link: Link, group: int, shift: Pose, writing: Writing) -> list[Parameters]:
    """Write the collisions of a link that have one surface."""
    return [
        _collision(collision, collision_name(collision, link, group), shift, writing)
        for each in surfaces(link)[group : group + 1]
        for collision in each
    ]


def visuals_of(link: Link) -> list[Visual]:
    """Return the visuals whose shapes URDF has."""
    return [visual for visual in link.visuals if _has_words(visual.geometry)]


def _has_words(shape: Geometry) -> bool:
    """Return whether URDF can express the shape."""
    return bool(shape.file_lengths) if isinstance(shape, Empty) else type(shape) in SHAPES


def surfaces(link: Link) -> list[list[Collision]]:
    """Return the collisions whose shapes URDF has, by surface; URDF has one a link.

    So those of each further one go to a link of their own, that readers lump into this one.
    """
    found: list[tuple[tuple[object, ...], list[Collision]]] = []
    for collision in link.collisions:
        if not _has_words(collision.geometry):
            continue
        terms = _terms(collision)
        group = next((group for known, group in found if known == terms), None)
        if group is None:
            found.append((terms, [collision]))
        else:
            group.append(collision)
    return [group for _, group in found]


def surface_link(link: Link, group: int) -> str:
    """Return the name of the link for the collisions of a further surface.

    It does not begin as the link does: by that libsdformat knows what is lumped.
    """
    name = f"surface_{group:02}_of_{link.name}"
    return f"contact_{name}" if name.startswith(link.name) else name


def plain_name(part: Collision | Visual, tag: str) -> str:
    """Return the name without the suffix of URDF readers: the tag, and perhaps a number."""
    return re.sub(rf"_{tag}(_\d+)?$", "", part.name)


def collision_name(collision: Collision, link: Link, group: int) -> str:
    """Return the name by which readers find the surface in the ``<gazebo>`` of its link.

    libsdformat takes a collision whose name does not begin as its link's for a lumped one, and
    gives it the surface of a link only if it is called after that.
    """
    if group:
        return surface_link(link, group)
    name = plain_name(collision, "collision")
    if not any(map(_has_surface, link.collisions)):
        return name
    own = name.removeprefix(f"{link.name}{LUMP}")
    return own if own.startswith(link.name) else f"{link.name}_{own}"


def _has_surface(collision: Collision) -> bool:
    usual = Collision(collision.name, collision.geometry)
    return _terms(collision) != _terms(usual)


def _terms(collision: Collision) -> tuple[object, ...]:
    return (collision.surface, collision.laser_retro, collision.max_contacts)


def read_names(link: Link) -> dict[str, str]:
    """Return the name that readers will give each collision of a link."""
    ordered = [(c, group) for group, each in enumerate(surfaces(link)) for c in each]
    names = {}
    for number, (part, group) in enumerate(ordered):
        name = collision_name(part, link, group)
        read = f"{name}_collision" + (f"_{number}" if number else "")
        own = read.startswith(link.name)
        names[part.name] = read if own else f"{link.name}{LUMP}{read}"
    return names


def write_origin(pose: Pose) -> Parameters | None:
    """Write ``<origin>``; None for the identity.

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
    """Write ``<inertial>``."""
    tensor = {name: written(getattr(inertial.inertia, name)) for name in _MOMENTS}
    return element(
        "inertial",
        write_origin(moved(shift, inertial.pose)),
        element("mass", value=written(inertial.mass)),
        element("inertia", **tensor),
    )


def moved(shift: Pose, pose: Pose) -> Pose:
    """Return a pose in the frame of a link that is shifted."""
    return pose if shift == Pose() else shift * pose


def _visual(visual: Visual, shift: Pose, writing: Writing) -> Parameters:
    with inside("visual", visual):
        return element(
            "visual",
            write_origin(moved(shift, visual.pose)),
            _geometry(visual.geometry, writing),
            _material(visual, writing),
            name=plain_name(visual, "visual"),
        )


def _collision(collision: Collision, name: str, shift: Pose, writing: Writing) -> Parameters:
    with inside("collision", collision):
        return element(
            "collision",
            write_origin(moved(shift, collision.pose)),
            _geometry(collision.geometry, writing),
            name=name,
        )


def plain_material(material: Material) -> Material:
    """Return the part of a material that URDF can express: one colour and a texture."""
    color = material.urdf_color or material.diffuse or material.ambient
    return Material(ambient=color, diffuse=color, texture=material.texture)


def _material(visual: Visual, writing: Writing) -> Parameters | None:
    material = visual.material
    if material is None:
        return None
    color = material.urdf_color or material.diffuse or material.ambient
    texture = material.texture
    return element(
        "material",
        None if color is None else element("color", rgba=written(color)),
        None if texture is None else element("texture", filename=writing.name(texture)),
        name=f"{visual.name}_material",
    )


def _note_lost(part: Collision | Visual, writing: Writing) -> None:
    shape = part.geometry
    if not _has_words(shape):
        kind = type(shape).__name__.lower()
        writing.note(f"URDF has no shape '{kind}': '{part.name}' is left out", part.source)
    if isinstance(shape, Mesh) and (shape.submesh or shape.center_submesh):
        writing.note(f"URDF has no parts of meshes: '{part.name}' gets the whole mesh", part.source)
    if isinstance(shape, Capsule):
        writing.note("capsules came with URDF 1.2: many programs do not read them", part.source)


def _geometry(shape: Geometry, writing: Writing) -> Parameters:
    return element("geometry", SHAPES[type(shape)](shape, writing))


def _mesh(shape: Mesh, writing: Writing) -> Parameters:
    scale = "" if shape.scale == (1.0, 1.0, 1.0) else written(shape.scale)
    return element("mesh", filename=package_uri(shape.uri, shape.path, writing), scale=scale)


def package_uri(uri: str, path: Path | None, writing: Writing) -> str:
    """Return the URI for programs that read URDF: ``model://`` of a package as ``package://``."""
    package, _, _ = uri.removeprefix("model://").partition("/")
    if uri.startswith("model://") and path is not None:
        for folder in path.parents:
            if folder.name == package and (folder / "package.xml").is_file():
                return f"package://{uri.removeprefix('model://')}"
    return writing.uri(uri, path)


def _round(shape: Cylinder | Capsule, _: Writing) -> Parameters:
    tag = type(shape).__name__.lower()
    radius, length = map(written, lengths(shape))
    return element(tag, radius=radius, length=length)


SHAPES: dict[type, Callable[[Any, Writing], Parameters]] = {
    Box: lambda shape, _: element("box", size=written(lengths(shape))),
    Capsule: _round,
    Cylinder: _round,
    Empty: lambda shape, _: element("box", size=written(shape.file_lengths)),
    Mesh: _mesh,
    Sphere: lambda shape, _: element("sphere", radius=written(*lengths(shape))),
}
"""One writer a shape."""
