"""Where two wheels have rolled to: odometry from encoders."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.rotations import from_yaw
from gazelle.simulation import Odometry
from gazelle.simulation.values import NO_VARIANCE, SixNumbers


class DeadReckoning:
    """Adds up what a left and a right wheel roll, in every world.

    Args:
        separation: Between the wheels [m].
        angles: Of both wheels now [rad], shape (nworld, 2).
        radius: Of the wheels [m].

    Attributes:
        pose: x, y [m] and heading [rad], shape (nworld, 3).
        twist: Forward velocity [m/s] and turning rate [rad/s], shape (nworld, 2).
    """

    def __init__(self, separation: float, radius: float, angles: Floats) -> None:
        self._separation, self._radius = separation, radius
        self._angles = angles
        self.pose: Floats = np.zeros((len(angles), 3))
        self.twist: Floats = np.zeros((len(angles), 2))

    def advance(self, angles: Floats, interval: float, turned: Floats | None = None) -> None:
        """Go on to other wheel angles, with the heading at the middle of the interval.

        Args:
            angles: Now [rad], shape (nworld, 2).
            interval: Since the last time [s].
            turned: Change of heading by another instrument [rad], shape (nworld,); by the
                wheels if None.
        """
        left, right = (self._radius * (angles - self._angles)).T
        self._angles = angles
        if interval <= 0.0:
            return
        along = (left + right) / 2.0
        if turned is None:
            turned = (right - left) / self._separation
        middle = self.pose[:, 2] + turned / 2.0
        self.pose[:, 0] += along * np.cos(middle)
        self.pose[:, 1] += along * np.sin(middle)
        self.pose[:, 2] += turned
        self.twist = np.stack((along, turned), axis=1) / interval

    def odometry(
        self, stamp: int, frame: str, child_frame: str, variance: SixNumbers = NO_VARIANCE
    ) -> Odometry:
        """The pose and velocity, by name; ``variance`` is of the pose."""
        zero = np.zeros(len(self.pose))
        speed, turning = self.twist.T
        return Odometry(
            stamp,
            frame,
            child_frame,
            np.stack((self.pose[:, 0], self.pose[:, 1], zero), axis=1),
            from_yaw(self.pose[:, 2]),
            np.stack((speed, zero, zero), axis=1),
            np.stack((zero, zero, turning), axis=1),
            variance,
        )

    def reset(self, worlds: Worlds | None, angles: Floats) -> None:
        """Back to the origin, with the wheels as they are now, shape (nworld, 2)."""
        rows = slice(None) if worlds is None else worlds
        self.pose[rows], self.twist[rows] = 0.0, 0.0
        self._angles[rows] = angles[rows]

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes."""
        return {
            "pose": self.pose.copy(),
            "twist": self.twist.copy(),
            "angles": self._angles.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self.pose[:], self.twist[:] = state["pose"], state["twist"]
        self._angles[:] = state["angles"]
