"""Poses and twists as plain numbers, and as messages."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypedDict

from gazelle.clients.errors import ClientError
from gazelle.description.pose import quaternion_from_rpy
from gazelle_ros.msgs import geometry_msgs

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class ModelState:
    """Pose and velocity of a model or link.

    Attributes:
        position: [m].
        quaternion: (x, y, z, w).
        linear: Velocity [m/s].
        angular: Angular velocity [rad/s].
    """

    position: Vector
    quaternion: Quaternion
    linear: Vector = (0.0, 0.0, 0.0)
    angular: Vector = (0.0, 0.0, 0.0)

    @property
    def yaw(self) -> float:
        """Heading [rad]."""
        x, y, z, w = self.quaternion
        return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


class ModelPlace(TypedDict, total=False):
    """Pose for placing a model: ``position`` [m] and ``rpy`` [rad] relative to ``frame``."""

    position: Vector
    rpy: Vector
    frame: str


class SpawnOptions(ModelPlace, total=False):
    """`ModelPlace` with the ``namespace`` of the topics of a spawned model."""

    namespace: str


def three(value: Sequence[float], what: str) -> Vector:
    """Return three numbers.

    Raises:
        ClientError: They are not three.
    """
    if len(value) != 3:
        raise ClientError(f"{what} is three numbers, not {len(value)}: {tuple(value)}")
    x, y, z = value
    return (x, y, z)


def read_state(pose: geometry_msgs.msg.Pose, twist: geometry_msgs.msg.Twist) -> ModelState:
    """Return the numbers of a ``Pose`` and a ``Twist``."""
    turn = pose.orientation
    return ModelState(
        _triple(pose.position),
        (turn.x, turn.y, turn.z, turn.w),
        _triple(twist.linear),
        _triple(twist.angular),
    )


def pose_message(position: Vector, rpy: Vector) -> geometry_msgs.msg.Pose:
    """Return a ``geometry_msgs/Pose`` [m, rad]; roll, pitch and yaw about fixed axes."""
    pose = geometry_msgs.msg.Pose()
    pose.position.x, pose.position.y, pose.position.z = three(position, "a position")
    turn = pose.orientation
    turn.x, turn.y, turn.z, turn.w = quaternion_from_rpy(*three(rpy, "roll, pitch and yaw"))
    return pose


def twist_message(linear: Vector, angular: Vector) -> geometry_msgs.msg.Twist:
    """Return a ``geometry_msgs/Twist`` [m/s, rad/s]."""
    twist = geometry_msgs.msg.Twist()
    twist.linear.x, twist.linear.y, twist.linear.z = three(linear, "a velocity")
    twist.angular.x, twist.angular.y, twist.angular.z = three(angular, "an angular velocity")
    return twist


def _triple(message: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3) -> Vector:
    return (message.x, message.y, message.z)
