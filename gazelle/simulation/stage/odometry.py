"""Where Stage's robots believe they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.simulation.stage.layout import StageRobot
from gazelle.streams import Stream

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]


class Odometry:
    """Adds up what the wheels say, wrong by a constant share that each robot draws at the start.

    As in Stage the share is uniform within half of ``odom_error`` either way, and wheels of a
    robot that is stalled slip.

    Args:
        robots: All robots of a world.
        nworld: Worlds.
        seed: The run's seed.

    Attributes:
        needed: Whether any robot uses it.
        used: Whether each robot's localization is ``odom``, shape (nrobot,).
        pose: Where they believe they are, shape (nworld, nrobot, 3); without robots if none
            uses it.
    """

    def __init__(self, robots: list[StageRobot], nworld: int, seed: int) -> None:
        positions = [robot.position for robot in robots]
        self.used = np.array([p.localization == "odom" for p in positions], np.bool_)
        self.needed = bool(self.used.any())
        errors = np.array([(p.odom_error[0], p.odom_error[1], p.odom_error[3]) for p in positions])
        self._limits: Floats = errors.reshape(-1, 3)
        if not self.needed:  # for tens of thousands of robots it would be something
            robots, self._limits = [], np.zeros((0, 3))
        self._first = np.array([_start_of(robot) for robot in robots]).reshape(-1, 3)
        self._stream = Stream(seed, "odometry", nworld)
        self.pose = np.tile(self._first, (nworld, 1, 1))
        self.share = np.zeros_like(self.pose)
        self._draw(None)

    def advance(self, velocity: Floats, dt: float) -> None:
        """Add what a step of ``dt`` at body velocities, shape (nworld, nrobot, 3), comes to."""
        moved = velocity * (dt * (1.0 + self.share))
        turn = moved[..., 2]
        middle = self.pose[..., 2] + turn / 2.0
        # the chord of the arc that the robot drives
        chord = np.sinc(turn / (2.0 * np.pi))
        cos, sin = np.cos(middle) * chord, np.sin(middle) * chord
        self.pose[..., 0] += cos * moved[..., 0] - sin * moved[..., 1]
        self.pose[..., 1] += sin * moved[..., 0] + cos * moved[..., 1]
        yaw = self.pose[..., 2] + turn
        self.pose[..., 2] = np.arctan2(np.sin(yaw), np.cos(yaw))

    def reset(self, worlds: Worlds | None = None) -> None:
        """Start over; robots draw again, or the same as at first if it is for all worlds."""
        rows = slice(None) if worlds is None else worlds
        self.pose[rows] = self._first
        if worlds is None:
            self._stream.rewind()
        self._draw(worlds)

    def _draw(self, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        drawn = self._stream.uniform(self._limits.size, worlds)
        numbers = drawn.reshape(len(drawn), *self._limits.shape)
        self.share[rows] = (numbers - 0.5) * self._limits


def _start_of(robot: StageRobot) -> tuple[float, float, float]:
    """The first pose in the frame of ``localization_origin``."""
    pose, origin = robot.model.pose, robot.position.localization_origin
    if origin is None:
        return (0.0, 0.0, 0.0)
    x, y, _, yaw = origin
    dx, dy = pose.x - x, pose.y - y
    cos, sin = float(np.cos(yaw)), float(np.sin(yaw))
    turn = pose.yaw - yaw
    return (cos * dx + sin * dy, cos * dy - sin * dx, float(np.arctan2(np.sin(turn), np.cos(turn))))
