"""Keep a robot from going to and fro on the spot."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2

_AXES = 3


class OscillationGuard:
    """Once a robot has gone to and fro along x or y, or in turning, only the last direction is allowed.

    Until it has moved on. The rule is that of ``base_local_planner``.

    Args:
        distance: Distance that ends it [m].
        angle: Angle that ends it, too [rad].
    """

    def __init__(self, distance: float, angle: float) -> None:
        self._distance, self._angle = distance, angle
        self.reset()

    def reset(self) -> None:
        """Clear all flags."""
        self._last = [0] * _AXES
        """The sign of the last motion on each axis."""
        self._only = [0] * _AXES
        """The one sign that is left to it."""
        self._pose: Pose2 = (0.0, 0.0, 0.0)

    def forbidden(self, commands: Floats) -> Bools:
        """Return a mask of the commands that are forbidden, shape (n,)."""
        found = np.zeros(len(commands), np.bool_)
        for axis, only in enumerate(self._only):
            if only:
                found |= np.sign(commands[:, axis]) == -only
        return found

    def update(self, pose: Pose2, command: Floats, least: float) -> None:
        """Update the flags by a command.

        Args:
            pose: Of the robot.
            command: x, y [m/s] and turning [rad/s], shape (3,).
            least: Faster than this along x, turning does not count [m/s].
        """
        changed = self._learn(0, command[0])
        if abs(command[0]) <= least:
            changed |= self._learn(1, command[1]) | self._learn(2, command[2])
        if changed:
            self._pose = pose
        elif any(self._only) and self._away(pose):
            self._last, self._only = [0] * _AXES, [0] * _AXES

    def _learn(self, axis: int, speed: float) -> bool:
        """Record a motion on an axis; returns whether it reversed."""
        sign = int(np.sign(speed))
        if not sign:
            return False
        back = self._last[axis] == -sign and self._only[axis] != sign
        if back:
            self._only[axis] = sign
        self._last[axis] = sign
        return back

    def _away(self, pose: Pose2) -> bool:
        moved = math.hypot(pose[0] - self._pose[0], pose[1] - self._pose[1])
        return moved > self._distance or abs(wrapped(pose[2] - self._pose[2])) > self._angle
