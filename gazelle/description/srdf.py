"""Semantic description for planning (SRDF): groups, named states, pairs that may touch."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from gazelle.description.mappings import HoldsMappings
from gazelle.description.nan_refusal import refuses_nan
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


@refuses_nan
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


@refuses_nan
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

    def parts_of(self, name: str) -> list[JointGroup]:
        """Return the group with a name and all groups that are part of it, each once.

        Raises:
            FormatError: One of them is not there.
        """
        found: dict[str, JointGroup] = {}
        pending = [name]
        while pending:
            group = self.group(pending.pop())
            if group.name not in found:
                found[group.name] = group
                pending.extend(reversed(group.groups))
        return list(found.values())

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
