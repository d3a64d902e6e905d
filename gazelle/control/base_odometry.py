"""Odometry of a base from the motion of its wheels."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Ints64, Worlds
from gazelle.control.odometry_law import OdometryLaw


class BaseOdometry:
    """Pose and velocity of a base, in every world.

    Args:
        nworld: Number of worlds.
        window: Number of velocities that are averaged.

    Attributes:
        pose: x, y [m] and heading [rad], shape (nworld, 3).
        twist: Forward and sideways velocity [m/s] and turning rate [rad/s], likewise.
        law: Goes on with them in native code, on the same arrays.
    """

    def __init__(self, nworld: int, window: int = 10) -> None:
        self.pose: Floats = np.zeros((nworld, 3))
        self.twist: Floats = np.zeros((nworld, 3))
        self._recent: Floats = np.zeros((nworld, max(1, window), 3))
        self._kept: Ints64 = np.zeros(nworld, np.int64)
        self._place: Ints64 = np.zeros(nworld, np.int64)
        self.law = OdometryLaw((self.pose, self.twist, self._recent, self._kept, self._place))

    def move(self, forward: Floats, sideways: Floats, turned: Floats) -> None:
        """Advance by distances in the base's frame [m] and an angle [rad].

        Each has shape (nworld,).
        """
        self.law.move_all(np.stack((forward, sideways, turned), axis=1))

    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset the odometry to the origin, at rest."""
        rows = slice(None) if worlds is None else worlds
        self.pose[rows] = self.twist[rows] = 0.0
        self._kept[rows] = 0

    def forget_velocity(self) -> None:
        """Average from now on."""
        self._kept[:] = 0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state."""
        return {
            "pose": self.pose.copy(),
            "twist": self.twist.copy(),
            "recent": self._recent.copy(),
            "kept": self._kept.copy(),
            "place": self._place.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.pose[:], self.twist[:] = state["pose"], state["twist"]
        self._recent[:], self._kept[:] = state["recent"], state["kept"]
        self._place[:] = state["place"]
