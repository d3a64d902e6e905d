"""Collisions, visuals and sensors of a body, with what ``<gazebo>`` adds to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from gazelle.description import (
    Collision,
    Geometry,
    Light,
    Material,
    Parameters,
    Pose,
    Sensor,
    Visual,
)
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.materials import with_script_colors, with_urdf_color
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.light import read_light
from gazelle.formats.sdf.plugin import read_plugins
from gazelle.formats.sdf.pose import frame_of, read_pose
from gazelle.formats.sdf.sensor import Placer, read_sensor
from gazelle.formats.urdf.applied import LUMP, applied, blob, material, real, surface
from gazelle.formats.urdf.elements import Paint, read_origin, read_paint, shape_if_any
from gazelle.formats.urdf.extensions import Extensions
from gazelle.formats.urdf.tree import LumpedLink, Member
from gazelle.formats.urdf.upright import upright


@dataclass(frozen=True, slots=True)
class PartReader:
    """Context for reading the parts of a robot.

    Attributes:
        extensions: The ``<gazebo>`` elements.
        paints: Materials by name.
        reading: Takes remarks.
        frames: Poses of links and joints in the model.
    """

    extensions: Extensions
    paints: Mapping[str, Paint]
    reading: Reading
    frames: Mapping[str, Pose] = field(default_factory=dict)


def part_names(body: LumpedLink, tag: str) -> list[tuple[Member, Parameters, str, str]]:
    """Return each ``<collision>`` or ``<visual>`` of a body: member, element, name, name unlumped.

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


def read_collisions(body: LumpedLink, robot: PartReader) -> tuple[Collision, ...]:
    """Read all collisions of a body."""
    return tuple(
        _collision(body, member, node, name, shape, robot)
        for member, node, name, _ in part_names(body, "collision")
        if (shape := shape_if_any(node, robot.reading)) is not None
    )


def _collision(
    body: LumpedLink,
    member: Member,
    node: Parameters,
    name: str,
    shape: Geometry,
    robot: PartReader,
) -> Collision:
    elements = applied(body, robot.extensions, "collision", name)
    more = blob(elements, "collision")
    return Collision(
        name=name,
        geometry=shape,
        pose=upright(member.pose * read_origin(node.find("origin"))),
        surface=surface(elements),
        laser_retro=real(elements, "laserRetro", values.real(more, "laser_retro", 0.0)),
        max_contacts=int(real(elements, "maxContacts", values.whole(more, "max_contacts", 10))),
        source=node.source,
    )


def read_visuals(body: LumpedLink, robot: PartReader) -> tuple[Visual, ...]:
    """Read all visuals of a body."""
    return tuple(
        _visual(body, member, node, name, shape, robot)
        for member, node, name, _ in part_names(body, "visual")
        if (shape := shape_if_any(node, robot.reading)) is not None
    )


def _visual(
    body: LumpedLink,
    member: Member,
    node: Parameters,
    name: str,
    shape: Geometry,
    robot: PartReader,
) -> Visual:
    elements = applied(body, robot.extensions, "visual", name)
    more = blob(elements, "visual")
    return Visual(
        name=name,
        geometry=shape,
        pose=upright(member.pose * read_origin(node.find("origin"))),
        material=_material(node, elements, robot),
        transparency=values.real(more, "transparency", 0.0),
        cast_shadows=values.flag(more, "cast_shadows", default=True),
        laser_retro=values.real(more, "laser_retro", 0.0),
        plugins=read_plugins(more),
        source=node.source,
    )


def _material(node: Parameters, elements: list[Parameters], robot: PartReader) -> Material | None:
    """Read a material; ``<gazebo>`` takes precedence over URDF's own colour, as in Gazebo Classic."""
    own = node.find("material")
    paint = Paint()
    if own is not None:
        name = own.attributes.get("name", "")
        paint = robot.paints.get(name) or read_paint(own, robot.reading)
        if name and name not in robot.paints:
            hint = did_you_mean(name, robot.paints)
            robot.reading.note(f"there is no material '{name}'", own, hint)
    found = material(elements, robot.reading)
    if own is None and found is None:
        return None
    found = found or Material()
    found = replace(found, texture=found.texture or paint.texture)
    if paint.color is None or found.ambient is not None or found.diffuse is not None:
        return with_script_colors(found)
    return with_urdf_color(found, paint.color)


def read_sensors(body: LumpedLink, robot: PartReader) -> tuple[Sensor, ...]:
    """Read all sensors of a body, moved to its frame; contact sensors name its collisions."""
    renamed = {plain: name for _, __, name, plain in part_names(body, "collision")}
    sensors = []
    for member in body.members:
        for node in robot.extensions.of(member.link.name):
            if node.tag == "sensor":
                sensor = read_sensor(node, _placer(member, body, robot))
                sensors.append(_renamed(sensor, renamed))
    return tuple(sensors)


def _placer(member: Member, body: LumpedLink, robot: PartReader) -> Placer:
    """Return a function for the pose of a part in the body's frame.

    A pose ``relative_to`` a link or joint is one in that frame; any other is in the link's.
    """

    def place(part: Parameters) -> Pose:
        node = part.find("pose")
        pose, frame = read_pose(node), frame_of(node)
        if node is not None and frame not in {"", member.link.name}:
            if frame in robot.frames:
                return body.pose.inverse() * robot.frames[frame] * pose
            robot.reading.fault(
                f"there is no frame '{frame}' here: that of the link was taken",
                node,
                did_you_mean(frame, robot.frames),
            )
        return pose if member.joint is None else upright(member.pose * pose)

    return place


def _renamed(sensor: Sensor, names: Mapping[str, str]) -> Sensor:
    if sensor.contact is None:
        return sensor
    collisions = tuple(names.get(name, name) for name in sensor.contact.collisions)
    return replace(sensor, contact=replace(sensor.contact, collisions=collisions))


def read_lights(body: LumpedLink, robot: PartReader) -> tuple[Light, ...]:
    """Read the lights of ``<gazebo>`` on a body.

    Those of a lumped link are where they would be on the body itself: libsdformat moves sensors
    and projectors along with such a link, but no light.
    """
    return tuple(
        read_light(node, read_pose(node.find("pose")))
        for member in body.members
        for node in robot.extensions.of(member.link.name)
        if node.tag == "light"
    )
