"""Collisions, visuals and sensors of a body, with what ``<gazebo>`` adds to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from gazelle.description import (
    Collision,
    Color,
    Light,
    Material,
    Parameters,
    Sensor,
    Surface,
    Visual,
)
from gazelle.formats import values
from gazelle.formats.materials import script_colors
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.light import read_light
from gazelle.formats.sdf.material import read_material
from gazelle.formats.sdf.pose import read_pose
from gazelle.formats.sdf.sensor import Placer, read_sensor
from gazelle.formats.sdf.surface import read_surface
from gazelle.formats.urdf.elements import Paint, read_geometry, read_origin, read_paint
from gazelle.formats.urdf.extensions import Extensions, text
from gazelle.formats.urdf.tree import Body, Member

LUMP = "_fixed_joint_lump__"


@dataclass(frozen=True, slots=True)
class Robot:
    """What the parts of a robot are read with."""

    extensions: Extensions
    paints: Mapping[str, Paint]
    reading: Reading


def part_names(body: Body, tag: str) -> list[tuple[Member, Parameters, str, str]]:
    """Each ``<collision>`` or ``<visual>`` of a body: member, element, name, name unlumped.

    The names are those that libsdformat gives, which contact sensors refer to.
    """
    found: list[tuple[Member, Parameters, str, str]] = []
    for member in body.members:
        for number, node in enumerate(member.link.node.find_all(tag)):
            base = (node.attributes.get("name", "") or member.link.name) + f"_{tag}"
            plain = f"{base}_{number}" if number else base
            name = f"{base}_{len(found)}" if found else base
            if not name.startswith(body.name):
                name = f"{body.name}{LUMP}{name}"
            found.append((member, node, name, plain))
    return found


def read_collisions(body: Body, robot: Robot) -> tuple[Collision, ...]:
    """All collisions of a body."""
    return tuple(
        _collision(member, node, name, robot)
        for member, node, name, _ in part_names(body, "collision")
        if not _is_nothing(node, robot)
    )


def _is_nothing(node: Parameters, robot: Robot) -> bool:
    """Whether the shape is a box without size, which Gazebo takes and nothing ever touches."""
    box = node.find("geometry/box")
    if box is None:
        return False
    if any(values.parse_reals(box, values.attribute(box, "size"), "attribute 'size'", 3)):
        return False
    robot.reading.note("a box without size is left out", box)
    return True


def _collision(member: Member, node: Parameters, name: str, robot: Robot) -> Collision:
    link = member.link.name
    extensions = robot.extensions
    blob = _blob(extensions, link, "collision")
    return Collision(
        name=name,
        geometry=read_geometry(node, robot.reading),
        pose=member.pose * read_origin(node.find("origin")),
        surface=_surface(extensions, link, blob.find("surface")),
        laser_retro=extensions.real(link, "laserRetro", values.real(blob, "laser_retro", 0.0)),
        max_contacts=int(
            extensions.real(link, "maxContacts", values.whole(blob, "max_contacts", 10))
        ),
        source=node.source,
    )


def _blob(extensions: Extensions, link: str, tag: str) -> Parameters:
    """All SDF that the link's ``<gazebo>`` elements add to each collision or visual."""
    children = [
        inner for child in extensions.of(link) if child.tag == tag for inner in child.children
    ]
    return Parameters(tag, children=tuple(reversed(children)))


def _surface(extensions: Extensions, link: str, blob: Parameters | None) -> Surface:
    surface = read_surface(blob)
    friction, contact = surface.friction, surface.contact
    fdir1 = extensions.last(link, "fdir1")
    x, y, z = friction.fdir1
    if fdir1 is not None and text(fdir1):
        x, y, z = values.parse_reals(fdir1, text(fdir1), "<fdir1>", 3)
    return replace(
        surface,
        friction=replace(
            friction,
            mu=extensions.real(link, "mu1", friction.mu),
            mu2=extensions.real(link, "mu2", friction.mu2),
            fdir1=(x, y, z),
        ),
        contact=replace(
            contact,
            kp=extensions.real(link, "kp", contact.kp),
            kd=extensions.real(link, "kd", contact.kd),
            max_vel=extensions.real(link, "maxVel", contact.max_vel),
            min_depth=extensions.real(link, "minDepth", contact.min_depth),
        ),
    )


def read_visuals(body: Body, robot: Robot) -> tuple[Visual, ...]:
    """All visuals of a body."""
    return tuple(
        _visual(member, node, name, robot)
        for member, node, name, _ in part_names(body, "visual")
        if not _is_nothing(node, robot)
    )


def _visual(member: Member, node: Parameters, name: str, robot: Robot) -> Visual:
    link = member.link.name
    blob = _blob(robot.extensions, link, "visual")
    return Visual(
        name=name,
        geometry=read_geometry(node, robot.reading),
        pose=member.pose * read_origin(node.find("origin")),
        material=_material(node, link, blob, robot),
        transparency=values.real(blob, "transparency", 0.0),
        cast_shadows=values.flag(blob, "cast_shadows", default=True),
        laser_retro=values.real(blob, "laser_retro", 0.0),
        source=node.source,
    )


def _material(node: Parameters, link: str, blob: Parameters, robot: Robot) -> Material | None:
    """What ``<gazebo>`` says goes before the URDF's own colour, as it does in Gazebo."""
    own = node.find("material")
    paint = Paint()
    if own is not None:
        paint = read_paint(own, robot.reading)
        if paint == Paint():
            paint = robot.paints.get(own.attributes.get("name", ""), Paint())
    sdf = blob.find("material")
    if sdf is not None:
        return read_material(sdf, robot.reading)
    script = robot.extensions.last(link, "material")
    name = None if script is None else text(script)
    if own is None and not name:
        return None
    colors: tuple[Color | None, Color | None] = (paint.color, paint.color)
    colors = (script_colors(name) if name else None) or colors
    return Material(
        ambient=colors[0], diffuse=colors[1], script=name or None, texture=paint.texture
    )


def read_sensors(body: Body, robot: Robot) -> tuple[Sensor, ...]:
    """All sensors of a body, moved to its frame; contact sensors name its collisions."""
    renamed = {plain: name for _, __, name, plain in part_names(body, "collision")}
    sensors = []
    for member in body.members:
        for node in robot.extensions.of(member.link.name):
            if node.tag == "sensor":
                sensor = read_sensor(node, _placer(member))
                sensors.append(_renamed(sensor, renamed))
    return tuple(sensors)


def _placer(member: Member) -> Placer:
    return lambda part: member.pose * read_pose(part.find("pose"))


def _renamed(sensor: Sensor, names: Mapping[str, str]) -> Sensor:
    if sensor.contact is None:
        return sensor
    collisions = tuple(names.get(name, name) for name in sensor.contact.collisions)
    return replace(sensor, contact=replace(sensor.contact, collisions=collisions))


def read_lights(body: Body, robot: Robot) -> tuple[Light, ...]:
    """Lights that ``<gazebo>`` puts on a body."""
    return tuple(
        read_light(node, member.pose * read_pose(node.find("pose")))
        for member in body.members
        for node in robot.extensions.of(member.link.name)
        if node.tag == "light"
    )
