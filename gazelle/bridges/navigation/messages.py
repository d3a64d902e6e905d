"""Messages of the navigation stack from and to plain values."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats
from gazelle.navigation.following import Pose2
from gazelle.rotations import from_yaw, yaw_of
from gazelle_ros.builtin.scans.points import cloud_points as points_of_cloud
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs
from gazelle_ros.time import Time

_LEAST_LENGTH = 1e-6


def pose_of(message: geometry_msgs.msg.Pose) -> Pose2:
    """Convert a ``geometry_msgs/Pose``, projected to the plane."""
    place, turn = message.position, message.orientation
    return place.x, place.y, float(yaw_of(np.array([turn.x, turn.y, turn.z, turn.w])))


def fill_pose(message: geometry_msgs.msg.Pose, pose: Pose2) -> None:
    """Write a ``geometry_msgs/Pose``."""
    message.position.x, message.position.y = float(pose[0]), float(pose[1])
    x, y, z, w = from_yaw(np.array(pose[2])).tolist()
    turn = message.orientation
    turn.x, turn.y, turn.z, turn.w = x, y, z, w


def stamped(pose: Pose2, frame: str, stamp: int) -> geometry_msgs.msg.PoseStamped:
    """Return a ``geometry_msgs/PoseStamped``."""
    message = geometry_msgs.msg.PoseStamped()
    message.header.frame_id, message.header.stamp = frame, Time(nsecs=stamp)
    fill_pose(message.pose, pose)
    return message


def path_message(poses: Floats, frame: str, stamp: int) -> nav_msgs.msg.Path:
    """Return a ``nav_msgs/Path`` of poses, shape (n, 3)."""
    message = nav_msgs.msg.Path()
    message.header.frame_id, message.header.stamp = frame, Time(nsecs=stamp)
    message.poses = [stamped((x, y, yaw), frame, stamp) for x, y, yaw in poses.tolist()]
    return message


def wrong_quaternion(turn: geometry_msgs.msg.Quaternion) -> str | None:
    """Return the reason why an orientation is invalid, in move_base's words; None if valid."""
    values = np.array([turn.x, turn.y, turn.z, turn.w])
    if not np.isfinite(values).all():
        return "Quaternion has nans or infs... discarding as a navigation goal"
    length = float(np.linalg.norm(values))
    if length < _LEAST_LENGTH:
        return "Quaternion has length close to zero... discarding as navigation goal"
    x, y = (values[:2] / length).tolist()
    up = 1.0 - 2.0 * (x * x + y * y)
    if abs(up - 1.0) > 1e-3:
        return (
            "Quaternion is invalid... for navigation the z-axis of the quaternion must be close to "
            "vertical."
        )
    return None


def twist_message(velocity: tuple[float, float, float]) -> geometry_msgs.msg.Twist:
    """Return a ``geometry_msgs/Twist``."""
    message = geometry_msgs.msg.Twist()
    message.linear.x, message.linear.y, message.angular.z = (float(each) for each in velocity)
    return message


def scan_points(message: sensor_msgs.msg.LaserScan, *, inf_is_valid: bool = False) -> Floats:
    """Return the ends of a ``sensor_msgs/LaserScan``'s beams in its frame, shape (n, 3) [m].

    Args:
        message: The scan.
        inf_is_valid: Take infinite ranges for the greatest one.
    """
    ranges = np.array(message.ranges, np.float64)
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    if inf_is_valid:
        ranges = np.where(np.isposinf(ranges), message.range_max - 1e-4, ranges)
    good = (ranges >= message.range_min) & (ranges < message.range_max)
    points = np.zeros((int(good.sum()), 3))
    points[:, 0] = ranges[good] * np.cos(angles[good])
    points[:, 1] = ranges[good] * np.sin(angles[good])
    return points


def cloud_points(message: sensor_msgs.msg.PointCloud | sensor_msgs.msg.PointCloud2) -> Floats:
    """Return the points of a ``sensor_msgs/PointCloud`` or ``PointCloud2``, shape (n, 3) [m]."""
    if isinstance(message, sensor_msgs.msg.PointCloud2):
        return points_of_cloud(message)
    rows = [(each.x, each.y, each.z) for each in message.points]
    points = np.array(rows, np.float64).reshape(-1, 3)
    return points[np.isfinite(points).all(axis=1)]


def is_upside_down(rotation: tuple[float, float, float, float]) -> bool:
    """Return whether a frame's z axis points down."""
    x, y, _, _ = rotation
    return 1.0 - 2.0 * (x * x + y * y) < 0.0


def finite(value: float, otherwise: float) -> float:
    """Return a number, or another if it is not finite."""
    return value if math.isfinite(value) else otherwise
