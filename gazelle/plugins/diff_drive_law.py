# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""What wheel speeds a velocity command comes to: the rule of ``libgazebo_ros_diff_drive.so``."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.native.system import System

from gazelle.array_types import Floats

# The ramp acts only while both wheels are farther than this from their target [m/s].
RAMP_DEADBAND = 0.01


@cython.cclass
class DiffDriveLaw(System):
    """The wheels of one robot in all worlds.

    Args:
        linear: Commanded velocities [m/s], shape (nworld, 3).
        angular: Commanded turning rates [rad/s], shape (nworld, 3).
        separation: Between the wheels [m].
        radius: Of a wheel [m].
        acceleration: Most change of a wheel's speed on the ground [m/s²]; 0 for no limit.

    Attributes:
        speeds: Of the left and right wheel on the ground [m/s], shape (nworld, 2).
        last_ns: Time of the last update in each world [ns], shape (nworld,).
        targets: Where the wheels' turning rates go [rad/s], shape (nworld, n).
        left: Column of the left wheel there.
        right: Column of the right wheel.
    """

    def __init__(
        self,
        linear: Floats,
        angular: Floats,
        *,
        separation: float,
        radius: float,
        acceleration: float,
    ) -> None:
        System.__init__(self)
        self.linear, self.angular = linear, angular
        self.half, self.radius, self.acceleration = separation / 2.0, radius, acceleration
        self.speeds = np.zeros((len(linear), 2))
        self.last_ns = np.zeros(len(linear), np.int64)
        self.send_to(np.zeros((len(linear), 2)), 0, 1)

    def send_to(self, targets: Floats, left: int, right: int) -> None:
        """Write the wheels' turning rates to columns of another array."""
        self.targets, self.left, self.right = targets, left, right

    def apply(self, time: int) -> None:
        """``update`` of all worlds."""
        self.update(0, self.speeds.shape[0], time)

    def update(self, first: int, last: int, time: int) -> None:
        """Change wheel speeds towards what is commanded."""
        for w in range(first, last):
            turning = self.angular[w, 2] * self.half
            left, right = self.linear[w, 0] - turning, self.linear[w, 0] + turning
            lack, other = left - self.speeds[w, 0], right - self.speeds[w, 1]
            most = self.acceleration * ((time - self.last_ns[w]) / 1e9)
            self.last_ns[w] = time
            if self.acceleration > 0.0 and min(abs(lack), abs(other)) >= RAMP_DEADBAND:
                self.speeds[w, 0] += min(max(lack, -most), most)
                self.speeds[w, 1] += min(max(other, -most), most)
            else:
                self.speeds[w, 0], self.speeds[w, 1] = left, right
            self.targets[w, self.left] = self.speeds[w, 0] / self.radius
            self.targets[w, self.right] = self.speeds[w, 1] / self.radius
