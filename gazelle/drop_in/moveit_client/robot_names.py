"""Names and order of a robot's joints and links, as MoveIt lists them."""

from __future__ import annotations

import itertools
import xml.etree.ElementTree as ET
from dataclasses import dataclass

from gazelle.description import Semantics
from gazelle.errors import PlanningError
from gazelle.kinematics.joint_graph import JointGraph

NO_VIRTUAL_JOINT = "ASSUMED_FIXED_ROOT_JOINT"
"""MoveIt's name of the root joint of a robot without one in its SRDF."""
_ONE_VARIABLE = ("revolute", "continuous", "prismatic")


@dataclass(frozen=True, slots=True)
class NamedJoint:
    """A joint as URDF has it, fixed ones too."""

    name: str
    type: str
    parent: str
    child: str
    mimics: bool = False

    @property
    def moves(self) -> bool:
        """True if it has a variable."""
        return self.type in _ONE_VARIABLE


class RobotNames:
    """Joints and links of a robot, depth first, those of one link in the order of the alphabet.

    Args:
        urdf: The description.
        semantics: Of its SRDF.

    Attributes:
        robot: The robot's name.
        root: Its root link.
        joints: All joints, without the virtual one at the root.
        links: All links.
        root_joint: Name of the joint that holds the root.
        groups: Names of the groups.

    Raises:
        PlanningError: The text is no URDF of one tree.
    """

    def __init__(self, urdf: str, semantics: Semantics) -> None:
        self._semantics = semantics
        try:
            tree = ET.fromstring(urdf)  # noqa: S314  # the parameter server is the user's own
        except ET.ParseError as error:
            raise PlanningError(f"robot_description is no URDF: {error}") from None
        self.robot = tree.get("name", "")
        self._graph, self.root = _graph_of(tree)
        self.joints = list(self._graph.outwards(self.root))
        self.links = [self.root, *(joint.child for joint in self.joints)]
        held = [each for each in semantics.virtual_joints if each.child_link == self.root]
        self.root_joint = held[0].name if held else NO_VIRTUAL_JOINT
        self._base = held[0].type if held else "fixed"
        # MoveIt keeps them in a map.
        self.groups = sorted(group.name for group in semantics.groups)

    # -- of the whole robot --------------------------------------------------------------

    def joint_names(self) -> list[str]:
        """Return all joints, the one at the root first."""
        return [self.root_joint, *(joint.name for joint in self.joints)]

    def active_joint_names(self) -> list[str]:
        """Return joints with variables that mimic no other."""
        own = [] if self._base == "fixed" else [self.root_joint]
        return own + [joint.name for joint in self.joints if joint.moves and not joint.mimics]

    def variable_names(self) -> list[str]:
        """Return names of single-variable joints, including mimics."""
        return [joint.name for joint in self.joints if joint.moves]

    # -- of groups -----------------------------------------------------------------------

    def group_joints(self, name: str) -> list[NamedJoint]:
        """Return joints of a group, fixed ones too; none if there is no such group."""
        if name not in self.groups:
            return []
        chosen = self._chosen(name, ())
        return [joint for joint in self.joints if joint.name in chosen]

    def group_links(self, name: str) -> list[str]:
        """Return links that a group's joints move."""
        return [joint.child for joint in self.group_joints(name)]

    def group_variables(self, name: str) -> list[str]:
        """Return variables of a group, including mimics."""
        return [joint.name for joint in self.group_joints(name) if joint.moves]

    def group_active(self, name: str) -> list[str]:
        """Return joints of a group with variables that mimic no other."""
        return [each.name for each in self.group_joints(name) if each.moves and not each.mimics]

    def chain_tip(self, name: str) -> str:
        """Return the last link of a group that is one chain of several joints; else empty.

        As MoveIt has it: joints that each hang on the one before, with none but fixed ones between.
        """
        joints = self.group_joints(name)
        if len(self.group_active(name)) < 2:
            return ""
        if all(self._hangs_on(joint, before) for before, joint in itertools.pairwise(joints)):
            return joints[-1].child
        return ""

    def effector_tips(self, name: str) -> list[str]:
        """Return links of a group that end effectors are mounted on."""
        links, found = self.group_links(name), list[str]()
        for each in self._semantics.end_effectors:
            mounted = each.parent_group == name or (
                not each.parent_group and each.group != name and each.parent_link in links
            )
            if mounted and each.parent_link not in found:
                found.append(each.parent_link)
        return found

    def effector_parent(self, name: str) -> tuple[str, str]:
        """Return the group and link that an end effector is mounted on.

        Empty for another group.
        """
        for each in self._semantics.end_effectors:
            if each.group == name:
                owners = [each.parent_group] if each.parent_group else [
                    group for group in self.groups
                    if group != name and each.parent_link in self.group_links(group)
                ]  # fmt: skip
                smallest = min(owners, key=lambda group: len(self.group_links(group)), default="")
                return smallest, each.parent_link
        return "", ""

    def states(self, group: str) -> list[str]:
        """Return named postures of a group."""
        return sorted(each.name for each in self._semantics.states if each.group == group)

    # -- how they hang together ----------------------------------------------------------

    def _hangs_on(self, joint: NamedJoint, other: NamedJoint) -> bool:
        """Return whether a joint follows another one directly, except for fixed ones between."""
        for above in self._graph.inwards(joint.parent):
            if above.name == other.name or above.type != "fixed":
                return above.name == other.name
        return False

    def _chosen(self, name: str, outer: tuple[str, ...]) -> set[str]:
        if name in outer or name not in self.groups:
            return set()
        group = self._semantics.group(name)
        found = set(group.joints)
        holders = self._graph.holders
        found |= {holders[link].name for link in group.links if link in holders}
        for ends in group.chains:
            found |= {joint.name for joint in self._graph.between(*ends)}
        for inner in group.groups:
            found |= self._chosen(inner, (*outer, name))
        return found


def _graph_of(tree: ET.Element) -> tuple[JointGraph[NamedJoint], str]:
    """Return joints of a URDF by the alphabet, as urdfdom has them, and the root link."""
    graph = JointGraph(
        NamedJoint(
            element.get("name", ""),
            element.get("type", ""),
            _link_of(element, "parent"),
            _link_of(element, "child"),
            element.find("mimic") is not None,
        )
        for element in sorted(tree.findall("joint"), key=lambda each: each.get("name", ""))
    )
    roots = graph.roots(link.get("name", "") for link in tree.findall("link"))
    if len(roots) != 1:
        raise PlanningError(f"robot_description has {len(roots)} root links, not one")
    return graph, roots[0]


def _link_of(joint: ET.Element, kind: str) -> str:
    found = joint.find(kind)
    return "" if found is None else found.get("link", "")
