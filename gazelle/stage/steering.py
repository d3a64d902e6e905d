"""Velocities of bodies from the drives of Stage's robots."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.stage.robots import StageRobot


class Steering:
    """Turns speeds and steering angles of cars into velocities, bounded as Stage bounds them.

    Args:
        robots: All of a world; those that are no cars stay as they are.
    """

    def __init__(self, robots: Sequence[StageRobot]) -> None:
        cars = [(robot.index, robot.position) for robot in robots if robot.position.drive == "car"]
        self._cars = np.array([index for index, _ in cars], np.intp)
        self._wheelbase = np.array([position.wheelbase for _, position in cars])
        bounds = np.array([position.velocity_bounds for _, position in cars]).reshape(-1, 4, 2)
        self._least, self._most = bounds[:, (0, 1, 3)].transpose(2, 0, 1)

    @property
    def needed(self) -> bool:
        """True if there is any car."""
        return len(self._cars) > 0

    def velocities(self, driven: Floats) -> Floats:
        """Return x, y [m/s] and yaw [rad/s] of the commands, both of shape (nworld, nrobot, 3)."""
        if not self.needed:
            return driven
        velocity = driven.copy()
        speed, angle = driven[:, self._cars, 0], driven[:, self._cars, 2]
        turn = speed * np.sin(angle) / self._wheelbase
        velocities = np.stack((speed * np.cos(angle), np.zeros_like(speed), turn), axis=-1)
        velocity[:, self._cars] = np.clip(velocities, self._least, self._most)
        return velocity
