"""The part of ``MoveGroupInterface`` that says where to go."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from gazelle.bridges.moveit.client.group_base import GroupBase
from gazelle.bridges.moveit.client.pose_targets import TargetKind, pose_of_list, stamped
from gazelle.bridges.moveit.client.request_settings import here
from gazelle.bridges.moveit.client.session import LOG, unpacked
from gazelle.bridges.moveit.frames import pose_message, pose_of_message
from gazelle.description import Pose


class GroupTargets(GroupBase):
    """Goals of a group: joints, or poses of links. What was set last counts."""

    _kind: TargetKind = "joint"

    # -- joints --------------------------------------------------------------------------

    def set_joint_value_target(
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

    def set_joint_value_target_from_joint_state_message(self, message: bytes) -> bool:
        """Set what a ``sensor_msgs/JointState`` says."""
        found = unpacked("sensor_msgs/JointState", message)
        if len(found.name) != len(found.position):
            LOG.error("sizes of name and position arrays do not match")
            return False
        return self.set_joint_value_target(dict(zip(found.name, found.position, strict=True)))

    def set_joint_value_target_from_pose(self, pose: bytes, eef: str, approx: bool) -> bool:  # noqa: FBT001  # MoveIt's interface
        """Set joints that bring a link to a ``geometry_msgs/Pose``; False if there are none."""
        found = unpacked("geometry_msgs/Pose", pose)
        return self._set_by_pose(pose_of_message(found), eef, approximate=approx)

    def set_joint_value_target_from_pose_stamped(self, pose: bytes, eef: str, approx: bool) -> bool:  # noqa: FBT001
        """Likewise of a ``PoseStamped``, in the frame of a link of the robot."""
        found = unpacked("geometry_msgs/PoseStamped", pose)
        frame = found.header.frame_id.lstrip("/")
        robot = self._access.robot
        base = Pose()
        if frame not in ("", robot.frame):
            if frame not in robot.links:
                LOG.error("Unable to transform from frame '%s' to frame '%s'", frame, robot.frame)
                return False
            base = robot.pose(self._access.known(), frame)
        return self._set_by_pose(base * pose_of_message(found.pose), eef, approximate=approx)

    def _set_by_pose(self, pose: Pose, link: str, *, approximate: bool) -> bool:
        name = link or self._poses.link
        start = self._access.current()
        if not name or start is None:
            return False
        self._kind = "joint"
        begun = self._access.with_message(self._settings.start, start)
        return self._joints.set_pose(
            pose, name, start if begun is None else begun, approximate=approximate
        )

    def get_joint_value_target(self) -> list[float]:
        """Values of all variables that are wanted."""
        return self._joints.values

    def set_named_target(self, name: str) -> bool:
        """Set a remembered posture, or one of the SRDF; False if there is none of that name."""
        if name in self._remembered:
            return self.set_joint_value_target(self._remembered[name])
        found = self._joints.set_state(name)
        self._kind = "joint" if found else self._kind
        return found

    def set_random_target(self) -> None:
        """Set positions drawn between the limits."""
        self._joints.set_random()
        self._kind = "joint"

    # -- poses ---------------------------------------------------------------------------

    def set_end_effector_link(self, link_name: str) -> bool:
        """Set the link that poses are of; they are the goal from now on."""
        found = super().set_end_effector_link(link_name)
        self._kind = "pose" if found else self._kind
        return found

    def set_pose_target(self, pose: Sequence[float], end_effector_link: str = "") -> bool:
        """Set a pose of six or seven numbers, in the reference frame."""
        found = pose_of_list(pose)
        return found is not None and self._set_poses([found], end_effector_link)

    def set_pose_targets(
        self, poses: Sequence[Sequence[float]], end_effector_link: str = ""
    ) -> bool:
        """Set several poses, any of which will do."""
        found = [made for each in poses if (made := pose_of_list(each)) is not None]
        return self._set_poses(found, end_effector_link)

    def _set_poses(self, poses: Sequence[Pose], link: str) -> bool:
        if poses:
            self._kind = "pose"
        frame = self._poses.frame
        return self._poses.set([stamped(pose_message(pose), frame) for pose in poses], link)

    def set_position_target(
        self, x: float, y: float, z: float, end_effector_link: str = ""
    ) -> bool:
        """Set a position; any orientation will do."""
        target = self._poses.begun(end_effector_link)
        place = target.pose.position
        place.x, place.y, place.z = float(x), float(y), float(z)
        return self._set_part(target, end_effector_link, "position")

    def set_rpy_target(self, r: float, p: float, y: float, end_effector_link: str = "") -> bool:
        """Set an orientation by roll, pitch and yaw [rad]; any position will do."""
        return self.set_orientation_target(
            *Pose(roll=r, pitch=p, yaw=y).quaternion, end_effector_link
        )

    def set_orientation_target(
        self, x: float, y: float, z: float, w: float, end_effector_link: str = ""
    ) -> bool:
        """Set an orientation by a quaternion; any position will do."""
        target = self._poses.begun(end_effector_link)
        turn = target.pose.orientation
        turn.x, turn.y, turn.z, turn.w = float(x), float(y), float(z), float(w)
        return self._set_part(target, end_effector_link, "orientation")

    def _set_part(self, target: Any, link: str, kind: TargetKind) -> bool:
        found = self._poses.set([target], link)
        self._kind = kind
        return found

    def clear_pose_target(self, end_effector_link: str = "") -> None:
        """Forget the poses of a link."""
        self._poses.by_link.pop(end_effector_link, None)

    def clear_pose_targets(self) -> None:
        """Forget the poses of all links."""
        self._poses.by_link.clear()

    # -- start ---------------------------------------------------------------------------

    def set_start_state(self, message: bytes) -> None:
        """Let plans begin at a ``RobotState``."""
        self._settings.start = unpacked("moveit_msgs/RobotState", message)

    def set_start_state_to_current_state(self) -> None:
        """Let plans begin where the robot is."""
        self._settings.start = here()

    def _goals(self) -> list[Any]:
        """The goal as constraints, any of which will do."""
        tolerances = self._settings.tolerances
        if self._kind == "joint":
            return [self._joints.constraints(tolerances["joint"])]
        return self._poses.constraints(
            self._kind, tolerances["position"], tolerances["orientation"]
        )
