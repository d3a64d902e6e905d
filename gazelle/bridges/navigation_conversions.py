"""Conversions of goals and paths to ROS messages and back, registered on import."""

from __future__ import annotations

import numpy as np

from gazelle.bridges.conversions import (
    ConversionContext,
    Decoder,
    Encoder,
    add_decoder,
    add_encoder,
    quaternion,
    set_header,
    set_pose,
)
from gazelle.navigation.values import GoalPose, Path
from gazelle.rotations import from_yaw, yaw_of
from gazelle_ros.msgs import geometry_msgs, nav_msgs


def _goal(message: geometry_msgs.msg.PoseStamped) -> GoalPose:
    """Convert a goal; one without an orientation may be reached with any heading."""
    turned = message.pose.orientation
    heading = None
    if any((turned.x, turned.y, turned.z, turned.w)):
        heading = float(yaw_of(np.array(quaternion(turned))))
    at = message.pose.position
    return GoalPose(at.x, at.y, heading, message.header.frame_id)


def _path(message: nav_msgs.msg.Path, value: Path, view: ConversionContext) -> None:
    stamped = geometry_msgs.msg.PoseStamped
    set_header(message, view, value.stamp, value.frame)
    for x, y, yaw in value.poses[view.world].tolist():
        one = stamped(header=message.header)
        set_pose(one.pose, (x, y, 0.0), from_yaw(np.array(yaw)))
        message.poses.append(one)


add_decoder(GoalPose, Decoder("geometry_msgs/PoseStamped", _goal))
add_encoder(Path, Encoder("nav_msgs/Path", _path))
