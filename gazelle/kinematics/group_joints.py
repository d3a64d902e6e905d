"""Joints of the groups that an SRDF names."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import JointGroup, Semantics
from gazelle.errors import FormatError, did_you_mean
from gazelle.kinematics.robot_tree import RobotTree


class GroupJoints:
    """Names of the joints of each group.

    Args:
        semantics: Contents of the SRDF.
        tree: The robot; links that went into others are found by their frames.
    """

    def __init__(self, semantics: Semantics, tree: RobotTree) -> None:
        self._semantics, self._graph = semantics, tree.graph
        self._joints = [joint.name for joint in (*tree.graph.holders.values(), *tree.closing)]
        self._links, self._parts = {tree.root, *tree.bodies}, tree.parts()

    def names(self, group: str) -> Iterator[str]:
        """Yield the names of a group's joints, those of groups that are part of it too.

        Raises:
            FormatError: The group, or a joint or link that it names, is not there.
        """
        for found in self._semantics.parts_of(group):
            yield from self._own_names(found)

    def _own_names(self, found: JointGroup) -> Iterator[str]:
        for joint in found.joints:
            virtual = any(other.name == joint for other in self._semantics.virtual_joints)
            if not virtual and self._has_joint(joint, found):
                yield joint
        for link in found.links:
            holder = self._graph.holders.get(self._body(link, found))
            if holder is not None and link in self._links:
                yield holder.name
        for base, tip in found.chains:
            ends = self._body(base, found), self._body(tip, found)
            yield from (joint.name for joint in self._graph.between(*ends))

    def _has_joint(self, name: str, group: JointGroup) -> bool:
        """Return whether a joint exists: a fixed one may have become part of a link."""
        if name in self._joints:
            return True
        if name in self._parts:
            return False
        raise _unknown("joint", name, group, self._joints)

    def _body(self, link: str, group: JointGroup) -> str:
        """Return the link itself, or the one that it became part of."""
        if link in self._links:
            return link
        if link in self._parts:
            return self._parts[link]
        raise _unknown("link", link, group, [*self._links, *self._parts])


def _unknown(kind: str, name: str, group: JointGroup, known: list[str]) -> FormatError:
    return FormatError(
        f"the group '{group.name}' names the {kind} '{name}', which the robot does not have",
        source=group.source,
        hint=did_you_mean(name, known),
    )
