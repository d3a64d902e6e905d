"""A virtual trackball: a mouse turns a ball.

Source: Shoemake, ARCBALL: a user interface for specifying three-dimensional orientation, 1992.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats
from gazelle_ros.transformations.quaternions import (
    quaternion_from_matrix,
    quaternion_matrix,
    quaternion_multiply,
    quaternion_slerp,
)
from gazelle_ros.transformations.vectors import EPS, unit_vector

_STILL = (0.0, 0.0, 0.0, 1.0)


class Arcball:
    """The ball.

    Args:
        initial: Its attitude: a quaternion, shape (4,), or a matrix, shape (4, 4).

    Raises:
        ValueError: `initial` is neither.
    """

    def __init__(self, initial: npt.ArrayLike | None = None) -> None:
        self._axis: Floats | None = None
        self._axes: list[Floats] | None = None
        self._radius = 1.0
        self._center = [0.0, 0.0]
        self._pressed = np.array([0.0, 0.0, 1.0])
        self._constrain = False
        start = np.array(_STILL if initial is None else initial, dtype=np.float64)
        if start.shape == (4, 4):
            self._down = quaternion_from_matrix(start)
        elif start.shape == (4,):
            self._down = np.asarray(unit_vector(start))
        else:
            raise ValueError("initial quaternion or matrix is neither of 4 nor of 4x4 numbers")
        self._now = self._before = self._down

    def place(self, center: Iterable[float], radius: float) -> None:
        """Set the place of the ball in the window.

        Args:
            center: Of the ball, in pixels.
            radius: In pixels.
        """
        self._radius = float(radius)
        self._center = [float(number) for number in center][:2]

    def setaxes(self, *axes: npt.ArrayLike) -> None:
        """Set the axes a constrained ball turns about."""
        self._axes = [np.asarray(unit_vector(axis)) for axis in axes] or None

    def setconstrain(self, constrain: bool) -> None:  # noqa: FBT001  # the interface of ROS
        """Set whether to turn about the nearest of the axes only."""
        self._constrain = constrain

    def getconstrain(self) -> bool:
        """Return whether the ball turns about its axes only."""
        return self._constrain

    def down(self, point: npt.ArrayLike) -> None:
        """Start a drag at a place in the window, in pixels."""
        self._pressed = arcball_map_to_sphere(point, self._center, self._radius)
        self._down = self._before = self._now
        if self._constrain and self._axes is not None:
            self._axis = arcball_nearest_axis(self._pressed, self._axes)
            self._pressed = arcball_constrain_to_axis(self._pressed, self._axis)
        else:
            self._axis = None

    def drag(self, point: npt.ArrayLike) -> None:
        """Drag to a place in the window, in pixels."""
        there = arcball_map_to_sphere(point, self._center, self._radius)
        if self._axis is not None:
            there = arcball_constrain_to_axis(there, self._axis)
        self._before = self._now
        cross = np.cross(self._pressed, there)
        if float(cross @ cross) < EPS:
            self._now = self._down
            return
        turn = np.array([*cross, float(self._pressed @ there)])
        self._now = quaternion_multiply(turn, self._down)

    def next(self, acceleration: float = 0.0) -> None:
        """Continue the last turn."""
        turned = quaternion_slerp(self._before, self._now, 2.0 + acceleration, 0, False)
        self._before, self._now = self._now, turned

    def matrix(self) -> Floats:
        """Return the attitude, shape (4, 4)."""
        return quaternion_matrix(self._now)


def arcball_map_to_sphere(point: npt.ArrayLike, center: npt.ArrayLike, radius: float) -> Floats:
    """Return the place on the unit ball below a place in the window."""
    place, middle = np.asarray(point, dtype=np.float64), np.asarray(center, dtype=np.float64)
    x, y = (place[0] - middle[0]) / radius, (middle[1] - place[1]) / radius
    length = math.hypot(x, y)
    if length > 1.0:
        return np.array([x / length, y / length, 0.0])
    return np.array([x, y, math.sqrt(1.0 - length * length)])


def arcball_constrain_to_axis(point: npt.ArrayLike, axis: npt.ArrayLike) -> Floats:
    """Return the nearest place, in front, on the circle about an axis."""
    unit = np.asarray(axis, dtype=np.float64)
    place = np.array(point, dtype=np.float64)
    place = place - unit * float(unit @ place)
    length = math.sqrt(float(place @ place))
    if length > EPS:
        return np.asarray(place / (math.copysign(length, place[2]) if place[2] else length))
    if unit[2] == 1.0:
        return np.array([1.0, 0.0, 0.0])
    return np.asarray(unit_vector([-unit[1], unit[0], 0.0]))


def arcball_nearest_axis(point: npt.ArrayLike, axes: Iterable[npt.ArrayLike]) -> Floats:
    """Return the axis of the circle nearest to a place on the ball."""
    place = np.asarray(point, dtype=np.float64)
    return max(
        (np.asarray(axis, dtype=np.float64) for axis in axes),
        key=lambda axis: float(arcball_constrain_to_axis(place, axis) @ place),
    )
