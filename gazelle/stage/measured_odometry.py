"""Odometry of Stage's robots as values, computed for all robots at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.planar import Fleet
from gazelle.rotations import from_yaw
from gazelle.simulation.clock import Clock
from gazelle.simulation.values import Odometry
from gazelle.stage.robots import StageRobot

_UNKNOWN: Any = (0.0,) * 6  # variances


class MeasuredOdometry:
    """Odometry of each robot of a fleet; the arrays of all are computed once after each step.

    Args:
        robots: All robots.
        fleet: Moves them.
        clock: Simulated time.
        state: Returns poses by odometry and velocities of the drives, both of shape (nworld, nrobot, 3).
    """

    def __init__(
        self,
        robots: Sequence[StageRobot],
        fleet: Fleet,
        clock: Clock,
        state: Callable[[], tuple[Floats, Floats]],
    ) -> None:
        self._index = {robot.name: robot.index for robot in robots}
        self._heights = [robot.model.pose.z for robot in robots]
        self._fleet, self._clock, self._state = fleet, clock, state
        self._made_at: tuple[int, int] | None = None
        self._arrays: tuple[Floats, ...] = ()

    def of(self, name: str, frames: tuple[str, str]) -> Odometry:
        """Return the odometry of a robot, in its frame and that of its base."""
        now = self._clock.now_ns
        at = now, self._fleet.changes
        if self._made_at != at:
            self._arrays, self._made_at = self._measure(), at
        robot = self._index[name]
        position, turned, linear, angular = (each[:, robot] for each in self._arrays)
        return Odometry(now, *frames, position, turned, linear, angular, _UNKNOWN, _UNKNOWN)

    def _measure(self) -> tuple[Floats, ...]:
        """Return new arrays, as readings are kept: positions, orientations, velocities; robots second."""
        pose, driven = self._state()
        position, linear, angular = np.zeros((3, *pose.shape))
        position[..., :2] = pose[..., :2]
        position[..., 2] = self._heights
        linear[..., :2], angular[..., 2] = driven[..., :2], driven[..., 2]
        return position, from_yaw(pose[..., 2]), linear, angular
