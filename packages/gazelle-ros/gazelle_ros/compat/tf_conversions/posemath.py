"""PyKDL's frames from poses of other kinds, and back."""
# ruff: noqa: N802 - the names are posemath's

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle_ros.compat.PyKDL import Frame, Rotation, Vector
from gazelle_ros.compat.tf import transformations
from gazelle_ros.msgs import geometry_msgs

__all__ = [
    "Frame",
    "Rotation",
    "Vector",
    "fromCameraParams",
    "fromMatrix",
    "fromMsg",
    "fromTf",
    "toMatrix",
    "toMsg",
    "toTf",
    "transformations",
]


def fromTf(tf: tuple[Sequence[float], Sequence[float]]) -> Frame:
    """Return the frame of a translation and a quaternion, as returned by ``lookupTransform``."""
    place, turn = tf
    return Frame(Rotation.Quaternion(turn[0], turn[1], turn[2], turn[3]), Vector(*place))


def toTf(f: Frame) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
    """Return translation and quaternion of a frame, as arguments of ``sendTransform``."""
    return f.p.tuple, f.M.GetQuaternion()


def fromMsg(p: Any) -> Frame:
    """Return the frame of a ``Pose``."""
    turn, place = p.orientation, p.position
    return Frame(
        Rotation.Quaternion(turn.x, turn.y, turn.z, turn.w), Vector(place.x, place.y, place.z)
    )


def toMsg(f: Frame) -> Any:
    """Return the ``Pose`` of a frame."""
    pose = geometry_msgs.msg.Pose()
    turn, place = pose.orientation, pose.position
    turn.x, turn.y, turn.z, turn.w = f.M.GetQuaternion()
    place.x, place.y, place.z = f.p
    return pose


def fromMatrix(m: ArrayLike) -> Frame:
    """Return the frame of a 4x4 or 3x4 matrix."""
    values = np.asarray(m, dtype=float)
    return Frame(Rotation(*values[:3, :3].ravel().tolist()), Vector(*values[:3, 3].tolist()))


def toMatrix(f: Frame) -> NDArray[np.float64]:
    """Return the 4x4 matrix of a frame."""
    return np.array([[f[line, column] for column in range(4)] for line in range(4)])


def fromCameraParams(cv: Any, rvec: ArrayLike, tvec: ArrayLike) -> Frame:
    """Return the frame of a camera as OpenCV gives it: axis times angle, and translation.

    Args:
        cv: Accepted, and not needed.
        rvec: Axis of the rotation, as long as its angle [rad].
        tvec: The translation.
    """
    del cv
    axis = Vector(*np.ravel(rvec).tolist())
    return Frame(Rotation.Rot(axis, axis.Norm()), Vector(*np.ravel(tvec).tolist()))
