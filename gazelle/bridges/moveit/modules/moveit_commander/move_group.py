"""``MoveGroupCommander``: plans and moves a group of joints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from gazelle.bridges.moveit.client.move_group_interface import MoveGroupInterface
from gazelle.bridges.moveit.client.session import packed, unpacked
from gazelle.bridges.moveit.modules.moveit_commander import conversions
from gazelle.bridges.moveit.modules.moveit_commander.commander_settings import CommanderSettings
from gazelle.bridges.moveit.modules.moveit_commander.exception import MoveItCommanderException
from gazelle.description import Pose
from gazelle.planning import PlanOutcome
from gazelle.ros.messages import load_message

__all__ = ["MoveGroupCommander"]

_BOUNDS = "these joint values are no goal: a joint is unknown, or beyond its limits"
_TURNS, _AXES = 3, 6


class MoveGroupCommander(CommanderSettings):
    """Simple commands for a group.

    Args:
        name: Of the group.
        robot_description: Parameter of the robot.
        ns: Namespace of ``move_group``.
        wait_for_servers: The longest wait for it [s]; for ever if 0.

    Raises:
        RuntimeError: There is no robot, no such group, or no ``move_group``.
    """

    def __init__(
        self,
        name: str,
        robot_description: str = "robot_description",
        ns: str = "",
        wait_for_servers: float = 5.0,
    ) -> None:
        self._g = MoveGroupInterface(name, robot_description, ns, wait_for_servers)

    # -- where it is ---------------------------------------------------------------------

    def get_current_pose(self, end_effector_link: str = "") -> Any:
        """A ``PoseStamped``: where a link is now, the end effector's by default."""
        self._needs_link(
            end_effector_link, "the group has no end effector whose pose this could be"
        )
        return self._stamped(self._g.get_current_pose(end_effector_link))

    def get_random_pose(self, end_effector_link: str = "") -> Any:
        """A ``PoseStamped`` that the group can reach."""
        self._needs_link(
            end_effector_link, "the group has no end effector whose pose this could be"
        )
        return self._stamped(self._g.get_random_pose(end_effector_link))

    def get_current_rpy(self, end_effector_link: str = "") -> list[float]:
        """``[roll, pitch, yaw]`` of a link now [rad]."""
        self._needs_link(
            end_effector_link, "the group has no end effector whose angles these could be"
        )
        return self._g.get_current_rpy(end_effector_link)

    def get_current_state(self) -> Any:
        """A ``RobotState`` of the whole robot now."""
        return unpacked("moveit_msgs/RobotState", self._g.get_current_state())

    def get_current_state_bounded(self) -> Any:
        """A ``RobotState`` of now, joints within their limits."""
        made: Any = load_message("moveit_msgs/RobotState")()
        positions = self._g.get_current_state_bounded()
        made.joint_state.header.frame_id = self.get_planning_frame()
        made.joint_state.name, made.joint_state.position = [*positions], [*positions.values()]
        return made

    def enforce_bounds(self, robot_state_msg: Any) -> Any:
        """A ``RobotState`` with joints moved to their limits.

        Raises:
            DeserializationError: It names no joints.
        """
        bounded = self._g.enforce_bounds(packed(robot_state_msg))
        return unpacked("moveit_msgs/RobotState", bounded)

    def _stamped(self, pose: Sequence[float]) -> Any:
        return conversions.list_to_pose_stamped(pose, self.get_planning_frame())

    def _needs_link(self, link: str, words: str) -> None:
        if not link and not self.has_end_effector_link():
            raise MoveItCommanderException(words)

    # -- goals ---------------------------------------------------------------------------

    def set_joint_value_target(self, arg1: Any, arg2: Any = None, arg3: Any = None) -> None:
        """Set where joints shall be.

        Args:
            arg1: A ``JointState``, a mapping, values of all variables, the name of a joint, or a
                ``Pose`` or ``PoseStamped`` that one solution of inverse kinematics is set for.
            arg2: The value of a joint that is named; for a pose the link, or whether less will do.
            arg3: For a pose, the other one of these.

        Raises:
            MoveItCommanderException: It cannot be, or an argument is wrong.
        """
        kind = getattr(arg1, "_type", "")
        if kind in ("geometry_msgs/Pose", "geometry_msgs/PoseStamped"):
            self._set_by_pose(arg1, arg2, arg3)
            return
        if arg3 is not None or (arg2 is not None and not isinstance(arg1, str)):
            raise MoveItCommanderException("expected a joint and its value, or one argument alone")
        if isinstance(arg1, str):
            if arg2 is None:
                raise MoveItCommanderException(f"which value for the joint '{arg1}'?")
            done = self._g.set_joint_value_target(arg1, arg2)
        elif kind == "sensor_msgs/JointState":
            done = self._g.set_joint_value_target_from_joint_state_message(packed(arg1))
        elif hasattr(arg1, "__iter__"):
            done = self._g.set_joint_value_target(arg1)
        else:
            raise MoveItCommanderException(
                f"expected joint values, a JointState, a Pose or a joint, not {type(arg1).__name__}"
            )
        if not done:
            raise MoveItCommanderException(_BOUNDS)

    def _set_by_pose(self, pose: Any, *more: Any) -> None:
        link, approximate = "", False
        for each in more:
            if isinstance(each, bool):
                approximate = each
            elif isinstance(each, str):
                link = each
            elif each is not None:
                raise MoveItCommanderException(
                    f"expected a link or whether to approximate, not {type(each).__name__}"
                )
        named = hasattr(pose, "header")
        setter = (
            self._g.set_joint_value_target_from_pose_stamped
            if named
            else self._g.set_joint_value_target_from_pose
        )
        if not setter(packed(pose), link, approximate):
            raise MoveItCommanderException(
                "inverse kinematics finds no joint values near that pose"
                if approximate
                else "inverse kinematics finds no joint values for that pose"
            )

    def set_named_target(self, name: str) -> None:
        """Set a remembered posture, or one of the SRDF.

        Raises:
            MoveItCommanderException: There is none of that name, or it is beyond limits.
        """
        if not self._g.set_named_target(name):
            raise MoveItCommanderException(
                f"no posture '{name}' is known, or it is beyond the limits of a joint"
            )

    def set_pose_target(self, pose: Any, end_effector_link: str = "") -> None:
        """Set a ``Pose``, a ``PoseStamped``, or a list of six or seven numbers for a link.

        Raises:
            MoveItCommanderException: There is no link, or the pose is none.
        """
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        frame = getattr(getattr(pose, "header", None), "frame_id", None)
        if not self._in_frame(
            frame, lambda: self._g.set_pose_target(_listed(pose), end_effector_link)
        ):
            raise MoveItCommanderException("that pose is no goal: is there a link to bring to it?")

    def set_pose_targets(self, poses: Sequence[Any], end_effector_link: str = "") -> None:
        """Set several poses, any of which will do."""
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        if not self._g.set_pose_targets([_listed(pose) for pose in poses], end_effector_link):
            raise MoveItCommanderException(
                "these poses are no goal: is there a link to bring to one?"
            )

    def set_position_target(self, xyz: Sequence[float], end_effector_link: str = "") -> None:
        """Set a position of a link; any orientation will do."""
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        if not self._g.set_position_target(xyz[0], xyz[1], xyz[2], end_effector_link):
            raise MoveItCommanderException(
                "that position is no goal: is there a link to bring to it?"
            )

    def set_rpy_target(self, rpy: Sequence[float], end_effector_link: str = "") -> None:
        """Set ``[roll, pitch, yaw]`` of a link [rad]; any position will do."""
        self._set_turn(self._g.set_rpy_target, rpy, "[roll, pitch, yaw]", end_effector_link)

    def set_orientation_target(self, q: Sequence[float], end_effector_link: str = "") -> None:
        """Set the quaternion ``[qx, qy, qz, qw]`` of a link; any position will do."""
        self._set_turn(self._g.set_orientation_target, q, "[qx, qy, qz, qw]", end_effector_link)

    def _set_turn(self, setter: Any, values: Sequence[float], form: str, link: str) -> None:
        self._needs_link(link, "which link? The group has no end effector")
        if len(values) != len(form.split(",")):
            raise MoveItCommanderException(f"expected {form}, not {list(values)}")
        if not setter(*values, link):
            raise MoveItCommanderException(
                "that orientation is no goal: is there a link to turn to it?"
            )

    def shift_pose_target(self, axis: int, value: float, end_effector_link: str = "") -> None:
        """Set where a link is now but for one axis: 0 to 5 for x, y, z, roll, pitch, yaw.

        Args:
            axis: Its number.
            value: How far from there [m or rad].
            end_effector_link: The link.
        """
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        if not 0 <= axis < _AXES:
            raise MoveItCommanderException(
                f"axes are numbered from 0 to 5; there is no axis {axis}"
            )
        pose = self._g.get_current_pose(end_effector_link)
        if axis >= _TURNS:
            pose[3:] = Pose.from_quaternion(pose[:3], pose[3:]).rpy
        pose[axis] += value
        self.set_pose_target(pose, end_effector_link)

    # -- motions -------------------------------------------------------------------------

    def go(self, joints: Any = None, wait: bool = True) -> bool:  # noqa: FBT001, FBT002  # MoveIt's interface
        """Plan and go: to what is given, else to the target that is set; whether it arrived.

        Args:
            joints: A ``JointState``, a ``Pose``, the name of a remembered posture, a mapping or
                values of all variables; a bool stands for ``wait``.
            wait: Whether to wait for the end.
        """
        if isinstance(joints, bool):
            joints, wait = None, joints
        self._set_any(joints)
        return self._g.move() if wait else self._g.async_move()

    def plan(self, joints: Any = None) -> tuple[bool, Any, float, Any]:
        """Plan, as for `go`.

        Returns:
            Whether there is a plan, a ``RobotTrajectory``, the time that it took [s], and the
            ``MoveItErrorCodes``.
        """
        self._set_any(joints)
        code, trajectory, seconds = self._g.plan()
        error = unpacked("moveit_msgs/MoveItErrorCodes", code)
        found = unpacked("moveit_msgs/RobotTrajectory", trajectory)
        return error.val == PlanOutcome.SUCCESS, found, seconds, error

    def _set_any(self, target: Any) -> None:
        if target is None:
            return
        if getattr(target, "_type", "") == "geometry_msgs/Pose":
            self.set_pose_target(target)
        elif isinstance(target, str) and target in self._g.get_remembered_joint_values():
            self.set_joint_value_target(self._g.get_remembered_joint_values()[target])
        else:
            self.set_joint_value_target(target)

    def execute(self, plan_msg: Any, wait: bool = True) -> bool:  # noqa: FBT001, FBT002
        """Go along a ``RobotTrajectory``, a ``JointTrajectory`` or what `plan` gave."""
        found = plan_msg[1] if isinstance(plan_msg, tuple) else plan_msg
        if not hasattr(found, "joint_trajectory"):
            found = load_message("moveit_msgs/RobotTrajectory")(joint_trajectory=found)
        return self._g.execute(packed(found)) if wait else self._g.async_execute(packed(found))

    def compute_cartesian_path(
        self,
        waypoints: Sequence[Any],
        eef_step: float,
        jump_threshold: Any = 0.0,
        avoid_collisions: Any = True,  # noqa: FBT002
        path_constraints: Any = None,
    ) -> tuple[Any, float]:
        """A ``RobotTrajectory`` along straight ways of the end effector.

        Args:
            waypoints: ``Pose`` messages.
            eef_step: Longest step [m].
            jump_threshold: Not read, as in MoveIt since 1.1.15; a bool stands for the next one.
            avoid_collisions: Whether to end where it would collide.
            path_constraints: ``Constraints`` that hold all along.

        Returns:
            The trajectory, and how much of the way that is, from 0 to 1.
        """
        if isinstance(jump_threshold, bool):
            if not isinstance(avoid_collisions, bool):
                path_constraints = path_constraints or avoid_collisions
            jump_threshold, avoid_collisions = 0.0, jump_threshold
        if path_constraints and not hasattr(path_constraints, "joint_constraints"):
            raise MoveItCommanderException(
                f"expected moveit_msgs/Constraints, not {type(path_constraints).__name__}"
            )
        path, fraction = self._g.compute_cartesian_path(
            [_listed(pose) for pose in waypoints],
            eef_step,
            jump_threshold,
            avoid_collisions,
            packed(path_constraints) if path_constraints else None,
        )
        return unpacked("moveit_msgs/RobotTrajectory", path), fraction

    def retime_trajectory(
        self,
        ref_state_in: Any,
        traj_in: Any,
        velocity_scaling_factor: float = 1.0,
        acceleration_scaling_factor: float = 1.0,
        algorithm: str = "iterative_time_parameterization",
    ) -> Any:
        """A ``RobotTrajectory`` along the same path with other times."""
        made = self._g.retime_trajectory(
            packed(ref_state_in),
            packed(traj_in),
            velocity_scaling_factor,
            acceleration_scaling_factor,
            algorithm,
        )
        return unpacked("moveit_msgs/RobotTrajectory", made)

    # -- objects -------------------------------------------------------------------------

    def attach_object(
        self, object_name: str, link_name: str = "", touch_links: Sequence[str] = ()
    ) -> bool:
        """Have a link hold a thing of the scene, the end effector's by default."""
        return self._g.attach_object(object_name, link_name, touch_links)

    def pick(self, object_name: str, grasp: Any = (), plan_only: bool = False) -> int:  # noqa: FBT001, FBT002
        """Pick a thing up with one of some ``Grasp`` messages; the error code."""
        given = [grasp] if isinstance(grasp, load_message("moveit_msgs/Grasp")) else list(grasp)
        return self._g.pick(object_name, [packed(each) for each in given], plan_only)

    def place(self, object_name: str, location: Any = None, plan_only: bool = False) -> bool:  # noqa: FBT001, FBT002
        """Place what is held at a ``Pose``, ``PoseStamped`` or ``PlaceLocation``, or anywhere.

        Raises:
            MoveItCommanderException: The location is none of these.
        """
        if not location:
            return self._g.place(object_name, plan_only)
        given = location if isinstance(location, list) else [location]
        kinds = {getattr(each, "_type", "") for each in given}
        if kinds == {"moveit_msgs/PlaceLocation"}:
            return self._g.place_locations_list(
                object_name, [packed(each) for each in given], plan_only
            )
        if kinds == {"geometry_msgs/PoseStamped"}:
            return self._g.place_poses_list(
                object_name, [packed(each) for each in given], plan_only
            )
        if kinds == {"geometry_msgs/Pose"} and not isinstance(location, list):
            return self._g.place(object_name, _listed(location), plan_only)
        raise MoveItCommanderException(
            "expected a Pose or PoseStamped to place at, a PlaceLocation, or a list of the latter two"
        )


def _listed(pose: Any) -> Any:
    """The numbers of a ``Pose`` or ``PoseStamped``; a list as it is."""
    found = getattr(pose, "pose", pose)
    return conversions.pose_to_list(found) if hasattr(found, "orientation") else list(found)
