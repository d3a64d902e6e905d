"""Between ROS messages and what the pilot works with."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.training.deploy.goals import GoalPlace
from gazelle.training.deploy.sensing import OdometryReading, ScanReading
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs, std_msgs


def scan_of(message: sensor_msgs.msg.LaserScan) -> ScanReading:
    """Convert a sensor_msgs/LaserScan to a reading."""
    return ScanReading(
        np.asarray(message.ranges, dtype=np.float32).astype(np.float64),
        float(message.angle_min),
        float(message.angle_increment),
        float(message.range_min),
        float(message.range_max),
    )


def odometry_of(message: nav_msgs.msg.Odometry) -> OdometryReading:
    """Convert a nav_msgs/Odometry to a reading."""
    place, twist = message.pose.pose, message.twist.twist
    return OdometryReading(
        float(place.position.x),
        float(place.position.y),
        yaw_of(place.orientation),
        float(twist.linear.x),
        float(twist.angular.z),
    )


def goal_of(message: geometry_msgs.msg.PoseStamped) -> GoalPlace:
    """Convert a geometry_msgs/PoseStamped to a goal."""
    place = message.pose.position
    return GoalPlace(float(place.x), float(place.y), message.header.frame_id.removeprefix("/"))


def yaw_of(quaternion: geometry_msgs.msg.Quaternion) -> float:
    """Return the angle about z of a geometry_msgs/Quaternion [rad], in [-pi, pi]."""
    x, y, z, w = quaternion.x, quaternion.y, quaternion.z, quaternion.w
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def floats_message(
    labels: Sequence[str], values: Sequence[float]
) -> std_msgs.msg.Float32MultiArray:
    """Return a std_msgs/Float32MultiArray of one dimension, with the names of its numbers as label."""
    message = std_msgs.msg.Float32MultiArray()
    dimension = std_msgs.msg.MultiArrayDimension()
    dimension.label, dimension.size, dimension.stride = ",".join(labels), len(values), len(values)
    message.layout.dim = [dimension]
    message.data = [float(value) for value in values]
    return message
