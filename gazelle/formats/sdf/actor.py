"""``<actor>``: a model that follows a script, without the play of its limbs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from gazelle.description import Parameters, Pose
from gazelle.formats import values
from gazelle.formats.sdf.build import made, pose_element
from gazelle.formats.sdf.own import PREFIX
from gazelle.formats.sdf.pose import read_pose

PLUGIN = "libgazelle_scripted_motion.so"
ACTOR = f"{PREFIX}:actor"
"""The actor itself, in the model that is made of it."""


# A person, where only the skin is known: height and radius, and where the hip is [m].
_HEIGHT, _RADIUS, _HIP = 1.8, 0.25, 1.0
# This plugin moves actors by their hip, whose y points up.
_ACTOR_PLUGIN = "ActorPlugin"


def as_model(node: Parameters) -> Parameters:
    """Return the static ``<model>`` of an actor, moved by Gazelle's plugin of scripted motion.

    It has the actor's own links; one of a skin has a link that shows the skin. It collides
    with nothing, as in Gazebo, but lidars see it: links without collisions get those of their
    visuals, a skin that of a person, which push nothing.
    """
    pose = node.find("pose")
    children = [made("static", "true", like=node)]
    if pose is not None:
        children.append(pose)
    kept = [child for child in node.children if child.tag in {"link", "joint", "plugin"}]
    if not any(child.tag == "link" for child in kept):
        kept.insert(0, _body(node))
    kept = [_seen(child) if child.tag == "link" else child for child in kept]
    script = _script(node)
    children += kept if script is None else [*kept, script]
    unplaced = replace(node, children=tuple(each for each in node.children if each is not pose))
    children.append(made(ACTOR, "", unplaced, like=node))
    name = values.attribute(node, "name")
    return made("model", "", *children, like=node, attributes={"name": name})


def _body(node: Parameters) -> Parameters:
    """Return a link that shows the actor's skin, if it has one."""
    skin = node.find("skin")
    file = "" if skin is None else values.word(skin, "filename")
    if skin is None or not file:
        return made("link", like=node, attributes={"name": "body"})
    factor = values.real(skin, "scale", 1.0)
    uri = made("uri", file, like=skin.find("filename") or skin)
    size = made("scale", " ".join([repr(factor)] * 3), like=skin)
    shape = made("geometry", "", made("mesh", "", uri, size, like=skin), like=skin)
    stance = _stance(node, factor)
    visual = made(
        "visual", "", pose_element(stance, skin), shape, like=skin, attributes={"name": "skin"}
    )
    height = _HEIGHT * factor
    sizes = {"radius": _RADIUS * factor, "length": height}
    person = (made(tag, repr(size), like=skin) for tag, size in sizes.items())
    cylinder = made("geometry", "", made("cylinder", "", *person, like=skin), like=skin)
    ghost = _ghost("skin", pose_element(stance * Pose(z=height / 2.0), skin), cylinder)
    return made("link", "", visual, ghost, like=node, attributes={"name": "body"})


def _is_plugin_driven(node: Parameters) -> bool:
    """Return whether a plugin drives the actor, which then follows no script."""
    files = (plugin.attributes.get("filename", "") for plugin in node.find_all("plugin"))
    return any(_ACTOR_PLUGIN in file for file in files)


def _stance(node: Parameters, factor: float) -> Pose:
    """Return the pose of the feet in the moving frame."""
    if _is_plugin_driven(node):
        return Pose(y=-_HIP * factor, roll=-math.pi / 2.0)
    return Pose()


def _seen(link: Parameters) -> Parameters:
    """Return a link with a shape that lidars see, if it shows anything."""
    if link.find("collision") is not None:
        return link
    ghosts = [
        _ghost(visual.attributes.get("name", ""), visual.find("pose"), shape)
        for visual in link.find_all("visual")
        if (shape := visual.find("geometry")) is not None
    ]
    return replace(link, children=(*link.children, *ghosts))


def _ghost(name: str, pose: Parameters | None, shape: Parameters) -> Parameters:
    """Return a collision without contacts."""
    touch = made("collide_without_contact", "true", like=shape)
    surface = made("surface", "", made("contact", "", touch, like=shape), like=shape)
    parts = [surface, shape] if pose is None else [pose, surface, shape]
    return made("collision", "", *parts, like=shape, attributes={"name": name})


def _script(node: Parameters) -> Parameters | None:
    """Return the plugin that moves the actor; None if it has no trajectory, or does not start."""
    script = node.find("script")
    if (
        script is None
        or _is_plugin_driven(node)
        or not values.flag(script, "auto_start", default=True)
    ):
        return None
    trajectories = list(_trajectories(script))
    if not trajectories:
        return None
    loop = "true" if values.flag(script, "loop", default=True) else "false"
    return made(
        "plugin",
        "",
        *trajectories,
        made("loop", loop, like=script),
        made("updateRate", "30", like=script),
        like=script,
        attributes={"name": "script", "filename": PLUGIN},
    )


def _trajectories(script: Parameters) -> Iterator[Parameters]:
    """Yield the trajectories with waypoints, which follow each other in the order of their ids.

    Each counts its time from its own start and lasts until its last waypoint; of several
    waypoints at one time the last holds, as in Gazebo Classic.
    """
    start = values.real(script, "delay_start", 0.0)
    for trajectory in sorted(script.find_all("trajectory"), key=_number):
        own = {values.real(node, "time", 0.0): node for node in trajectory.find_all("waypoint")}
        if own and min(own) < 0.0:
            raise values.fail(own[min(own)], "the <time> of a <waypoint> must not be negative")
        if own:
            attributes = {"start": repr(start)}
            if "tension" in trajectory.attributes:
                attributes["tension"] = trajectory.attributes["tension"]
            waypoints = (_waypoint(time, own[time]) for time in sorted(own))
            yield made("trajectory", "", *waypoints, like=trajectory, attributes=attributes)
            start += max(own)


def _waypoint(time: float, node: Parameters) -> Parameters:
    x, y, z = (pose := read_pose(node.find("pose"))).position
    text = " ".join(map(repr, (x, y, z, *pose.rpy)))
    parts = made("time", repr(time), like=node), made("pose", text, like=node)
    return made("waypoint", "", *parts, like=node)


def _number(trajectory: Parameters) -> int:
    return values.parse_integer(
        trajectory, trajectory.attributes.get("id", "") or "0", "attribute 'id'"
    )
