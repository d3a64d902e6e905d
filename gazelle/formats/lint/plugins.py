"""Plugins that name joints and links which are not there."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import Model, Parameters, World
from gazelle.errors import did_you_mean
from gazelle.formats.lint.diagnostic import Diagnostic

# Tags of well-known plugins whose text is the name of a joint, or of several.
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
_LINK_TAGS = frozenset({"bodyName", "linkName", "palm_link", "gripper_link"})


def lint(world: World) -> Iterator[Diagnostic]:
    """Findings on every model plugin."""
    for top in world.models:
        for placed in top.walk():
            joints, links = _names(top, placed.model)
            for plugin in placed.model.plugins:
                for tag in plugin.parameters.children:
                    yield from _missing(plugin.name, tag, "joint", _JOINT_TAGS, joints)
                    yield from _missing(plugin.name, tag, "link", _LINK_TAGS, links)


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
