"""``RobotInterface``: names, limits and states of a robot, as MoveIt's C++ class gives them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from gazelle.array_types import Floats
from gazelle.bridges.moveit.client.link_markers import link_markers
from gazelle.bridges.moveit.client.robot_access import shared_robot
from gazelle.bridges.moveit.client.session import packed, unpacked


class RobotInterface:
    """As ``moveit_ros_planning_interface._moveit_robot_interface`` has it.

    Args:
        robot_description: Parameter of the robot; its semantics' begins with it.
        ns: Namespace of ``joint_states``.

    Raises:
        RuntimeError: There is no robot.
    """

    def __init__(self, robot_description: str = "robot_description", ns: str = "") -> None:
        self._access = shared_robot(robot_description, ns)
        self._robot, self._names = self._access.robot, self._access.names

    # -- names ---------------------------------------------------------------------------

    def get_robot_name(self) -> str:
        """Name of the robot."""
        return self._names.robot

    def get_robot_root_link(self) -> str:
        """The link on which all others hang."""
        return self._names.root

    def get_planning_frame(self) -> str:
        """The frame that is planned in."""
        return self._robot.frame

    def get_joint_names(self) -> list[str]:
        """All joints, the virtual one at the root first."""
        return self._names.joint_names()

    def get_active_joint_names(self) -> list[str]:
        """Joints that can be moved by themselves."""
        return self._names.active_joint_names()

    def get_link_names(self) -> list[str]:
        """All links."""
        return list(self._names.links)

    def get_group_names(self) -> list[str]:
        """All groups."""
        return list(self._names.groups)

    def has_group(self, group: str) -> bool:
        """Return whether there is a group of a name."""
        return group in self._names.groups

    def get_group_joint_names(self, group: str) -> list[str]:
        """Joints of a group; none if there is no such group."""
        return [joint.name for joint in self._names.group_joints(group)]

    def get_group_active_joint_names(self, group: str) -> list[str]:
        """Joints of a group that can be moved by themselves."""
        return self._names.group_active(group)

    def get_group_link_names(self, group: str) -> list[str]:
        """Links of a group."""
        return self._names.group_links(group)

    def get_group_joint_tips(self, group: str) -> list[str]:
        """Links of a group that end effectors are mounted on."""
        return self._names.effector_tips(group)

    def get_group_default_states(self, group: str) -> list[str]:
        """Names of a group's states in the SRDF."""
        return self._names.states(group)

    def get_parent_group(self, group: str) -> tuple[str, str]:
        """The group that an end effector's group is mounted on, and the link there."""
        return self._names.effector_parent(group)

    # -- limits and states ---------------------------------------------------------------

    def get_joint_limits(self, joint: str) -> list[list[float]]:
        """Lower and upper limit of each variable of a joint [m or rad]."""
        found = [each for each in self._robot.variables if each.joint == joint]
        limits = []
        for each in found:
            low, high = each.bounds.lower, each.bounds.upper
            limits.append([-math.pi, math.pi] if each.endless else [low, high])
        return limits

    def get_joint_values(self, group: str, named_state: str) -> dict[str, float]:
        """Values by variable of a group's state in the SRDF; empty if there is none."""
        if not self.has_group(group):
            return {}
        return dict(self._robot.group(group).states.get(named_state, {}))

    def get_current_joint_values(self, joint: str) -> list[float]:
        """Positions of a joint's variables now."""
        state = self._access.known()
        return [
            float(state[column])
            for column, each in enumerate(self._robot.variables)
            if each.joint == joint
        ]

    def get_current_variable_values(self) -> dict[str, float]:
        """Positions of all variables now, by name."""
        return dict(zip(self._robot.names, self._access.known().tolist(), strict=True))

    def get_current_state(self) -> bytes:
        """A ``RobotState`` of now."""
        return packed(self._access.message(self._access.known()))

    def get_link_pose(self, link: str) -> list[float]:
        """Return the present pose of a link: x, y, z, qx, qy, qz, qw; empty if there is no such link."""
        if link not in self._robot.links:
            return []
        pose = self._robot.pose(self._access.known(), link)
        return [*pose.position, *pose.quaternion]

    # -- markers -------------------------------------------------------------------------

    def get_robot_markers(
        self,
        state: bytes | Mapping[str, float] | Sequence[str] | None = None,
        links: Sequence[str] | None = None,
    ) -> bytes:
        """A ``MarkerArray`` of links.

        Args:
            state: A ``RobotState``, or positions by joint; now if None. A list is one of links.
            links: Which; all if None.
        """
        if isinstance(state, list | tuple):
            state, links = None, state
        here = self._access.known()
        if isinstance(state, bytes):
            message = unpacked("moveit_msgs/RobotState", state)
            found = self._access.with_message(message, self._access.default())
            here = here if found is None else found
        elif isinstance(state, Mapping):
            here = self._with(here, state)
        chosen = self._names.links if links is None else links
        return packed(link_markers(self._robot, here, chosen, self._access.node.clock.now()))

    def get_group_markers(self, group: str, values: Mapping[str, float] | None = None) -> bytes:
        """A ``MarkerArray`` of a group's links, now or with positions by joint."""
        return self.get_robot_markers(values or {}, self._names.group_links(group))

    def _with(self, state: Floats, values: Mapping[str, float]) -> Floats:
        made = state.copy()
        for name, value in values.items():
            if name in self._robot.names:
                made[self._robot.column(name)] = value
        return self._robot.complete(made)
