"""``<link>`` with its collisions and visuals."""

from __future__ import annotations

from gazelle.description import Collision, Inertial, Link, Parameters, Pose, Visual
from gazelle.errors import FormatError
from gazelle.formats import values
from gazelle.formats.inertia_repair import is_valid, valid_inertial
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.automatic import automatic_inertial, is_automatic
from gazelle.formats.sdf.duplicates import LINK_PARTS, with_own_names
from gazelle.formats.sdf.frames import Scope
from gazelle.formats.sdf.geometry import read_geometry
from gazelle.formats.sdf.inertial import read_inertial
from gazelle.formats.sdf.leftover import Pattern, leftover
from gazelle.formats.sdf.light import read_light
from gazelle.formats.sdf.material import read_material
from gazelle.formats.sdf.plugin import read_plugins
from gazelle.formats.sdf.pose import frame_of, read_pose
from gazelle.formats.sdf.sensor import Placer, read_sensor
from gazelle.formats.sdf.surface import read_surface

_EXTRAS = (
    "audio_sink", "audio_source", "battery", "must_be_base_link", "particle_emitter", "projector",
)  # fmt: skip
_LOOKS = ("cast_shadows", "laser_retro", "transparency", "visibility_flags")
_VISUAL: Pattern = dict.fromkeys((*_LOOKS, "geometry", "material", "plugin", "pose"))


def read_link(node: Parameters, scope: Scope, reading: Reading, *, static: bool = False) -> Link:
    """Read a link, its pose and those of its parts resolved.

    In a static model an inertia that cannot be is noted and left out: it does not matter.
    """
    node = with_own_names(node, LINK_PARTS, reading)
    name = values.attribute(node, "name")
    place = placer(name, scope)
    self_collide = node.find("self_collide")
    collisions = tuple(
        read_collision(child, place, reading) for child in node.find_all("collision")
    )
    return Link(
        name=name,
        pose=scope.pose(name, node),
        inertial=_inertial(node, collisions, reading, static=static),
        collisions=collisions,
        visuals=tuple(read_visual(child, place, reading) for child in node.find_all("visual")),
        sensors=tuple(read_sensor(child, place) for child in node.find_all("sensor")),
        lights=tuple(read_light(child, place(child)) for child in node.find_all("light")),
        gravity=values.flag(node, "gravity", default=True),
        enable_wind=values.flag(node, "enable_wind", default=False),
        self_collide=None
        if self_collide is None or not self_collide.text
        else values.flag(node, "self_collide", default=False),
        kinematic=values.flag(node, "kinematic", default=False),
        velocity_decay_linear=values.real(node, "velocity_decay/linear", 0.0),
        velocity_decay_angular=values.real(node, "velocity_decay/angular", 0.0),
        extras=tuple(child for child in node.children if child.tag in _EXTRAS),
        source=node.source,
    )


def _inertial(
    link: Parameters, collisions: tuple[Collision, ...], reading: Reading, *, static: bool
) -> Inertial | None:
    node = link.find("inertial")
    try:
        if node is not None and is_automatic(node):
            return automatic_inertial(link, collisions, reading)
        inertial = read_inertial(node)
    except FormatError as error:
        if not static or node is None:
            raise
        reading.note(f"{error.message}; the model is static, so it was ignored", node)
        return None
    if node is None or inertial is None or (static and is_valid(inertial)):
        return inertial
    if static:
        reading.note("no body has this inertial; the model is static, so it was ignored", node)
        return None
    return valid_inertial(inertial, collisions, node, reading)


def placer(link: str, scope: Scope) -> Placer:
    """Return a function for the pose of a link's part in the link's frame."""

    def place(part: Parameters) -> Pose:
        node = part.find("pose")
        frame = frame_of(node)
        pose = read_pose(node)
        if node is None or frame in {"", link}:
            return pose
        return scope.pose(link, part).inverse() * scope.pose(frame, node) * pose

    return place


def read_collision(node: Parameters, place: Placer, reading: Reading) -> Collision:
    """Read ``<collision>``."""
    return Collision(
        name=values.attribute(node, "name"),
        geometry=read_geometry(node.find("geometry"), reading),
        pose=place(node),
        surface=read_surface(node.find("surface")),
        laser_retro=values.real(node, "laser_retro", 0.0),
        max_contacts=values.whole(node, "max_contacts", 10),
        source=node.source,
    )


def read_visual(node: Parameters, place: Placer, reading: Reading) -> Visual:
    """Read ``<visual>``."""
    return Visual(
        name=values.attribute(node, "name"),
        geometry=read_geometry(node.find("geometry"), reading),
        pose=place(node),
        material=read_material(node.find("material"), reading),
        transparency=values.real(node, "transparency", 0.0),
        cast_shadows=values.flag(node, "cast_shadows", default=True),
        laser_retro=values.real(node, "laser_retro", 0.0),
        visibility_flags=values.whole(node, "visibility_flags", 0xFFFFFFFF),
        plugins=read_plugins(node),
        extras=leftover(node, _VISUAL).children,
        source=node.source,
    )
