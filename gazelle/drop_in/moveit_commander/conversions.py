"""Messages from and to bytes and lists."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.bridges.conversions import XyzMessage
from gazelle.description import Pose
from gazelle.drop_in.moveit_client.session import packed
from gazelle.drop_in.moveit_commander.exception import MoveItCommanderException
from gazelle_ros.compat.rospy.rostime import Time
from gazelle_ros.messages import Message
from gazelle_ros.msgs import geometry_msgs

__all__ = [
    "list_to_pose",
    "list_to_pose_stamped",
    "list_to_transform",
    "msg_from_string",
    "msg_to_string",
    "pose_to_list",
    "transform_to_list",
]


def msg_to_string(msg: Message) -> bytes:
    """Serialise a message."""
    return packed(msg)


def msg_from_string(msg: Message, data: bytes) -> None:
    """Fill a message from bytes."""
    msg.deserialize(data)


def pose_to_list(pose_msg: geometry_msgs.msg.Pose) -> list[float]:
    """Return ``[x, y, z, qx, qy, qz, qw]`` of a pose."""
    return _numbers(pose_msg.position, pose_msg.orientation)


def transform_to_list(trf_msg: geometry_msgs.msg.Transform) -> list[float]:
    """Return ``[x, y, z, qx, qy, qz, qw]`` of a transform."""
    return _numbers(trf_msg.translation, trf_msg.rotation)


def list_to_pose(pose_list: Sequence[float]) -> geometry_msgs.msg.Pose:
    """Convert seven numbers, or six (x, y, z, roll, pitch, yaw), to a ``geometry_msgs/Pose``.

    Raises:
        MoveItCommanderException: It is another number.
    """
    if len(pose_list) not in (6, 7):
        raise MoveItCommanderException(
            f"a pose has x, y, z and three angles or a quaternion, not {len(pose_list)} numbers"
        )
    turn = [float(value) for value in pose_list[3:]]
    if len(turn) == 3:
        turn = list(Pose(0.0, 0.0, 0.0, *turn).quaternion)
    made = geometry_msgs.msg.Pose()
    _fill(made.position, made.orientation, [*pose_list[:3], *turn])
    return made


def list_to_pose_stamped(
    pose_list: Sequence[float], target_frame: str
) -> geometry_msgs.msg.PoseStamped:
    """Return a ``PoseStamped`` of now; see `list_to_pose`."""
    made = geometry_msgs.msg.PoseStamped(pose=list_to_pose(pose_list))
    made.header.frame_id, made.header.stamp = target_frame, Time.now()
    return made


def list_to_transform(trf_list: Sequence[float]) -> geometry_msgs.msg.Transform:
    """Convert seven numbers to a ``geometry_msgs/Transform``."""
    made = geometry_msgs.msg.Transform()
    _fill(made.translation, made.rotation, trf_list)
    return made


def _numbers(place: XyzMessage, turn: geometry_msgs.msg.Quaternion) -> list[float]:
    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]


def _fill(place: XyzMessage, turn: geometry_msgs.msg.Quaternion, values: Sequence[float]) -> None:
    place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w = values
