"""Pose targets of links, as set by ``set_pose_target`` and similar."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from gazelle.bridges.conversions import pose_message
from gazelle.description import Pose
from gazelle.drop_in.moveit_client.session import LOG
from gazelle_ros.msgs import geometry_msgs, moveit_msgs, shape_msgs

TargetKind = Literal["joint", "pose", "position", "orientation"]
_SPHERE = 2
_LENGTHS = (6, 7)


def pose_of_list(values: Sequence[float]) -> Pose | None:
    """Convert ``[x, y, z, roll, pitch, yaw]`` or ``[x, y, z, qx, qy, qz, qw]``.

    None for others.
    """
    given = [float(each) for each in values]
    if len(given) not in _LENGTHS:
        LOG.error("Pose description expected to consist of either 6 or 7 values")
        return None
    if len(given) == _LENGTHS[0]:
        return Pose(*given)
    return Pose.from_quaternion(given[:3], given[3:]) if any(given[3:]) else Pose(*given[:3])


def stamped(pose: geometry_msgs.msg.Pose | None, frame: str) -> geometry_msgs.msg.PoseStamped:
    """Return a ``geometry_msgs/PoseStamped`` without a time, which is the newest known one."""
    made = geometry_msgs.msg.PoseStamped(pose=pose)
    made.header.frame_id = frame
    return made


class PoseTargets:
    """Poses for links; each link may have several, any of which will do.

    Attributes:
        link: The link that is meant where none is named; empty if there is none.
        frame: Of poses that name none.
        by_link: ``PoseStamped`` messages by link.
    """

    def __init__(self, link: str, frame: str) -> None:
        self.link, self.frame = link, frame
        self.by_link: dict[str, list[geometry_msgs.msg.PoseStamped]] = {}

    def set(self, poses: Sequence[geometry_msgs.msg.PoseStamped], link: str) -> bool:
        """Set ``PoseStamped`` messages for a link; False if there is no link or no pose."""
        if not poses:
            LOG.error("No pose specified as goal target")
            return False
        name = link or self.link
        if not name:
            LOG.error("No end-effector to set the pose for")
            return False
        self.by_link[name] = [stamped(each.pose, each.header.frame_id) for each in poses]
        return True

    def get(self, link: str) -> geometry_msgs.msg.PoseStamped:
        """Return the first target of a link; an empty message without one."""
        found = self.by_link.get(link or self.link)
        if found:
            return found[0]
        LOG.error("Pose for end-effector '%s' not known.", link or self.link)
        return geometry_msgs.msg.PoseStamped()

    def begun(self, link: str) -> geometry_msgs.msg.PoseStamped:
        """Return the target of a link that is to be changed in part: a new one without a target.

        Position and orientation are set one after the other; a target in another frame than the
        reference frame is started again, as its other half means something else here.
        """
        found = self.by_link.get(link or self.link)
        if found and found[0].header.frame_id in ("", self.frame):
            return stamped(found[0].pose, self.frame)
        return stamped(pose_message(Pose()), self.frame)

    def constraints(
        self, kind: TargetKind, position: float, orientation: float
    ) -> list[moveit_msgs.msg.Constraints]:
        """Return ``moveit_msgs/Constraints``, one for each of several goals; links share them.

        Args:
            kind: Part of the poses that counts.
            position: Tolerance [m].
            orientation: Tolerance about each axis [rad].
        """
        count = max(map(len, self.by_link.values()), default=0)
        made = [moveit_msgs.msg.Constraints() for _ in range(count)]
        for link, poses in self.by_link.items():
            for goal, pose in zip(made, poses, strict=False):
                if kind != "orientation":
                    goal.position_constraints.append(position_constraint(link, pose, position))
                if kind != "position":
                    each = orientation_constraint(link, pose, orientation)
                    goal.orientation_constraints.append(each)
        return made


def position_constraint(
    link: str, target: geometry_msgs.msg.PoseStamped, tolerance: float
) -> moveit_msgs.msg.PositionConstraint:
    """Return a ``PositionConstraint``: the link's origin within a sphere."""
    made = moveit_msgs.msg.PositionConstraint(link_name=link, weight=1.0)
    made.header = target.header
    shape = shape_msgs.msg.SolidPrimitive(type=_SPHERE, dimensions=[tolerance])
    place = pose_message(Pose())
    place.position = target.pose.position
    made.constraint_region.primitives, made.constraint_region.primitive_poses = [shape], [place]
    return made


def orientation_constraint(
    link: str, target: geometry_msgs.msg.PoseStamped, tolerance: float
) -> moveit_msgs.msg.OrientationConstraint:
    """Return an ``OrientationConstraint``."""
    made = moveit_msgs.msg.OrientationConstraint(
        link_name=link,
        orientation=target.pose.orientation,
        absolute_x_axis_tolerance=tolerance,
        absolute_y_axis_tolerance=tolerance,
        absolute_z_axis_tolerance=tolerance,
        weight=1.0,
    )
    made.header = target.header
    return made
