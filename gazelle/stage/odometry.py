"""Odometry of Stage's robots."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.stage.reckoning import Reckoning
from gazelle.stage.robots import StageRobot
from gazelle.streams import Stream

_WIDTHS = (0.03, 0.03, 0.05)
"""Between the least and the greatest share of x, y and yaw that Stage 4.3 draws."""


class WheelOdometry:
    """Adds up what the wheels say, wrong by the constant share ``odom_error``.

    As in Stage a robot with no ``odom_error`` draws its share at the start, and wheels
    of a robot that is stalled slip.

    Args:
        robots: All robots of a world.
        nworld: Worlds.
        seed: The run's seed.
        euler: Turn first and then go straight on, as Stage's odometry does, not along the arc.

    Attributes:
        needed: Whether any robot uses it.
        used: Whether each robot's localization is ``odom``, shape (nrobot,).
        pose: Odometry, shape (nworld, nrobot, 3); without robots if none
            uses it.
        stream: Random stream.
    """

    def __init__(
        self, robots: Sequence[StageRobot], nworld: int, seed: int, *, euler: bool = False
    ) -> None:
        positions = [robot.position for robot in robots]
        self.used = np.array([p.localization == "odom" for p in positions], np.bool_)
        self.needed = bool(self.used.any())
        self._euler = euler
        if not self.needed:  # for tens of thousands of robots it would be something
            robots, positions = [], []
        self._given: Floats = np.array([_given(p.odom_error) for p in positions]).reshape(-1, 3)
        self._first = np.array([_start_of(robot) for robot in robots]).reshape(-1, 3)
        self.stream = Stream(seed, "odometry", nworld)
        self.pose = np.tile(self._first, (nworld, 1, 1))
        self.share = np.zeros_like(self.pose)
        self._draw(None)

    def system(self, velocity: Floats, dt: float) -> Reckoning:
        """Return the system that adds a step of ``dt`` at body velocities, shape (nworld, n, 3).

        Of the n the first are the robots; the array is contiguous.
        """
        rows = (velocity.reshape(-1, 3), self.share.reshape(-1, 3), self.pose.reshape(-1, 3))
        size = {"count": self.pose.shape[1], "stride": velocity.shape[1]}
        return Reckoning(*rows, **size, dt=dt, euler=self._euler)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Start over; robots draw again, or the same as at first if it is for all worlds."""
        rows = slice(None) if worlds is None else worlds
        self.pose[rows] = self._first
        if worlds is None:
            self.stream.rewind()
        self._draw(worlds)

    def _draw(self, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        drawn = self.stream.uniform(self._given.size, worlds)
        numbers = drawn.reshape(len(drawn), *self._given.shape)
        own = (numbers - 0.5) * _WIDTHS
        self.share[rows] = np.where(np.isnan(self._given), own, self._given)


def _given(error: tuple[float, float, float, float] | None) -> tuple[float, float, float]:
    """Return x, y and yaw of the file; NaN where it has none."""
    return (math.nan,) * 3 if error is None else (error[0], error[1], error[3])


def _start_of(robot: StageRobot) -> tuple[float, float, float]:
    """Return the first pose in the frame of ``localization_origin``."""
    pose, origin = robot.model.pose, robot.position.localization_origin
    if origin is None:
        return (0.0, 0.0, 0.0)
    x, y, _, yaw = origin
    dx, dy = pose.x - x, pose.y - y
    cos, sin = float(np.cos(yaw)), float(np.sin(yaw))
    turn = pose.yaw - yaw
    return (cos * dx + sin * dy, cos * dy - sin * dx, float(np.arctan2(np.sin(turn), np.cos(turn))))
