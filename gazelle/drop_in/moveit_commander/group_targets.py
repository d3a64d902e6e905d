"""The targets of ``MoveGroupCommander``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.bridges.conversions import pose_message, pose_of_message
from gazelle.description import Pose
from gazelle.drop_in.moveit_client.pose_targets import TargetKind, pose_of_list, stamped
from gazelle.drop_in.moveit_client.request_settings import here
from gazelle.drop_in.moveit_client.session import LOG, copied
from gazelle.drop_in.moveit_commander import conversions
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle.drop_in.moveit_commander.group_state import GroupState
from gazelle_ros.msgs import geometry_msgs, moveit_msgs, sensor_msgs

if TYPE_CHECKING:
    AnyPose = geometry_msgs.msg.Pose | geometry_msgs.msg.PoseStamped | Sequence[float]

_BOUNDS = "these joint values are no goal: a joint is unknown, or beyond its limits"
_TURNS, _AXES = 3, 6


class GroupTargets(GroupState):
    """Goals of a group: joints, or poses of links. What was set last counts."""

    _kind: TargetKind = "joint"

    def set_end_effector_link(self, link_name: str) -> None:
        """Set the link that poses are of; they are the goal from now on.

        Raises:
            MoveItCommanderException: The group is no chain, and has none.
        """
        if not self._set_link(link_name):
            raise MoveItCommanderException(f"no link is called '{link_name}'")

    # -- joints --------------------------------------------------------------------------

    def get_joint_value_target(self) -> list[float]:
        """Return the requested values of all variables."""
        return self._joints.values

    def set_random_target(self) -> None:
        """Set positions drawn between the limits."""
        self._joints.set_random()
        self._kind = "joint"

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
            done = self._set_joints(arg1, arg2)
        elif kind == "sensor_msgs/JointState":
            done = self._set_joint_state(arg1)
        elif hasattr(arg1, "__iter__"):
            done = self._set_joints(arg1)
        else:
            raise MoveItCommanderException(
                f"expected joint values, a JointState, a Pose or a joint, not {type(arg1).__name__}"
            )
        if not done:
            raise MoveItCommanderException(_BOUNDS)

    def _set_by_pose(
        self, pose: geometry_msgs.msg.Pose | geometry_msgs.msg.PoseStamped, *more: object
    ) -> None:
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
        stamped_pose = hasattr(pose, "header")
        setter: Any = self._set_joints_by_stamped if stamped_pose else self._set_joints_by
        if not setter(pose, link, approximate):
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
        if not self._set_named(name):
            raise MoveItCommanderException(
                f"no posture '{name}' is known, or it is beyond the limits of a joint"
            )

    def set_pose_target(self, pose: AnyPose, end_effector_link: str = "") -> None:
        """Set a ``Pose``, a ``PoseStamped``, or a list of six or seven numbers for a link.

        Raises:
            MoveItCommanderException: There is no link, or the pose is none.
        """
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        frame = getattr(getattr(pose, "header", None), "frame_id", None)
        old = self._poses.frame
        self._poses.frame = old if frame is None else frame
        try:
            done = self._set_pose(listed(pose), end_effector_link)
        finally:
            self._poses.frame = old
        if not done:
            raise MoveItCommanderException("that pose is no goal: is there a link to bring to it?")

    def set_pose_targets(self, poses: Sequence[AnyPose], end_effector_link: str = "") -> None:
        """Set several poses, any of which will do."""
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        if not self._set_each_pose([listed(pose) for pose in poses], end_effector_link):
            raise MoveItCommanderException(
                "these poses are no goal: is there a link to bring to one?"
            )

    def set_position_target(self, xyz: Sequence[float], end_effector_link: str = "") -> None:
        """Set a position of a link; any orientation will do."""
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        if not self._set_position(xyz[0], xyz[1], xyz[2], end_effector_link):
            raise MoveItCommanderException(
                "that position is no goal: is there a link to bring to it?"
            )

    def set_rpy_target(self, rpy: Sequence[float], end_effector_link: str = "") -> None:
        """Set ``[roll, pitch, yaw]`` of a link [rad]; any position will do."""
        self._set_turn(self._set_rpy, rpy, "[roll, pitch, yaw]", end_effector_link)

    def set_orientation_target(self, q: Sequence[float], end_effector_link: str = "") -> None:
        """Set the quaternion ``[qx, qy, qz, qw]`` of a link; any position will do."""
        self._set_turn(self._set_orientation, q, "[qx, qy, qz, qw]", end_effector_link)

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
            value: Distance from there [m or rad].
            end_effector_link: The link.
        """
        self._needs_link(end_effector_link, "which link? The group has no end effector")
        if not 0 <= axis < _AXES:
            raise MoveItCommanderException(
                f"axes are numbered from 0 to 5; there is no axis {axis}"
            )
        pose = self._current_pose(end_effector_link)
        if axis >= _TURNS:
            pose[3:] = Pose.from_quaternion(pose[:3], pose[3:]).rpy
        pose[axis] += value
        self.set_pose_target(pose, end_effector_link)

    def clear_pose_target(self, end_effector_link: str = "") -> None:
        """Remove the pose targets of a link."""
        self._poses.by_link.pop(end_effector_link, None)

    def clear_pose_targets(self) -> None:
        """Remove the pose targets of all links."""
        self._poses.by_link.clear()

    # -- start ---------------------------------------------------------------------------

    def set_start_state(self, msg: moveit_msgs.msg.RobotState) -> None:
        """Set a ``RobotState`` as start of plans."""
        self._settings.start = copied(moveit_msgs.msg.RobotState, msg)

    def set_start_state_to_current_state(self) -> None:
        """Set the robot's present state as start of plans."""
        self._settings.start = here()

    # -- as MoveIt's C++ class: they return success ----------------------------

    def _set_joints(
        self,
        target: Mapping[str, float] | Iterable[float] | str,
        values: Sequence[float] | float | None = None,
    ) -> bool:
        """Set all variables in order, some by name, or one joint and its value.

        Returns:
            Whether the names are there, and the values within limits.
        """
        self._kind = "joint"
        self._joints.margin = self._settings.tolerances["joint"]
        if isinstance(target, str):
            return values is not None and self._joints.set_joint(target, values)
        if isinstance(target, Mapping):
            return self._joints.set_named(target)
        return self._joints.set_all(target)

    def _set_joint_state(self, message: sensor_msgs.msg.JointState) -> bool:
        """Set the values of a ``sensor_msgs/JointState``."""
        if len(message.name) != len(message.position):
            LOG.error("sizes of name and position arrays do not match")
            return False
        return self._set_joints(dict(zip(message.name, message.position, strict=True)))

    def _set_joints_by(self, pose: geometry_msgs.msg.Pose, eef: str, approx: bool) -> bool:  # noqa: FBT001  # MoveIt's interface
        """Set joints that move a link to a ``geometry_msgs/Pose``; False if there are none."""
        return self._solve(pose_of_message(pose), eef, approximate=approx)

    def _set_joints_by_stamped(
        self,
        pose: geometry_msgs.msg.PoseStamped,
        eef: str,
        approx: bool,  # noqa: FBT001
    ) -> bool:
        """Set joints by a ``PoseStamped`` likewise, in the frame of a link of the robot."""
        frame = pose.header.frame_id.lstrip("/")
        robot = self._access.robot
        base = Pose()
        if frame not in ("", robot.frame):
            if frame not in robot.links:
                LOG.error("Unable to transform from frame '%s' to frame '%s'", frame, robot.frame)
                return False
            base = robot.pose(self._access.known(), frame)
        return self._solve(base * pose_of_message(pose.pose), eef, approximate=approx)

    def _solve(self, pose: Pose, link: str, *, approximate: bool) -> bool:
        name = link or self._poses.link
        start = self._access.current()
        if not name or start is None:
            return False
        self._kind = "joint"
        begun = self._access.with_message(self._settings.start, start)
        return self._joints.set_pose(
            pose, name, start if begun is None else begun, approximate=approximate
        )

    def _set_named(self, name: str) -> bool:
        """Set a remembered posture, or one of the SRDF; False if there is none of that name."""
        if name in self._remembered:
            return self._set_joints(self._remembered[name])
        found = self._joints.set_state(name)
        self._kind = "joint" if found else self._kind
        return found

    def _set_link(self, link_name: str) -> bool:
        """Set the link that poses are of; they are the goal from now on."""
        if not self._poses.link or not link_name:
            return False
        self._poses.link, self._kind = link_name, "pose"
        return True

    def _set_pose(self, pose: Sequence[float], end_effector_link: str = "") -> bool:
        """Set a pose of six or seven numbers, in the reference frame."""
        found = pose_of_list(pose)
        return found is not None and self._set_poses([found], end_effector_link)

    def _set_each_pose(self, poses: Sequence[Sequence[float]], end_effector_link: str = "") -> bool:
        """Set several poses, any of which will do."""
        found = [made for each in poses if (made := pose_of_list(each)) is not None]
        return self._set_poses(found, end_effector_link)

    def _set_poses(self, poses: Sequence[Pose], link: str) -> bool:
        if poses:
            self._kind = "pose"
        frame = self._poses.frame
        return self._poses.set([stamped(pose_message(pose), frame) for pose in poses], link)

    def _set_position(self, x: float, y: float, z: float, end_effector_link: str = "") -> bool:
        """Set a position; any orientation will do."""
        target = self._poses.begun(end_effector_link)
        place = target.pose.position
        place.x, place.y, place.z = float(x), float(y), float(z)
        return self._set_part(target, end_effector_link, "position")

    def _set_rpy(self, r: float, p: float, y: float, end_effector_link: str = "") -> bool:
        """Set an orientation by roll, pitch and yaw [rad]; any position will do."""
        return self._set_orientation(*Pose(roll=r, pitch=p, yaw=y).quaternion, end_effector_link)

    def _set_orientation(
        self, x: float, y: float, z: float, w: float, end_effector_link: str = ""
    ) -> bool:
        """Set an orientation by a quaternion; any position will do."""
        target = self._poses.begun(end_effector_link)
        turn = target.pose.orientation
        turn.x, turn.y, turn.z, turn.w = float(x), float(y), float(z), float(w)
        return self._set_part(target, end_effector_link, "orientation")

    def _set_part(self, target: geometry_msgs.msg.PoseStamped, link: str, kind: TargetKind) -> bool:
        found = self._poses.set([target], link)
        self._kind = kind
        return found

    def _goals(self) -> list[moveit_msgs.msg.Constraints]:
        """Return the goal as constraints, any of which will do."""
        tolerances = self._settings.tolerances
        if self._kind == "joint":
            return [self._joints.constraints(tolerances["joint"])]
        return self._poses.constraints(
            self._kind, tolerances["position"], tolerances["orientation"]
        )


def listed(pose: AnyPose) -> list[float]:
    """Return the numbers of a ``Pose`` or ``PoseStamped``; a list as it is."""
    found: Any = getattr(pose, "pose", pose)
    return conversions.pose_to_list(found) if hasattr(found, "orientation") else list(found)
