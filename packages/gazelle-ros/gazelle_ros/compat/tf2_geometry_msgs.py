"""Teaches tf2's buffers to transform the messages of geometry_msgs."""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from typing import Any, TypeVar

import numpy as np

from gazelle_ros.base.rotations import Quaternion, Vector, add, matrix, multiply, rotate
from gazelle_ros.compat.tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration
from gazelle_ros.messages import Message
from gazelle_ros.msgs import geometry_msgs

_StampedT = TypeVar(
    "_StampedT",
    "geometry_msgs.msg.PointStamped",
    "geometry_msgs.msg.Vector3Stamped",
    "geometry_msgs.msg.PoseStamped",
    "geometry_msgs.msg.WrenchStamped",
    "geometry_msgs.msg.PoseWithCovarianceStamped",
)


def _vector(message: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3) -> Vector:
    return (message.x, message.y, message.z)


def _quaternion(message: geometry_msgs.msg.Quaternion) -> Quaternion:
    return (message.x, message.y, message.z, message.w)


def _make(kind: type[_StampedT], transform: geometry_msgs.msg.TransformStamped) -> _StampedT:
    made = kind()
    made.header = deepcopy(transform.header)
    return made


def _turned(
    vector: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3,
    transform: geometry_msgs.msg.TransformStamped,
) -> Vector:
    return rotate(_unit(transform), _vector(vector))


def _moved(
    point: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3,
    transform: geometry_msgs.msg.TransformStamped,
) -> Vector:
    return add(_turned(point, transform), _vector(transform.transform.translation))


def _unit(transform: geometry_msgs.msg.TransformStamped) -> Quaternion:
    x, y, z, w = _quaternion(transform.transform.rotation)
    norm = (x * x + y * y + z * z + w * w) ** 0.5 or 1.0
    return (x / norm, y / norm, z / norm, w / norm)


def to_msg_msg(msg: Any) -> Any:
    """Return the message itself."""
    return msg


from_msg_msg = to_msg_msg


def transform_to_kdl(t: Any) -> Any:
    """Return PyKDL's frame of a ``TransformStamped``."""
    from gazelle_ros.compat.tf2_kdl import transform_to_kdl as convert

    return convert(t)


def do_transform_point(
    point: geometry_msgs.msg.PointStamped, transform: geometry_msgs.msg.TransformStamped
) -> geometry_msgs.msg.PointStamped:
    """Transform a ``PointStamped`` to the target frame of a ``TransformStamped``."""
    result = _make(geometry_msgs.msg.PointStamped, transform)
    result.point.x, result.point.y, result.point.z = _moved(point.point, transform)
    return result


def do_transform_vector3(
    vector3: geometry_msgs.msg.Vector3Stamped, transform: geometry_msgs.msg.TransformStamped
) -> geometry_msgs.msg.Vector3Stamped:
    """Rotate a ``Vector3Stamped`` to the target frame, without translation."""
    result = _make(geometry_msgs.msg.Vector3Stamped, transform)
    result.vector.x, result.vector.y, result.vector.z = _turned(vector3.vector, transform)
    return result


def do_transform_pose(
    pose: geometry_msgs.msg.PoseStamped, transform: geometry_msgs.msg.TransformStamped
) -> geometry_msgs.msg.PoseStamped:
    """Transform a ``PoseStamped`` to the target frame."""
    result = _make(geometry_msgs.msg.PoseStamped, transform)
    _put_pose(result.pose, pose.pose, transform)
    return result


def _put_pose(
    result: geometry_msgs.msg.Pose,
    pose: geometry_msgs.msg.Pose,
    transform: geometry_msgs.msg.TransformStamped,
) -> None:
    place, turn = result.position, result.orientation
    place.x, place.y, place.z = _moved(pose.position, transform)
    turn.x, turn.y, turn.z, turn.w = multiply(_unit(transform), _quaternion(pose.orientation))


def do_transform_wrench(
    wrench: geometry_msgs.msg.WrenchStamped, transform: geometry_msgs.msg.TransformStamped
) -> geometry_msgs.msg.WrenchStamped:
    """Rotate force and torque of a ``WrenchStamped`` to the target frame."""
    result = _make(geometry_msgs.msg.WrenchStamped, transform)
    force, torque = result.wrench.force, result.wrench.torque
    force.x, force.y, force.z = _turned(wrench.wrench.force, transform)
    torque.x, torque.y, torque.z = _turned(wrench.wrench.torque, transform)
    return result


def transform_covariance(cov_in: Any, transform: geometry_msgs.msg.TransformStamped) -> list[float]:
    """Transform the covariance of a pose, 36 numbers by rows, to the target frame."""
    turn = np.kron(np.identity(2), np.array(matrix(_unit(transform))))
    turned: list[float] = (turn @ np.reshape(cov_in, (6, 6)) @ turn.T).ravel().tolist()
    return turned


def do_transform_pose_with_covariance_stamped(
    pose: geometry_msgs.msg.PoseWithCovarianceStamped, transform: geometry_msgs.msg.TransformStamped
) -> geometry_msgs.msg.PoseWithCovarianceStamped:
    """Transform a ``PoseWithCovarianceStamped`` to the target frame."""
    result = _make(geometry_msgs.msg.PoseWithCovarianceStamped, transform)
    _put_pose(result.pose.pose, pose.pose.pose, transform)
    result.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return result


def _register() -> None:
    transforms, conversions = TransformRegistration(), ConvertRegistration()
    doers: dict[type[Message], Callable[..., Any]] = {
        geometry_msgs.msg.PointStamped: do_transform_point,
        geometry_msgs.msg.Vector3Stamped: do_transform_vector3,
        geometry_msgs.msg.PoseStamped: do_transform_pose,
        geometry_msgs.msg.WrenchStamped: do_transform_wrench,
        geometry_msgs.msg.PoseWithCovarianceStamped: do_transform_pose_with_covariance_stamped,
    }
    for kind, doer in doers.items():
        transforms.add(kind, doer)
        conversions.add_to_msg(kind, to_msg_msg)
        conversions.add_from_msg(kind, from_msg_msg)


_register()
