"""``<actor>``: a model that follows a script, without the play of its limbs."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import Parameters
from gazelle.formats import values
from gazelle.formats.sdf.build import made
from gazelle.formats.sdf.pose import read_pose

PLUGIN = "libgazelle_scripted_motion.so"


def as_model(node: Parameters) -> Parameters:
    """The static ``<model>`` of an actor, moved by Gazelle's plugin of scripted motion.

    It has the actor's own links; one of a skin has a link that shows the skin and collides
    with nothing, as in Gazebo.
    """
    pose = node.find("pose")
    children = [made("static", "true", like=node)]
    if pose is not None:
        children.append(pose)
    kept = [child for child in node.children if child.tag in {"link", "joint", "plugin"}]
    if not any(child.tag == "link" for child in kept):
        kept.insert(0, _body(node))
    script = _script(node)
    children += kept if script is None else [*kept, script]
    name = values.attribute(node, "name")
    return made("model", "", *children, like=node, attributes={"name": name})


def _body(node: Parameters) -> Parameters:
    """A link that shows the actor's skin, if it has one."""
    skin = node.find("skin")
    file = "" if skin is None else values.word(skin, "filename")
    if skin is None or not file:
        return made("link", like=node, attributes={"name": "body"})
    size = " ".join([repr(values.real(skin, "scale", 1.0))] * 3)
    uri = made("uri", file, like=skin.find("filename") or skin)
    mesh = made("mesh", "", uri, made("scale", size, like=skin), like=skin)
    shape = made("geometry", "", mesh, like=skin)
    visual = made("visual", "", shape, like=skin, attributes={"name": "skin"})
    return made("link", "", visual, like=node, attributes={"name": "body"})


def _script(node: Parameters) -> Parameters | None:
    """The plugin that moves the actor; None if it has no trajectory, or does not start."""
    script = node.find("script")
    if script is None or not values.flag(script, "auto_start", default=True):
        return None
    waypoints = list(_waypoints(script))
    if not waypoints:
        return None
    loop = "true" if values.flag(script, "loop", default=True) else "false"
    return made(
        "plugin",
        "",
        *waypoints,
        made("loop", loop, like=script),
        made("updateRate", "30", like=script),
        like=script,
        attributes={"name": "script", "filename": PLUGIN},
    )


def _waypoints(script: Parameters) -> Iterator[Parameters]:
    """The waypoints of all trajectories, which follow each other in the order of their ids.

    Each counts its time from its own start and lasts until its last waypoint; of several
    waypoints at one time the last holds, as in Gazebo Classic.
    """
    start = values.real(script, "delay_start", 0.0)
    found: dict[float, Parameters] = {}
    for trajectory in sorted(script.find_all("trajectory"), key=_number):
        own = {values.real(node, "time", 0.0): node for node in trajectory.find_all("waypoint")}
        if own and min(own) < 0.0:
            raise values.fail(own[min(own)], "the <time> of a <waypoint> must not be negative")
        found |= {start + time: node for time, node in own.items()}
        start += max(own, default=0.0)
    for time in sorted(found):
        node = found[time]
        x, y, z = (pose := read_pose(node.find("pose"))).position
        text = " ".join(map(repr, (x, y, z, *pose.rpy)))
        yield made(
            "waypoint",
            "",
            made("time", repr(time), like=node),
            made("pose", text, like=node),
            like=node,
        )


def _number(trajectory: Parameters) -> int:
    return values.parse_integer(
        trajectory, trajectory.attributes.get("id", "") or "0", "attribute 'id'"
    )
