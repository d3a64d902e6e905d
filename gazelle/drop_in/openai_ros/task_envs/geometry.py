"""Messages about where things are, as numbers and arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle_ros.msgs import geometry_msgs
from gazelle_ros.transformations import euler_from_quaternion


def euler_of(orientation: geometry_msgs.msg.Quaternion) -> tuple[float, float, float]:
    """Return roll, pitch and yaw of a ``geometry_msgs/Quaternion`` [rad]."""
    roll, pitch, yaw = euler_from_quaternion(
        (orientation.x, orientation.y, orientation.z, orientation.w)
    )
    return float(roll), float(pitch), float(yaw)


def point(x: float, y: float, z: float = 0.0) -> geometry_msgs.msg.Point:
    """Return a ``geometry_msgs/Point`` [m]."""
    made = geometry_msgs.msg.Point
    return made(float(x), float(y), float(z))


def coordinates(place: geometry_msgs.msg.Point | geometry_msgs.msg.Vector3) -> Floats:
    """Return x, y and z of a point or vector [m], shape (1, 3)."""
    return np.array([(place.x, place.y, place.z)], np.float64)


def one(value: Any) -> NDArray[Any]:
    """Return a batch of one: an array with a leading axis of length 1."""
    return np.array([value])
