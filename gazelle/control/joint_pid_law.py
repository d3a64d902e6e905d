# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""PID control of joint positions or velocities, in native code."""

from __future__ import annotations

from collections.abc import Sequence

import cython
import numpy as np
from cython.cimports.gazelle.control.angle_law import shorter, shortest, within
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.pid_law import PidLaw
from cython.cimports.gazelle.native.rows import column, offset, start

from gazelle.array_types import Bools, Floats
from gazelle.control.interfaces import JointHandles
from gazelle.native.rows import first_of_run

_TURN = cython.declare(cython.double, 6.283185307179586)


@cython.cclass
class JointPidLaw(ControlLaw):
    """A PID for each of some joints.

    Args:
        joints: To be read and commanded.
        pid: With as many loops.
        targets: Positions [m or rad] or velocities [m/s or rad/s], shape (nworld, joints); used in
            place, as ``error`` is.
        error: Desired less actual value, likewise.
    """

    def __init__(self, joints: JointHandles, pid: PidLaw, targets: Floats, error: Floats) -> None:
        ControlLaw.__init__(self, len(targets))
        self.pid, self.targets, self.error = pid, targets, error
        self.position, self.velocity = joints.states.position, joints.states.velocity
        self.joints = joints.columns
        self.command, self.columns = joints.commands[joints.fields[0]]
        self.first_joint = first_of_run(joints.columns)
        self.first_column = first_of_run(joints.commands[joints.fields[0]][1])
        self.read_row, self.push_row = np.zeros((2, *targets.shape))
        self.by_velocity, self.count = True, len(joints.columns)
        self.width, self.command_width = self.position.shape[1], self.command.shape[1]
        self.measured_at, self.targets_at = start(self.velocity), start(self.targets)
        self.error_at, self.command_at = start(self.error), start(self.command)

    def hold_positions(self, limits: Sequence[Floats], turning: Bools) -> None:
        """Control positions instead, within limits.

        Args:
            limits: Lower and upper ones [m or rad], shape (joints,) each.
            turning: Mask of joints that turn, shape (joints,).
        """
        self.by_velocity, self.measured_at = False, start(self.position)
        self.lower, self.upper, self.turning = np.array([*limits, turning], np.float64)
        self.turning_at = column(self.turning)
        self.lower_at, self.upper_at = column(self.lower), column(self.upper)

    def control(self, world: int, now: int, period: float) -> None:  # noqa: ARG002  as of others
        """Compute and apply efforts towards the targets.

        Positions turn the way that limits allow.
        """
        count, first = self.count, world * self.count
        at, targets = self.measured(world), offset(self.targets_at, first)
        error, near = offset(self.error_at, first), False
        if self.by_velocity:
            velocity_errors(count, at, targets, error)
        else:
            lower, upper = self.lower_at, self.upper_at
            near = position_errors(count, at, targets, error, lower, upper, self.turning_at)
        if self.first_column >= 0:
            out = offset(self.command_at, world * self.command_width + self.first_column)
            self.pid.push_row(world, error, period, near, False, error, out)
            return
        out = offset(start(self.push_row), first)
        self.pid.push_row(world, error, period, near, False, error, out)
        for i in range(count):
            self.command[world, self.columns[i]] = out[i]

    def measured(self, world: int) -> Floats:
        """Return the measured values, in the order of the targets."""
        values = offset(self.measured_at, world * self.width)
        if self.first_joint >= 0:
            return offset(values, self.first_joint)
        at = offset(start(self.read_row), world * self.count)
        for i in range(self.count):
            at[i] = values[self.joints[i]]
        return at


def velocity_errors(count: int, at: Floats, targets: Floats, error: Floats) -> None:
    """Compute the errors of velocities."""
    for i in range(count):
        error[i] = targets[i] - at[i]


def position_errors(
    count: int, at: Floats, targets: Floats, error: Floats, lower: Floats, upper: Floats,
    turning: Floats,
) -> bool:  # fmt: skip
    """Compute position errors, the way that limits allow; return whether no joint is far off.

    Then all errors are finite.
    """
    far = 0
    for i in range(count):
        targets[i] = min(max(targets[i], lower[i]), upper[i])
        difference = targets[i] - at[i]
        far += 0 if -_TURN < difference < _TURN else 1
        if turning[i] != 0.0:
            difference = within(at[i], shorter(difference), lower[i], upper[i])
        error[i] = difference
    if far == 0:
        return True
    for i in range(count):  # more than a whole turn, or not finite
        if turning[i] != 0.0:
            error[i] = within(at[i], shortest(at[i], targets[i]), lower[i], upper[i])
    return False
