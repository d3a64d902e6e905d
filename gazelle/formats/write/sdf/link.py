"""``<link>`` with its collisions, visuals and lights."""

from __future__ import annotations

from gazelle.description import (
    Collision,
    Color,
    Inertial,
    Light,
    Link,
    Material,
    Parameters,
    Visual,
)
from gazelle.errors import FormatError
from gazelle.formats import values
from gazelle.formats.inertia_repair import check_inertia
from gazelle.formats.materials import STANDARD, URDF_COLOR, brightened, script_colors
from gazelle.formats.write.element import (
    element,
    group,
    inside,
    leaf,
    limit,
    overlay,
    pose_leaf,
    written,
)
from gazelle.formats.write.sdf.geometry import write_geometry
from gazelle.formats.write.sdf.plugin import write_plugin
from gazelle.formats.write.sdf.sensor import write_sensor
from gazelle.formats.write.sdf.surface import write_surface
from gazelle.formats.write.writing import Writing

_ALL_FLAGS = 0xFFFFFFFF
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def write_link(link: Link, writing: Writing, *, static: bool = False) -> Parameters:
    """Write a link; a static model's invalid inertia does not matter and is left out."""
    with inside("link", link):
        return element(
            "link",
            pose_leaf(link.pose),
            _inertial(link, writing, static=static),
            leaf("gravity", link.gravity, True),
            leaf("enable_wind", link.enable_wind, False),
            leaf("self_collide", link.self_collide),
            leaf("kinematic", link.kinematic, False),
            group(
                "velocity_decay",
                leaf("linear", link.velocity_decay_linear, 0.0),
                leaf("angular", link.velocity_decay_angular, 0.0),
            ),
            *(write_collision(collision, writing) for collision in link.collisions),
            *(write_visual(visual, writing) for visual in link.visuals),
            *map(write_sensor, link.sensors),
            *map(write_light, link.lights),
            *link.extras,
            name=link.name,
        )


def _inertial(link: Link, writing: Writing, *, static: bool) -> Parameters | None:
    if link.inertial is None:
        return None
    try:
        return write_inertial(link.inertial)
    except FormatError as error:
        if not static:
            raise
        writing.note(f"{error.message}: it is left out", link.inertial.source or link.source)
        return None


def write_inertial(inertial: Inertial) -> Parameters:
    """Write ``<inertial>``, with every number.

    A repaired inertia as in the file, as in libsdformat.

    Raises:
        FormatError: It is that of no body, which readers of SDF refuse.
    """
    place = Parameters("inertial", source=inertial.source)
    values.positive(place, inertial.mass, "the mass")
    check_inertia(inertial.inertia, place)
    tensor = inertial.written or inertial.inertia
    inertia = (leaf(name, getattr(tensor, name)) for name in _MOMENTS)
    return element(
        "inertial",
        pose_leaf(inertial.pose),
        leaf("mass", inertial.mass),
        element("inertia", *inertia),
    )


def write_collision(collision: Collision, writing: Writing) -> Parameters:
    """Write ``<collision>``."""
    with inside("collision", collision):
        return element(
            "collision",
            pose_leaf(collision.pose),
            leaf("laser_retro", collision.laser_retro, 0.0),
            leaf("max_contacts", collision.max_contacts, 10),
            write_geometry(collision.geometry, writing),
            write_surface(collision.surface),
            name=collision.name,
        )


def write_visual(visual: Visual, writing: Writing) -> Parameters:
    """Write ``<visual>``."""
    with inside("visual", visual):
        return element(
            "visual",
            pose_leaf(visual.pose),
            *visual_extras(visual),
            write_geometry(visual.geometry, writing),
            None if visual.material is None else write_material(visual.material, writing),
            *map(write_plugin, visual.plugins),
            name=visual.name,
        )


def visual_extras(visual: Visual) -> tuple[Parameters | None, ...]:
    """Return the elements of a visual besides its pose, shape and material."""
    return (
        leaf("cast_shadows", visual.cast_shadows, True),
        leaf("laser_retro", visual.laser_retro, 0.0),
        leaf("transparency", visual.transparency, 0.0),
        leaf("visibility_flags", visual.visibility_flags, _ALL_FLAGS),
        *visual.extras,
    )


def write_material(material: Material, writing: Writing) -> Parameters:
    """Write ``<material>``; colours of its script are left to it."""
    texture = material.texture
    albedo = None if texture is None else leaf("albedo_map", writing.name(texture))
    ambient, diffuse = _own_colors(material)
    attributes = {}
    if material.urdf_color is not None:
        attributes[URDF_COLOR] = written(material.urdf_color)
    known = element(
        "material",
        leaf("ambient", ambient),
        leaf("diffuse", diffuse),
        leaf("specular", material.specular),
        leaf("emissive", material.emissive),
        group(
            "script",
            *(leaf("uri", uri) for uri in _script_uris(material)),
            leaf("name", material.script),
        ),
        group("pbr", group("metal", albedo)),
        **attributes,
    )
    return overlay(element("material", *material.extras), known) if material.extras else known


def _own_colors(material: Material) -> tuple[Color | None, Color | None]:
    """Return ambient and diffuse colour as written: for a URDF's as in libsdformat."""
    if material.urdf_color is not None:
        bright = brightened(material.urdf_color)
        return (bright, bright)
    known = script_colors(material.script) if material.script else None
    ambient, diffuse = known or (None, None)
    return (
        None if material.ambient == ambient else material.ambient,
        None if material.diffuse == diffuse else material.diffuse,
    )


def _script_uris(material: Material) -> tuple[str, ...]:
    """Return the URIs of the script; libsdformat refuses a script without any."""
    uris = material.script_uris
    return (STANDARD,) if material.script and not uris else uris


def write_light(light: Light) -> Parameters:
    """Write ``<light>`` of a world or a link."""
    with inside("light", light):
        return element(
            "light",
            pose_leaf(light.pose),
            leaf("cast_shadows", light.cast_shadows, False),
            leaf("intensity", light.intensity, 1.0),
            leaf("diffuse", light.diffuse),
            leaf("specular", light.specular),
            leaf("direction", light.direction),
            _attenuation(light),
            _spot(light),
            name=light.name,
            type=light.type,
        )


def _attenuation(light: Light) -> Parameters:
    fades = light.attenuation
    return element(
        "attenuation",
        limit("range", fades.range),
        leaf("constant", fades.constant),
        leaf("linear", fades.linear),
        leaf("quadratic", fades.quadratic),
    )


def _spot(light: Light) -> Parameters | None:
    return group(
        "spot",
        leaf("inner_angle", light.spot_inner_angle, 0.0),
        leaf("outer_angle", light.spot_outer_angle, 0.0),
        leaf("falloff", light.spot_falloff, 0.0),
    )
