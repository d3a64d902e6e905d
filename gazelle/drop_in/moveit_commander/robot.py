"""``RobotCommander``: names, states and groups of a robot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from gazelle.array_types import Floats
from gazelle.drop_in.moveit_client.link_markers import link_markers
from gazelle.drop_in.moveit_client.robot_access import shared_robot
from gazelle.drop_in.moveit_commander import conversions
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.move_group import MoveGroupCommander
from gazelle.errors import did_you_mean
from gazelle_ros.msgs import geometry_msgs, moveit_msgs, visualization_msgs

__all__ = ["RobotCommander"]


class CommanderJoint:
    """A joint of a robot; ``RobotCommander.Joint``."""

    def __init__(self, robot: RobotCommander, name: str) -> None:
        self._robot, self._name = robot, name

    def name(self) -> str:
        """Return the joint's name."""
        return self._name

    def _limits(self) -> list[list[float]]:
        return self._robot.get_joint_limits(self._name)

    def variable_count(self) -> int:
        """Return the number of its variables."""
        return len(self._limits())

    def bounds(self) -> Any:
        """Return ``[lower, upper]``, or a list of them for several variables."""
        return _one(self._limits())

    def min_bound(self) -> Any:
        """Return the lower limit, or a list of them."""
        return _one([low for low, _ in self._limits()])

    def max_bound(self) -> Any:
        """Return the upper limit, or a list of them."""
        return _one([high for _, high in self._limits()])

    def value(self) -> Any:
        """Return its present position, or a list of positions."""
        return _one(self._robot.get_current_joint_values(self._name))

    def move(self, position: Any, wait: bool = True) -> bool:  # noqa: FBT001, FBT002  # MoveIt's interface
        """Move this joint alone; whether it arrived.

        Raises:
            MoveItCommanderException: It is in no group.
        """
        owner = self._robot.get_default_owner_group(self._name)
        if owner is None:
            raise MoveItCommanderException(
                f"the joint '{self._name}' is in no group, so nothing moves it"
            )
        group = self._robot.get_group(owner)
        group.set_joint_value_target(group.get_current_joint_values())
        group.set_joint_value_target(self._name, position)
        return group.go(wait)


class CommanderLink:
    """A link of a robot; ``RobotCommander.Link``."""

    def __init__(self, robot: RobotCommander, name: str) -> None:
        self._robot, self._name = robot, name

    def name(self) -> str:
        """Return the link's name."""
        return self._name

    def pose(self) -> geometry_msgs.msg.PoseStamped:
        """Return a ``PoseStamped``: where it is now."""
        found = self._robot.get_link_pose(self._name)
        return conversions.list_to_pose_stamped(found, self._robot.get_planning_frame())


