"""Plugins that name joints and links which are not there, or those of the other side."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import Model, Parameters, Plugin, Vector3, World
from gazelle.errors import did_you_mean
from gazelle.formats.lint.diagnostic import Diagnostic

# Tags of well-known plugins with the name of a joint, or of several, as text.
_JOINT_TAGS = frozenset(
    {
        "leftJoint",
        "rightJoint",
        "leftFrontJoint",
        "rightFrontJoint",
        "leftRearJoint",
        "rightRearJoint",
        "frontLeftJoint",
        "frontRightJoint",
        "steeringJoint",
        "actuatedWheelJoint",
        "jointName",
        "joint",
        "mimicJoint",
        "left_wheel_joint_name",
        "right_wheel_joint_name",
    }
)
_WHEEL_PAIRS = (
    ("leftJoint", "rightJoint"),
    ("leftFrontJoint", "rightFrontJoint"),
    ("leftRearJoint", "rightRearJoint"),
)
_LINK_TAGS = frozenset({"bodyName", "linkName", "palm_link", "gripper_link"})


def lint(world: World) -> Iterator[Diagnostic]:
    """Yield findings on every model plugin."""
    for top in world.models:
        for placed in top.walk():
            joints, links = _names(top, placed.model)
            for plugin in placed.model.plugins:
                for tag in plugin.parameters.children:
                    yield from _missing(plugin.name, tag, "joint", _JOINT_TAGS, joints)
                    yield from _missing(plugin.name, tag, "link", _LINK_TAGS, links)
                for pair in _WHEEL_PAIRS:
                    yield from _swapped(plugin, pair, placed.model)


def _names(top: Model, model: Model) -> tuple[set[str], set[str]]:
    joints: set[str] = set()
    links: set[str] = set()
    for root in (top, model):
        for placed in root.walk():
            prefix = placed.scope.removeprefix(root.name).removeprefix("::")
            scope = f"{prefix}::" if prefix else ""
            joints |= {f"{scope}{joint.name}" for joint in placed.model.joints}
            links |= {f"{scope}{link.name}" for link in placed.model.links}
            links |= {f"{scope}{frame.name}" for frame in placed.model.frames}
    return joints, links


def _missing(
    plugin: str, tag: Parameters, kind: str, tags: frozenset[str], known: set[str]
) -> Iterator[Diagnostic]:
    if tag.tag not in tags or tag.children:
        return
    for name in tag.text.replace(",", " ").split():
        if name not in known and name.rpartition("::")[2] not in known:
            yield Diagnostic(
                f"plugin-{kind}",
                f"plugin '{plugin}': <{tag.tag}> names the {kind} '{name}', which is not there",
                "the plugin will not work",
                did_you_mean(name, known),
                tag.source,
            )


def _swapped(plugin: Plugin, tags: tuple[str, str], model: Model) -> Iterator[Diagnostic]:
    """Find a left wheel on the right.

    Wheels that turn forwards by a positive speed have their left end where their axis points to.
    """
    names = [plugin.parameters.get(tag, "") for tag in tags]
    wheels = [_axle(model, name) for name in names]
    if wheels[0] is None or wheels[1] is None:
        return
    (left, axis), (right, other) = wheels[0], wheels[1]
    apart = sum((a - b) * c for a, b, c in zip(left, right, axis, strict=True))
    if apart < 0.0 < sum(a * b for a, b in zip(axis, other, strict=True)):
        yield Diagnostic(
            "wheels-swapped",
            f"plugin '{plugin.name}': <{tags[0]}> names '{names[0]}', which is on the right, and "
            f"<{tags[1]}> '{names[1]}', on the left",
            "the robot turns right where it is to turn left",
            "exchange the two names; <legacyMode> has no effect here, nor since ROS Melodic",
            plugin.source,
        )


def _axle(model: Model, name: str) -> tuple[Vector3, Vector3] | None:
    """Return position and axis of a joint in the model's frame; None if it is not of this model."""
    joint = next((each for each in model.joints if each.name == name and each.axes), None)
    link = joint and next((each for each in model.links if each.name == joint.child), None)
    if joint is None or link is None:
        return None
    frame = link.pose * joint.pose
    return frame.position, frame.rotate(joint.axes[0].xyz)
