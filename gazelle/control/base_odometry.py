"""Where a base has gone, from what its wheels did."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds

# Below so many seconds a velocity is not worth dividing by.
_SHORT = 1e-4

# Below so much turning an arc is a straight line [rad].
_STRAIGHT = 1e-6


class BaseOdometry:
    """Pose and velocity of a base, in every world.

    Args:
        nworld: Number of worlds.
        window: How many velocities are averaged.

    Attributes:
        pose: x, y [m] and heading [rad], shape (nworld, 3).
        twist: Forward and sideways velocity [m/s] and turning rate [rad/s], likewise.
    """

    def __init__(self, nworld: int, window: int = 10) -> None:
        self._window = max(1, window)
        self.pose: Floats = np.zeros((nworld, 3))
        self.twist: Floats = np.zeros((nworld, 3))
        self._recent: list[Floats] = []

    def move(self, forward: Floats, sideways: Floats, turned: Floats) -> None:
        """Go on by distances in the base's frame [m] and an angle [rad], each of shape (nworld,)."""
        x, y, heading = self.pose.T
        straight = np.abs(turned) < _STRAIGHT
        middle = heading + 0.5 * turned
        divisor = np.where(straight, 1.0, turned)
        # Over an arc the mean direction is shorter than one by the chord's ratio.
        sine = np.where(
            straight, np.cos(middle), (np.sin(heading + turned) - np.sin(heading)) / divisor
        )
        cosine = np.where(
            straight, np.sin(middle), -(np.cos(heading + turned) - np.cos(heading)) / divisor
        )
        self.pose = np.stack(
            (
                x + forward * sine - sideways * cosine,
                y + forward * cosine + sideways * sine,
                heading + turned,
            ),
            axis=1,
        )

    def advance(self, forward: Floats, sideways: Floats, turned: Floats, dt: float) -> None:
        """The same in some time [s], from which velocities follow."""
        self.move(forward, sideways, turned)
        if dt < _SHORT:
            return
        self._recent.append(np.stack((forward, sideways, turned), axis=1) / dt)
        del self._recent[: -self._window]
        self.twist = np.mean(self._recent, axis=0)

    def drive(self, twist: Floats, dt: float) -> None:
        """Go on as if a command, shape (nworld, 3), were followed exactly."""
        self.twist = twist.copy()
        self.move(*(twist * dt).T)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Be at the origin, at rest."""
        rows = slice(None) if worlds is None else worlds
        self.pose[rows] = self.twist[rows] = 0.0
        for each in self._recent:
            each[rows] = 0.0
        if worlds is None:
            self._recent = []

    def forget_velocity(self) -> None:
        """Average from now on."""
        self._recent = []

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes."""
        shape = (len(self._recent), *self.pose.shape)
        return {
            "pose": self.pose.copy(),
            "twist": self.twist.copy(),
            "recent": np.array(self._recent).reshape(shape),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self.pose, self.twist = np.array(state["pose"]), np.array(state["twist"])
        self._recent = [np.array(each) for each in state["recent"]]
