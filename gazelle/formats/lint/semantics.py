"""Lint rules for an SRDF, checked against the URDF of the robot.

MoveIt passes over what names nothing, with a line in the log, and plans without it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from gazelle.description import Parameters
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.lint.diagnostic import Diagnostic
from gazelle.formats.urdf.tree import UrdfTree
from gazelle.kinematics.joint_graph import JointGraph

_NAMING: Mapping[str, Mapping[str, str]] = {
    "disable_collisions": {"link1": "link", "link2": "link"},
    "disable_default_collisions": {"link": "link"},
    "enable_collisions": {"link1": "link", "link2": "link"},
    "end_effector": {"parent_link": "link"},
    "group/chain": {"base_link": "link", "tip_link": "link"},
    "group/joint": {"name": "joint"},
    "group/link": {"name": "link"},
    "group_state/joint": {"name": "joint"},
    "joint_property": {"joint_name": "joint"},
    "link_sphere_approximation": {"link": "link"},
    "passive_joint": {"name": "joint"},
    "virtual_joint": {"child_link": "link"},
}
"""Attributes that name a link or joint, by element."""

_SLACK = 1e-6


def lint(root: Parameters, robot: str, tree: UrdfTree) -> Iterator[Diagnostic]:
    """Yield findings about an SRDF.

    Args:
        root: Its ``<robot>``.
        robot: Name of the URDF's robot.
        tree: Links and joints of the URDF.
    """
    name = root.attributes.get("name", "")
    if name != robot:
        yield Diagnostic(
            "srdf-robot",
            f"the SRDF is for the robot '{name}', the URDF is of '{robot}'",
            "MoveIt refuses a pair of different names",
            "give both the same name",
            root.source,
        )
    virtual = {node.attributes.get("name", "") for node in root.find_all("virtual_joint")}
    known = {"link": set(tree.links), "joint": set(tree.joints) | virtual}
    for path, attributes in _NAMING.items():
        for node in _at(root, path):
            for attribute, kind in attributes.items():
                yield from _missing(node, attribute, kind, known[kind])
    for node in _at(root, "group/chain"):
        yield from _chain(node, tree)
    for node in _at(root, "group_state/joint"):
        yield from _limits(node, tree)


def _at(root: Parameters, path: str) -> Iterator[Parameters]:
    head, _, rest = path.partition("/")
    for node in root.find_all(head):
        yield from node.find_all(rest) if rest else (node,)


def _missing(node: Parameters, attribute: str, kind: str, known: set[str]) -> Iterator[Diagnostic]:
    name = node.attributes.get(attribute, "")
    if name and name not in known:
        yield Diagnostic(
            f"srdf-{kind}",
            f"<{node.tag}> names the {kind} '{name}', which the URDF does not have",
            "MoveIt passes over it",
            did_you_mean(name, known),
            node.source,
        )


def _chain(node: Parameters, tree: UrdfTree) -> Iterator[Diagnostic]:
    """Yield findings on chains that do not go down the tree, from base to tip."""
    base, tip = (node.attributes.get(key, "") for key in ("base_link", "tip_link"))
    if base not in tree.links or tip not in tree.links:
        return
    graph = JointGraph(tree.joints.values())
    if base not in (tip, *(joint.parent for joint in graph.inwards(tip))):
        yield Diagnostic(
            "srdf-chain",
            f"the chain's tip '{tip}' does not hang on its base '{base}'",
            "the group would be empty",
            "name a base that lies between the root and the tip",
            node.source,
        )


def _limits(node: Parameters, tree: UrdfTree) -> Iterator[Diagnostic]:
    joint = tree.joints.get(node.attributes.get("name", ""))
    if joint is None or joint.axis is None:
        return
    text = node.attributes.get("value", "")
    for value in values.parse_reals(node, text, "attribute 'value'", None):
        low, high = joint.axis.lower, joint.axis.upper
        if not low - _SLACK <= value <= high + _SLACK:
            yield Diagnostic(
                "srdf-limits",
                f"the posture puts joint '{joint.name}' at {value:g}, outside of its limits "
                f"{low:g} to {high:g}",
                "a planner cannot start or end there",
                "give a value within the limits",
                node.source,
            )
