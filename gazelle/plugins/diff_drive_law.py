# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc"
"""Wheel speeds for a velocity command: the rule of ``libgazebo_ros_diff_drive.so``.

Drives with more wheels on a side give them all one speed, and have no ramp.
"""

from __future__ import annotations

from dataclasses import dataclass

import cython
import numpy as np
from cython.cimports.gazelle.native.system import System
from numpy.typing import ArrayLike, NDArray

from gazelle.array_types import Floats, Indices

# The ramp acts only while both wheels are farther than this from their target [m/s].
RAMP_DEADBAND = 0.01


@dataclass(frozen=True, slots=True)
class WheelTables:
    """Commands and state of some drives with two sides, in all worlds; used in place.

    Attributes:
        linear: Commanded velocities [m/s], shape (nworld, n, 3).
        angular: Commanded turning rates [rad/s], likewise.
        speeds: Of the left and right wheels on the ground [m/s], shape (nworld, n, 2).
        sent: Last command to the motors of each side [rad/s], shape (nworld, n, 2); NaN where
            that is not what they have.
        last_ns: Time of the last update [ns], shape (nworld, n).
    """

    linear: Floats
    angular: Floats
    speeds: Floats
    sent: Floats
    last_ns: NDArray[np.int64]

    @classmethod
    def empty(cls, nworld: int, count: int) -> WheelTables:
        """Return tables of ``count`` drives, all zero, with nothing sent."""
        linear, angular = np.zeros((2, nworld, count, 3))
        speeds, last_ns = np.zeros((nworld, count, 2)), np.zeros((nworld, count), np.int64)
        return cls(linear, angular, speeds, np.full_like(speeds, np.nan), last_ns)

    def column(self, part: int) -> WheelTables:
        """Return a view of the same memory, of one drive."""
        own = slice(part, part + 1)
        return WheelTables(
            self.linear[:, own],
            self.angular[:, own],
            self.speeds[:, own],
            self.sent[:, own],
            self.last_ns[:, own],
        )

    def copy_from(self, other: WheelTables) -> None:
        """Copy the memory of other tables of as many drives."""
        self.linear[:], self.angular[:] = other.linear, other.angular
        self.speeds[:], self.sent[:], self.last_ns[:] = other.speeds, other.sent, other.last_ns


@cython.cclass
class DiffDriveLaw(System):
    """The wheels of some robots in all worlds, a row each.

    Args:
        tables: Commands and speeds.
        separation: Between the wheels [m], shape (n,).
        radius: Of the wheels [m], shape (n,).
        acceleration: Most change of a wheel's speed on the ground [m/s²]; 0 for no limit; (n,).
    """

    def __init__(
        self,
        tables: WheelTables,
        *,
        separation: ArrayLike,
        radius: ArrayLike,
        acceleration: ArrayLike,
    ) -> None:
        count = tables.speeds.shape[1]
        System.__init__(self, count)
        self.least = 1000
        self.linear, self.angular = tables.linear, tables.angular
        self.speeds, self.sent, self.last_ns = tables.speeds, tables.sent, tables.last_ns
        self.half = np.asarray(separation, np.float64).reshape(count) / 2.0
        self.radius = np.array(radius, np.float64).reshape(count)
        self.acceleration = np.array(acceleration, np.float64).reshape(count)
        self.steady = not np.any(np.asarray(acceleration) > 0.0)  # speeds are those commanded
        wheels = np.arange(2 * count)
        self.send_to(np.zeros((len(tables.speeds), 2 * count)), wheels, wheels)

    def send_to(self, targets: Floats, columns: Indices, sides: Indices) -> None:
        """Write turning rates to columns of an array.

        Args:
            targets: Shape (nworld, columns).
            columns: Of each wheel, robot by robot, shape (wheels,).
            sides: Twice the number of each wheel's robot, one more on the right, likewise.
        """
        self.targets, self.columns = targets, np.array(columns, np.intp)
        self.uses = (targets,)
        self.sides = np.array(sides % 2, np.intp)
        self.start = np.searchsorted(sides // 2, np.arange(self.rows + 1)).astype(np.intp)

    def update(self, first: int, last: int, time: int) -> None:
        """Ramp wheel speeds towards the command, and set the motors' changed ones."""
        w, i = first // self.rows, first % self.rows - 1
        for _ in range(first, last):
            i += 1
            if i == self.rows:
                w, i = w + 1, 0
            turning = self.angular[w, i, 2] * self.half[i]
            left, right = self.linear[w, i, 0] - turning, self.linear[w, i, 0] + turning
            left_error, right_error = left - self.speeds[w, i, 0], right - self.speeds[w, i, 1]
            most = self.acceleration[i] * ((time - self.last_ns[w, i]) / 1e9)
            self.last_ns[w, i] = time
            if (
                self.acceleration[i] > 0.0
                and min(abs(left_error), abs(right_error)) >= RAMP_DEADBAND
            ):
                self.speeds[w, i, 0] += min(max(left_error, -most), most)
                self.speeds[w, i, 1] += min(max(right_error, -most), most)
            else:
                self.speeds[w, i, 0], self.speeds[w, i, 1] = left, right
            left, right = (
                self.speeds[w, i, 0] / self.radius[i],
                self.speeds[w, i, 1] / self.radius[i],
            )
            if left == self.sent[w, i, 0] and right == self.sent[w, i, 1]:
                continue
            self.sent[w, i, 0], self.sent[w, i, 1] = left, right
            for wheel in range(self.start[i], self.start[i + 1]):
                self.targets[w, self.columns[wheel]] = left if self.sides[wheel] == 0 else right
