"""Points, rotations and poses: rows of numbers and 4x4 matrices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gazelle_ros.base.array_types import Floats
from gazelle_ros.compat.ros_numpy.registry import converts_from_numpy, converts_to_numpy
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import geometry_msgs
from gazelle_ros.transformations import quaternion_from_matrix, quaternion_matrix

_VECTORS = ("geometry_msgs/Vector3", "geometry_msgs/Point", "geometry_msgs/Point32")


def _triple(
    message: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3,
    hom: bool = False,  # noqa: FBT001, FBT002  # ros_numpy's interface
) -> Floats:
    """Return x, y and z; with `hom` a 1 behind a point's and a 0 behind a vector's."""
    last = [] if not hom else [0.0 if message._type.endswith("Vector3") else 1.0]
    return np.array([message.x, message.y, message.z, *last])


def _register_vector(name: str) -> None:
    kind = load_message(name)

    def make(array: ArrayLike) -> Any:
        values = np.asarray(array, dtype=float)
        if values.shape[-1] == 4 and name.endswith("Vector3") and values[3] != 0:
            raise ValueError("the fourth number of a direction is 0")
        scale = values[3] if values.shape[-1] == 4 and not name.endswith("Vector3") else 1.0
        return kind(*(values[:3] / scale).tolist())

    converts_to_numpy(kind)(_triple)
    converts_from_numpy(kind)(make)


for _name in _VECTORS:
    _register_vector(_name)


@converts_to_numpy("geometry_msgs/Quaternion")
def quat_to_numpy(msg: geometry_msgs.msg.Quaternion) -> Floats:
    """Return x, y, z and w."""
    return np.array([msg.x, msg.y, msg.z, msg.w])


@converts_from_numpy("geometry_msgs/Quaternion")
def numpy_to_quat(array: ArrayLike) -> Any:
    """Return the ``Quaternion`` of x, y, z and w."""
    return geometry_msgs.msg.Quaternion(*np.asarray(array, dtype=float).tolist())


def _matrix(
    place: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3, turn: geometry_msgs.msg.Quaternion
) -> Floats:
    matrix: Floats = quaternion_matrix((turn.x, turn.y, turn.z, turn.w))
    matrix[:3, 3] = place.x, place.y, place.z
    return matrix


def _put(
    place: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3,
    turn: geometry_msgs.msg.Quaternion,
    array: ArrayLike,
) -> None:
    matrix = np.asarray(array, dtype=float)
    turn.x, turn.y, turn.z, turn.w = quaternion_from_matrix(matrix).tolist()
    place.x, place.y, place.z = matrix[:3, 3].tolist()


@converts_to_numpy("geometry_msgs/Transform")
def transform_to_numpy(msg: geometry_msgs.msg.Transform) -> Floats:
    """Return the 4x4 matrix."""
    return _matrix(msg.translation, msg.rotation)


@converts_from_numpy("geometry_msgs/Transform")
def numpy_to_transform(array: ArrayLike) -> Any:
    """Return the ``Transform`` of a 4x4 matrix."""
    made = geometry_msgs.msg.Transform()
    _put(made.translation, made.rotation, array)
    return made


@converts_to_numpy("geometry_msgs/Pose")
def pose_to_numpy(msg: geometry_msgs.msg.Pose) -> Floats:
    """Return the 4x4 matrix."""
    return _matrix(msg.position, msg.orientation)


@converts_from_numpy("geometry_msgs/Pose")
def numpy_to_pose(array: ArrayLike) -> Any:
    """Return the ``Pose`` of a 4x4 matrix."""
    made = geometry_msgs.msg.Pose()
    _put(made.position, made.orientation, array)
    return made
