"""Teaches tf2's buffers to transform PyKDL's values.

A stamped value has a ``header`` set with ``tf2_ros.Stamped``.
"""

from __future__ import annotations

from typing import Any

from gazelle_ros.compat import PyKDL
from gazelle_ros.compat.tf2_ros.buffer_interface import (
    ConvertRegistration,
    Stamped,
    TransformRegistration,
)
from gazelle_ros.msgs import geometry_msgs


def transform_to_kdl(t: Any) -> PyKDL.Frame:
    """Return the frame of a ``TransformStamped``."""
    turn, place = t.transform.rotation, t.transform.translation
    return PyKDL.Frame(
        PyKDL.Rotation.Quaternion(turn.x, turn.y, turn.z, turn.w),
        PyKDL.Vector(place.x, place.y, place.z),
    )


def _moved(value: Any, transform: geometry_msgs.msg.TransformStamped) -> Any:
    result = transform_to_kdl(transform) * value
    result.header = transform.header
    return result


def do_transform_vector(vector: PyKDL.Vector, transform: geometry_msgs.msg.TransformStamped) -> Any:
    """Transform a vector to the target frame: rotated and translated."""
    return _moved(vector, transform)


def do_transform_frame(frame: PyKDL.Frame, transform: geometry_msgs.msg.TransformStamped) -> Any:
    """Transform a frame to the target frame."""
    return _moved(frame, transform)


def do_transform_twist(twist: PyKDL.Twist, transform: geometry_msgs.msg.TransformStamped) -> Any:
    """Transform a twist to the target frame, with its reference point."""
    return _moved(twist, transform)


def do_transform_wrench(wrench: PyKDL.Wrench, transform: geometry_msgs.msg.TransformStamped) -> Any:
    """Transform a wrench to the target frame, with its reference point."""
    return _moved(wrench, transform)


def to_msg_vector(vector: Any) -> Any:
    """Return the ``PointStamped`` of a stamped vector."""
    message = geometry_msgs.msg.PointStamped(header=vector.header)
    message.point.x, message.point.y, message.point.z = vector
    return message


def from_msg_vector(msg: geometry_msgs.msg.PointStamped) -> Any:
    """Return the stamped vector of a ``PointStamped``."""
    vector = PyKDL.Vector(msg.point.x, msg.point.y, msg.point.z)
    return Stamped(vector, msg.header.stamp, msg.header.frame_id)


def convert_vector(vector: Any) -> Any:
    """Return a copy of a stamped vector."""
    return Stamped(PyKDL.Vector(vector), vector.header.stamp, vector.header.frame_id)


def _register() -> None:
    transforms, conversions = TransformRegistration(), ConvertRegistration()
    for kind, function in (
        (PyKDL.Vector, do_transform_vector),
        (PyKDL.Frame, do_transform_frame),
        (PyKDL.Twist, do_transform_twist),
        (PyKDL.Wrench, do_transform_wrench),
    ):
        transforms.add(kind, function)
    conversions.add_to_msg(PyKDL.Vector, to_msg_vector)
    conversions.add_from_msg(PyKDL.Vector, from_msg_vector)
    conversions.add_convert((PyKDL.Vector, PyKDL.Vector), convert_vector)


_register()
