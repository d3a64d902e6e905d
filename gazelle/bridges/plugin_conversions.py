"""Conversions of the values of plugin ports to ROS messages and back, registered on import."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.bridges import navigation_conversions  # noqa: F401  it teaches goals and paths
from gazelle.bridges.conversions import (
    ConversionContext,
    Decoder,
    Encoder,
    ServiceCodec,
    add_decoder,
    add_encoder,
    add_service,
    point,
    quaternion,
)
from gazelle.simulation.values import (
    DriveCommand,
    EmergencyStop,
    Flags,
    JointPath,
    LinkName,
    LinkPair,
    Number,
    PathRequest,
    Push,
    ServiceOutcome,
    TurnCommand,
)
from gazelle_ros.msgs import (
    gazebo_msgs,
    gazebo_ros_link_attacher,
    geometry_msgs,
    std_msgs,
    trajectory_msgs,
)


def _push(message: geometry_msgs.msg.Wrench) -> Push:
    return Push(point(message.force), point(message.torque))


def _link_pair(request: gazebo_ros_link_attacher.srv.AttachRequest) -> LinkPair:
    return LinkPair(
        request.model_name_1, request.link_name_1, request.model_name_2, request.link_name_2
    )


def _path(message: trajectory_msgs.msg.JointTrajectory) -> JointPath:
    """Convert a path; points without positions are left out."""
    count = len(message.joint_names)
    points = [each for each in message.points if len(each.positions) == count]
    return JointPath(
        tuple(message.joint_names),
        np.array([each.time_from_start.to_sec() for each in points], np.float64),
        np.array([each.positions for each in points], np.float64).reshape(len(points), count),
        message.header.stamp.to_nsec(),
    )


def _path_request(request: gazebo_msgs.srv.SetJointTrajectoryRequest) -> PathRequest:
    path = _path(request.joint_trajectory)
    if not request.set_model_pose:
        return PathRequest(path)
    pose = request.model_pose
    return PathRequest(path, point(pose.position), quaternion(pose.orientation))


def _outcome(answer: ServiceOutcome) -> dict[str, Any]:
    return {"success": answer.success, "status_message": answer.text}


def _flags(message: std_msgs.msg.Bool, value: Flags, view: ConversionContext) -> None:
    message.data = bool(value.values[view.world])


add_encoder(Flags, Encoder("std_msgs/Bool", _flags))
add_decoder(JointPath, Decoder("trajectory_msgs/JointTrajectory", _path))
add_service(
    PathRequest,
    ServiceOutcome,
    ServiceCodec("gazebo_msgs/SetJointTrajectory", _path_request, _outcome),
)
add_decoder(
    EmergencyStop, Decoder("std_msgs/Bool", lambda message: EmergencyStop(bool(message.data)))
)
add_decoder(
    DriveCommand,
    Decoder("usv_msgs/UsvDrive", lambda message: DriveCommand(message.left, message.right)),
)
add_decoder(Number, Decoder("std_msgs/Float32", lambda message: Number(message.data)))
add_decoder(
    TurnCommand,
    Decoder(
        "geometry_msgs/QuaternionStamped",
        lambda message: TurnCommand(message.header.frame_id, quaternion(message.quaternion)),
    ),
)
add_decoder(Push, Decoder("geometry_msgs/Wrench", _push))
add_service(
    LinkPair,
    bool,
    ServiceCodec("gazebo_ros_link_attacher/Attach", _link_pair, lambda answer: {"ok": answer}),
)
add_service(
    LinkName,
    bool,
    ServiceCodec(
        "gazebo_ros_link_attacher/SetStatic",
        lambda request: LinkName(request.model_name, request.link_name),
        lambda answer: {"ok": answer},
    ),
)
