"""Semantic description for planning (SRDF): groups, named states, pairs that may touch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Literal

from gazelle.description.joint import Joint
from gazelle.description.mappings import HoldsMappings
from gazelle.description.model import Model
from gazelle.description.pose import Vector3
from gazelle.description.source import Source
from gazelle.errors import FormatError, did_you_mean

VirtualJointType = Literal["fixed", "floating", "planar"]


@dataclass(frozen=True, slots=True)
class VirtualJoint:
    """Joint between the robot and the world.

    Attributes:
        name: Unique among the joints.
        type: ``fixed``, ``planar`` or ``floating``.
        parent_frame: A frame outside of the robot.
        child_link: The robot's root link.
    """

    name: str
    type: VirtualJointType
    parent_frame: str
    child_link: str
    source: Source | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class JointGroup:
    """A set of joints that is planned for together.

    Attributes:
        name: Unique among the groups.
        joints: Joints named one by one.
        links: Links, which stand for the joint that holds them.
        chains: Pairs (base link, tip link): all joints between them.
        groups: Other groups that are part of it.
    """

    name: str
    joints: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    chains: tuple[tuple[str, str], ...] = ()
    groups: tuple[str, ...] = ()
    source: Source | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class JointGroupState(HoldsMappings):
    """A named posture of a group; ``joints`` holds the values of each joint [m or rad]."""

    name: str
    group: str
    joints: Mapping[str, tuple[float, ...]]
    source: Source | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class EndEffector:
    """A gripper or tool.

    Attributes:
        name: Unique among the end effectors.
        group: The group of its own joints and links.
        parent_link: The link it is mounted on.
        parent_group: The arm's group; empty when the file does not say.
    """

    name: str
    group: str
    parent_link: str
    parent_group: str = ""
    source: Source | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class DisabledCollision:
    """Two links that need not be checked against each other, and why."""

    link1: str
    link2: str
    reason: str = ""


@dataclass(frozen=True, slots=True)
class Semantics(HoldsMappings):
    """All that an SRDF file says of a robot.

    Attributes:
        robot: Name of the robot.
        groups: In file order.
        states: Named postures of groups, in file order.
        end_effectors: In file order.
        virtual_joints: In file order.
        passive_joints: Names of joints that nothing drives.
        disabled_collisions: Pairs that are not checked.
        enabled_collisions: Pairs that are checked although a link of theirs is in
            ``unchecked_links``.
        unchecked_links: Links that are not checked against any other.
        spheres: By link: centre [m] and radius [m] of spheres that stand for it.
        joint_properties: By joint: value by name of the property.
    """

    robot: str
    groups: tuple[JointGroup, ...] = ()
    states: tuple[JointGroupState, ...] = ()
    end_effectors: tuple[EndEffector, ...] = ()
    virtual_joints: tuple[VirtualJoint, ...] = ()
    passive_joints: tuple[str, ...] = ()
    disabled_collisions: tuple[DisabledCollision, ...] = ()
    enabled_collisions: tuple[DisabledCollision, ...] = ()
    unchecked_links: tuple[str, ...] = ()
    spheres: Mapping[str, tuple[tuple[Vector3, float], ...]] = field(default_factory=dict)
    joint_properties: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    source: Source | None = field(default=None, compare=False, repr=False)

    def group(self, name: str) -> JointGroup:
        """Return the group with a name.

        Raises:
            FormatError: There is none.
        """
        for group in self.groups:
            if group.name == name:
                return group
        hint = did_you_mean(name, [group.name for group in self.groups])
        raise FormatError(f"there is no group '{name}'", source=self.source, hint=hint)

    def state(self, group: str, name: str) -> JointGroupState:
        """Return the named posture of a group.

        Raises:
            FormatError: There is none.
        """
        own = [state for state in self.states if state.group == group]
        for state in own:
            if state.name == name:
                return state
        hint = did_you_mean(name, [state.name for state in own])
        raise FormatError(
            f"the group '{group}' has no state '{name}'", source=self.source, hint=hint
        )

    def joints_of(self, group: str, model: Model) -> tuple[Joint, ...]:
        """Return the movable joints of a group, from the root outwards, in MoveIt's order.

        Joints that mimic another are among them, passive ones too.

        Args:
            group: Its name.
            model: The robot; links that went into others are found by their frames.

        Raises:
            FormatError: The group, or a joint or link that it names, is not there.
        """
        tree = _Tree(model)
        names = set(self._names(group, tree, ()))
        return tuple(joint for joint in tree.ordered() if joint.name in names)

    def _names(self, name: str, tree: _Tree, outer: tuple[str, ...]) -> Iterator[str]:
        group = self.group(name)
        if name in outer:
            raise FormatError(f"the group '{name}' is part of itself", source=group.source)
        for joint in group.joints:
            virtual = any(other.name == joint for other in self.virtual_joints)
            if not virtual and tree.has_joint(joint, group):
                yield joint
        for link in group.links:
            yield from tree.holding(link, group)
        for base, tip in group.chains:
            yield from tree.between(base, tip, group)
        for inner in group.groups:
            yield from self._names(inner, tree, (*outer, name))


class _Tree:
    """Joints of a model and the links they hold."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._holder = {joint.child: joint for joint in model.joints}
        self._links = {link.name for link in model.links}
        self._frames = {frame.name: frame.attached_to for frame in model.frames}

    def ordered(self) -> Iterator[Joint]:
        """Yield the movable joints, depth first."""
        below: dict[str, list[Joint]] = {}
        for joint in self._model.joints:
            below.setdefault(joint.parent, []).append(joint)
        held = set(self._holder)
        roots = [name for name in below if name not in held]
        waiting = [joint for root in reversed(roots) for joint in reversed(below[root])]
        while waiting:
            joint = waiting.pop()
            if joint.type != "fixed":
                yield joint
            waiting.extend(reversed(below.pop(joint.child, [])))

    def has_joint(self, name: str, group: JointGroup) -> bool:
        """Return whether a joint that a group names exists: a fixed one may have been lumped away."""
        known = [joint.name for joint in self._model.joints]
        if name in known:
            return True
        if name in self._frames:
            return False
        raise _unknown("joint", name, group, known)

    def holding(self, link: str, group: JointGroup) -> Iterator[str]:
        """Yield the joint that holds a link; none for the root and for one lumped into another."""
        self._body(link, group)
        if link in self._holder:
            yield self._holder[link].name

    def between(self, base: str, tip: str, group: JointGroup) -> Iterator[str]:
        """Yield the joints on the way from one link to another."""
        up = self._climb(self._body(base, group))
        down = self._climb(self._body(tip, group))
        shared = {joint.name for joint in up} & {joint.name for joint in down}
        yield from (joint.name for joint in (*up, *down) if joint.name not in shared)

    def _body(self, link: str, group: JointGroup) -> str:
        """Return the link itself, or the one that it became part of."""
        if link in self._links:
            return link
        if link in self._frames:
            return self._frames[link]
        raise _unknown("link", link, group, [*self._links, *self._frames])

    def _climb(self, link: str) -> list[Joint]:
        joints: list[Joint] = []
        while link in self._holder and len(joints) <= len(self._holder):
            joints.append(self._holder[link])
            link = joints[-1].parent
        return joints


def _unknown(kind: str, name: str, group: JointGroup, known: list[str]) -> FormatError:
    return FormatError(
        f"the group '{group.name}' names the {kind} '{name}', which the robot does not have",
        source=group.source,
        hint=did_you_mean(name, known),
    )
