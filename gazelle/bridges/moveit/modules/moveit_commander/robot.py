"""``RobotCommander``: names, states and groups of a robot."""

from __future__ import annotations

from functools import partial
from typing import Any

from gazelle.bridges.moveit.client.robot_interface import RobotInterface
from gazelle.bridges.moveit.client.session import packed, unpacked
from gazelle.bridges.moveit.modules.moveit_commander import conversions
from gazelle.bridges.moveit.modules.moveit_commander.delegation import PassedOn
from gazelle.bridges.moveit.modules.moveit_commander.exception import MoveItCommanderException
from gazelle.bridges.moveit.modules.moveit_commander.move_group import MoveGroupCommander
from gazelle.errors import did_you_mean

__all__ = ["RobotCommander"]

_same = partial(PassedOn, "_r", RobotInterface)


class CommanderJoint:
    """A joint of a robot; ``RobotCommander.Joint``."""

    def __init__(self, robot: RobotCommander, name: str) -> None:
        self._robot, self._name = robot, name

    def name(self) -> str:
        """Its name."""
        return self._name

    def _limits(self) -> list[list[float]]:
        return self._robot._r.get_joint_limits(self._name)  # noqa: SLF001  # of the same package

    def variable_count(self) -> int:
        """Return the number of its variables."""
        return len(self._limits())

    def bounds(self) -> Any:
        """``[lower, upper]``, or a list of them if it has several variables."""
        return _one(self._limits())

    def min_bound(self) -> Any:
        """The lower limit, or a list of them."""
        return _one([low for low, _ in self._limits()])

    def max_bound(self) -> Any:
        """The upper limit, or a list of them."""
        return _one([high for _, high in self._limits()])

    def value(self) -> Any:
        """Return its present position, or a list of positions."""
        return _one(self._robot._r.get_current_joint_values(self._name))  # noqa: SLF001

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
        """Its name."""
        return self._name

    def pose(self) -> Any:
        """A ``PoseStamped``: where it is now."""
        found = self._robot._r.get_link_pose(self._name)  # noqa: SLF001  # of the same package
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

    get_planning_frame = _same()
    get_root_link = _same("get_robot_root_link")
    get_group_names = _same()
    get_current_variable_values = _same()
    has_group = _same()

    def __init__(self, robot_description: str = "robot_description", ns: str = "") -> None:
        self._robot_description, self._ns = robot_description, ns
        self._r = RobotInterface(robot_description, ns)
        self._groups: dict[str, MoveGroupCommander] = {}

    # -- names ---------------------------------------------------------------------------

    def get_joint_names(self, group: str | None = None) -> list[str]:
        """All joints, of the robot or of a group, fixed ones too.

        Raises:
            MoveItCommanderException: There is no such group.
        """
        if group is None:
            return self._r.get_joint_names()
        return self._r.get_group_joint_names(self._known(group))

    def get_active_joint_names(self, group: str | None = None) -> list[str]:
        """Joints that can be moved by themselves; see `get_joint_names`."""
        if group is None:
            return self._r.get_active_joint_names()
        return self._r.get_group_active_joint_names(self._known(group))

    def get_link_names(self, group: str | None = None) -> list[str]:
        """All links; see `get_joint_names`."""
        if group is None:
            return self._r.get_link_names()
        return self._r.get_group_link_names(self._known(group))

    def _known(self, group: str) -> str:
        if not self._r.has_group(group):
            raise MoveItCommanderException(f"no group is called '{group}'")
        return group

    # -- parts ---------------------------------------------------------------------------

    def get_joint(self, name: str) -> CommanderJoint:
        """A joint.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if name not in self._r.get_joint_names():
            raise MoveItCommanderException(f"no joint is called '{name}'")
        return CommanderJoint(self, name)

    def get_link(self, name: str) -> CommanderLink:
        """A link.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if name not in self._r.get_link_names():
            raise MoveItCommanderException(f"no link is called '{name}'")
        return CommanderLink(self, name)

    def get_group(self, name: str) -> MoveGroupCommander:
        """The commander of a group, the same one each time.

        Raises:
            MoveItCommanderException: There is none of that name.
        """
        if name not in self._groups:
            group = self._known(name)
            self._groups[name] = MoveGroupCommander(group, self._robot_description, self._ns)
        return self._groups[name]

    def get_default_owner_group(self, joint_name: str) -> str | None:
        """The group with the fewest links that a joint is in; None if it is in none."""
        owners = [
            group
            for group in self._r.get_group_names()
            if joint_name in self._r.get_group_joint_names(group)
        ]
        return min(owners, key=lambda group: len(self._r.get_group_link_names(group)), default=None)

    # -- states --------------------------------------------------------------------------

    def get_current_state(self) -> Any:
        """A ``RobotState`` of now."""
        return unpacked("moveit_msgs/RobotState", self._r.get_current_state())

    def get_robot_markers(self, *args: Any) -> Any:
        """A ``MarkerArray`` of the robot's links.

        Args:
            args: Nothing for now; a ``RobotState``; positions by joint, and perhaps links; or the name
                of a group, and perhaps positions by joint.

        Raises:
            MoveItCommanderException: It is something else.
        """
        if not args:
            made = self._r.get_robot_markers()
        elif getattr(args[0], "_type", "") == "moveit_msgs/RobotState":
            made = self._r.get_robot_markers(packed(args[0]))
        elif isinstance(args[0], dict):
            made = self._r.get_robot_markers(*args)
        elif isinstance(args[0], str):
            made = self._r.get_group_markers(*args)
        else:
            raise MoveItCommanderException(
                f"expected a RobotState, joint values or a group, not {type(args[0]).__name__}"
            )
        return unpacked("visualization_msgs/MarkerArray", made)

    def __getattr__(self, name: str) -> Any:
        """A group, joint or link of that name.

        Raises:
            AttributeError: There is none.
        """
        if name.startswith("_"):
            raise AttributeError(name)
        if self._r.has_group(name):
            return self.get_group(name)
        if name in self._r.get_joint_names():
            return CommanderJoint(self, name)
        if name in self._r.get_link_names():
            return CommanderLink(self, name)
        known = [*self._r.get_group_names(), *self._r.get_joint_names(), *self._r.get_link_names()]
        raise AttributeError(
            f"RobotCommander has no attribute, group, joint or link '{name}'; "
            f"{did_you_mean(name, known)}"
        )


def _one(values: list[Any]) -> Any:
    return values[0] if len(values) == 1 else values