class RobotCommander:
    """A robot; its groups, joints and links are attributes, too.

    Args:
        robot_description: Parameter of the robot.
        ns: Namespace of ``move_group`` and ``joint_states``.

    Raises:
        RuntimeError: There is no robot.
    """

    Joint = CommanderJoint
    Link = CommanderLink

    def __init__(self, robot_description: str = "robot_description", ns: str = "") -> None:
        self._robot_description, self._ns = robot_description, ns
        self._access = shared_robot(robot_description, ns)
        self._robot, self._names = self._access.robot, self._access.names
        self._groups: dict[str, MoveGroupCommander] = {}

    # -- names ---------------------------------------------------------------------------

    def get_robot_name(self) -> str:
        """Return the name of the robot."""
        return self._names.robot

    def get_robot_root_link(self) -> str:
        """Return the link on which all others hang."""
        return self._names.root

    get_root_link = get_robot_root_link

    def get_planning_frame(self) -> str:
        """Return the name of the planning frame."""
        return self._robot.frame

    def get_group_names(self) -> list[str]:
        """Return all groups."""
        return list(self._names.groups)

    def has_group(self, group: str) -> bool:
        """Return whether there is a group of a name."""
        return group in self._names.groups

    def get_group_joint_names(self, group: str) -> list[str]:
        """Return joints of a group; none if there is no such group."""
        return [joint.name for joint in self._names.group_joints(group)]

    def get_group_active_joint_names(self, group: str) -> list[str]:
        """Return joints of a group that can be moved by themselves."""
        return self._names.group_active(group)

    def get_group_link_names(self, group: str) -> list[str]:
        """Return links of a group."""
        return self._names.group_links(group)

    def get_group_joint_tips(self, group: str) -> list[str]:
        """Return links of a group that end effectors are mounted on."""
        return self._names.effector_tips(group)

    def get_group_default_states(self, group: str) -> list[str]:
        """Return names of a group's states in the SRDF."""
        return self._names.states(group)

    def get_parent_group(self, group: str) -> tuple[str, str]:
        """Return the group that an end effector's group is mounted on, and the link there."""
        return self._names.effector_parent(group)

    def get_joint_names(self, group: str | None = None) -> list[str]:
        """Return all joints, of the robot or of a group, fixed ones too.

        Raises:
            MoveItCommanderException: There is no such group.
        """
        if group is None:
            return self._names.joint_names()
        return self.get_group_joint_names(self._known(group))

    def get_active_joint_names(self, group: str | None = None) -> list[str]:
        """Return joints that can be moved by themselves; see `get_joint_names`."""
        if group is None:
            return self._names.active_joint_names()
        return self.get_group_active_joint_names(self._known(group))

    def get_link_names(self, group: str | None = None) -> list[str]:
        """Return all links; see `get_joint_names`."""
        if group is None:
            return list(self._names.links)
        return self.get_group_link_names(self._known(group))

    def _known(self, group: str) -> str:
        if not self.has_group(group):
            raise MoveItCommanderException(f"no group is called '{group}'")
        return group

    # -- parts ---------------------------------------------------------------------------

    def get_joint(self, name: str) -> CommanderJoint:
        """Return a joint.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if name not in self.get_joint_names():
            raise MoveItCommanderException(f"no joint is called '{name}'")
        return CommanderJoint(self, name)

    def get_link(self, name: str) -> CommanderLink:
        """Return a link.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if name not in self.get_link_names():
            raise MoveItCommanderException(f"no link is called '{name}'")
        return CommanderLink(self, name)

    def get_group(self, name: str) -> MoveGroupCommander:
        """Return the commander of a group, the same one each time.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if name not in self._groups:
            group = self._known(name)
            self._groups[name] = MoveGroupCommander(group, self._robot_description, self._ns)
        return self._groups[name]

    def get_default_owner_group(self, joint_name: str) -> str | None:
        """Return the group with the fewest links that a joint is in; None if it is in none."""
        owners = [
            group
            for group in self.get_group_names()
            if joint_name in self.get_group_joint_names(group)
        ]
        return min(owners, key=lambda group: len(self.get_group_link_names(group)), default=None)

    # -- states --------------------------------------------------------------------------

    def get_joint_limits(self, joint: str) -> list[list[float]]:
        """Return lower and upper limit of each variable of a joint [m or rad]."""
        found = [each for each in self._robot.variables if each.joint == joint]
        limits = []
        for each in found:
            low, high = each.bounds.lower, each.bounds.upper
            limits.append([-math.pi, math.pi] if each.endless else [low, high])
        return limits

    def get_joint_values(self, group: str, named_state: str) -> dict[str, float]:
        """Return values by variable of a group's state in the SRDF; empty if there is none."""
        if not self.has_group(group):
            return {}
        return dict(self._robot.group(group).states.get(named_state, {}))

    def get_current_joint_values(self, joint: str) -> list[float]:
        """Return positions of a joint's variables now."""
        state = self._access.known()
        return [
            float(state[column])
            for column, each in enumerate(self._robot.variables)
            if each.joint == joint
        ]

    def get_current_variable_values(self) -> dict[str, float]:
        """Return positions of all variables now, by name."""
        return dict(zip(self._robot.names, self._access.known().tolist(), strict=True))

    def get_current_state(self) -> moveit_msgs.msg.RobotState:
        """Return a ``RobotState`` of now."""
        return self._access.message(self._access.known())

    def get_link_pose(self, link: str) -> list[float]:
        """Return the present pose of a link: x, y, z, qx, qy, qz, qw; empty if it does not exist."""
        if link not in self._robot.links:
            return []
        pose = self._robot.pose(self._access.known(), link)
        return [*pose.position, *pose.quaternion]

    # -- markers -------------------------------------------------------------------------

    def get_robot_markers(
        self, state: Any = None, links: Any = None
    ) -> visualization_msgs.msg.MarkerArray:
        """Return a ``MarkerArray`` of links.

        Args:
            state: A ``RobotState``, or positions by joint; now if None. A list is one of links, and a
                name that of a group; positions by joint may follow.
            links: Names of links; all if None.

        Raises:
            MoveItCommanderException: It is something else.
        """
        if isinstance(state, str):
            return self.get_group_markers(state, links)
        if isinstance(state, list | tuple):
            state, links = None, state
        here = self._access.known()
        if getattr(state, "_type", "") == "moveit_msgs/RobotState":
            found = self._access.with_message(state, self._access.default())
            here = here if found is None else found
        elif isinstance(state, Mapping):
            here = self._with(here, state)
        elif state is not None:
            raise MoveItCommanderException(
                f"expected a RobotState, joint values or a group, not {type(state).__name__}"
            )
        chosen = self._names.links if links is None else links
        return link_markers(self._robot, here, chosen, self._access.node.clock.now())

    def get_group_markers(
        self, group: str, values: Mapping[str, float] | None = None
    ) -> visualization_msgs.msg.MarkerArray:
        """Return a ``MarkerArray`` of a group's links, now or with positions by joint."""
        return self.get_robot_markers(values or {}, self._names.group_links(group))

    def _with(self, state: Floats, values: Mapping[str, float]) -> Floats:
        made = state.copy()
        for name, value in values.items():
            if name in self._robot.names:
                made[self._robot.column(name)] = value
        return self._robot.complete(made)

    def __getattr__(self, name: str) -> Any:
        """Return a group, joint or link of that name.

        Raises:
            AttributeError: There is none.
        """
        if name.startswith("_"):
            raise AttributeError(name)
        if self.has_group(name):
            return self.get_group(name)
        if name in self.get_joint_names():
            return CommanderJoint(self, name)
        if name in self.get_link_names():
            return CommanderLink(self, name)
        known = [*self.get_group_names(), *self.get_joint_names(), *self.get_link_names()]
        raise AttributeError(
            f"RobotCommander has no attribute, group, joint or link '{name}'; "
            f"{did_you_mean(name, known)}"
        )


def _one(values: list[Any]) -> Any:
    return values[0] if len(values) == 1 else values
