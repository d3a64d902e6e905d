# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""PID control of joint positions or velocities, in native code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.control.angle_law import shorter, shortest, within
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.joint_law import JointLaw
from cython.cimports.gazelle.control.joint_math import clamp, effort_within, finite, pid_output
from cython.cimports.gazelle.control.pid_law import (
    D_ERROR,
    I_ERROR,
    LAST,
    OUTPUT,
    P_ERROR,
    ROWS,
    PidLaw,
)
from cython.cimports.gazelle.native.rows import column, offset, places_column, start
from cython.cimports.libc.math import fabs

from gazelle.array_types import Bools, Floats
from gazelle.control.interfaces import JointHandles


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
        self.measures, self.position = joints.states.position, joints.states.position
        self.velocity, self.joints = joints.states.velocity, joints.columns
        self.commands, self.columns = joints.commands[joints.fields[0]]
        self.command = self.commands
        self.count = len(joints.columns)
        bounds = np.full((2, self.count), [[-np.inf], [np.inf]])
        self.hold_positions(list(bounds), np.zeros(self.count, bool))
        self.by_velocity = True  # velocities have no limits, and do not turn
        self.width, self.command_width = self.position.shape[1], self.command.shape[1]
        self.position_at, self.velocity_at = start(self.position), start(self.velocity)
        self.targets_at, self.error_at = start(self.targets), start(self.error)
        self.command_at = start(self.command)
        self.joints_at, self.columns_at = places_column(self.joints), places_column(self.columns)

    def hold_positions(self, limits: Sequence[Floats], turning: Bools) -> None:
        """Control positions instead, within limits.

        Args:
            limits: Lower and upper ones [m or rad], shape (joints,) each.
            turning: Mask of joints that turn, shape (joints,).
        """
        self.by_velocity = False
        self.lower, self.upper, self.turning = np.array([*limits, turning], np.float64)
        self.turning_at = column(self.turning)
        self.lower_at, self.upper_at = column(self.lower), column(self.upper)

    def control(self, world: int, now: int, period: float) -> None:  # noqa: ARG002  as of others
        """Command efforts towards the targets."""
        for i in range(self.count):
            self.control_joint(world, i, period)

    def control_joint(self, world: int, i: int, period: float) -> None:
        """Command a joint; positions turn the way that limits allow."""
        k, j = world * self.count + i, world * self.width + self.joints_at[i]
        at = self.velocity_at[j] if self.by_velocity else self.position_at[j]
        target = clamp(self.targets_at[k], self.lower_at[i], self.upper_at[i])
        self.targets_at[k], error = target, target - at
        if self.turning_at[i] != 0.0:
            error = within(at, shortest(at, target), self.lower_at[i], self.upper_at[i])
        self.error_at[k] = error
        self.command_at[world * self.command_width + self.columns_at[i]] = self.pid.push(
            world, i, error, period, False, 0.0
        )

    def take_over(self, hardware: JointLaw) -> Sequence[int]:
        """Return the joints if their efforts only have hard limits."""
        if not hardware.takes_efforts(self.measures, self.commands):
            return ()
        joints, columns = np.asarray(self.joints), np.asarray(self.columns)
        breaks = np.flatnonzero((np.diff(joints) != 1) | (np.diff(columns) != 1)) + 1
        begin = np.array([0, *breaks], np.intp)[: self.count]
        self.runs = np.stack((begin, np.diff([*begin, self.count])), axis=1).astype(np.intp)
        self.hardware = hardware
        return [int(joint) for joint in joints]

    def exchange(self, world: int, measured: Any, rates: Any, period: float) -> None:
        """Read the joints, and apply efforts towards the targets."""
        for r in range(self.runs.shape[0]):
            self.exchange_run(world, self.runs[r, 0], self.runs[r, 1], measured, rates, period)

    def exchange_run(
        self, world: int, first: int, count: int, measured: Any, rates: Any, period: float
    ) -> None:
        """Exchange with adjacent joints: several at a time, or else one by one."""
        j, k = self.joints_at[first], world * self.count + first
        s = world * self.width + j
        measured, rates = offset(measured, j), offset(rates, j)
        if period <= 0.0 or not are_near(
            count, offset(self.position_at, s), measured, offset(self.targets_at, k),
            rates if self.by_velocity else measured, offset(self.lower_at, first),
            offset(self.upper_at, first),
        ):  # fmt: skip
            for each in range(count):
                self.hardware.read_joint(world, j + each, measured[each], rates[each])
                self.control_joint(world, first + each, period)
                self.hardware.write_joint(world, j + each, period)
            return
        c = world * self.command_width + self.columns_at[first]
        own = offset(self.pid.memory_at, ROWS * world * self.count + first)
        hold(
            count, self.hardware.stopped[world], self.by_velocity, period, measured, rates,
            offset(self.hardware.turning_at, j),
            offset(self.position_at, s), offset(self.velocity_at, s),
            offset(self.hardware.effort_at, s), offset(self.hardware.applied_at, s),
            offset(self.hardware.pushed_at, s), offset(self.command_at, c),
            offset(self.targets_at, k), offset(self.error_at, k), offset(own, LAST * self.count),
            offset(own, P_ERROR * self.count), offset(own, I_ERROR * self.count),
            offset(own, D_ERROR * self.count), offset(own, OUTPUT * self.count),
            offset(self.pid.p_at, first), offset(self.pid.i_at, first),
            offset(self.pid.d_at, first), offset(self.pid.sum_least_at, first),
            offset(self.pid.sum_most_at, first), offset(self.pid.term_least_at, first),
            offset(self.pid.term_most_at, first), offset(self.lower_at, first),
            offset(self.upper_at, first), offset(self.turning_at, first),
            offset(self.hardware.limits.lower_at, j), offset(self.hardware.limits.upper_at, j),
            offset(self.hardware.limits.velocity_at, j), offset(self.hardware.limits.effort_at, j),
        )  # fmt: skip


def are_near(
    count: int, position: Floats, measured: Floats, targets: Floats, values: Floats, lower: Floats,
    upper: Floats,
) -> bool:  # fmt: skip
    """Return whether no joint turned by a radian or is five from its target.

    Then no difference is a whole turn, and all are finite.
    """
    far = 0
    for i in range(count):
        moved = fabs(measured[i] - position[i])
        way = fabs(clamp(targets[i], lower[i], upper[i]) - values[i])
        far += 0 if moved < 1.0 else 1
        far += 0 if way < 5.0 else 1
    return far == 0


def hold(
    count: int, stopped: bool, by_velocity: bool, dt: float,  # noqa: FBT001  native code
    measured: Floats, rates: Floats, follows: Floats, position: Floats, velocity: Floats, effort: Floats,
    applied: Floats, pushed: Floats, command: Floats, targets: Floats, errors: Floats,
    last: Floats, p_error: Floats, i_error: Floats, d_error: Floats, output: Floats,
    p: Floats, i_gain: Floats, d: Floats, sum_least: Floats, sum_most: Floats,
    term_least: Floats, term_most: Floats, lower: Floats, upper: Floats, turning: Floats,
    least: Floats, most: Floats, fastest: Floats, strongest: Floats,
) -> None:  # fmt: skip
    """Read, control and write several joints at a time, as ``exchange_run`` does one by one."""
    for i in range(count):
        rate, at = rates[i], position[i] + shorter(measured[i] - position[i])
        at = at if follows[i] != 0.0 else measured[i]
        position[i], velocity[i], effort[i] = at, rate, applied[i]
        targets[i] = clamp(targets[i], lower[i], upper[i])
        error = targets[i] - (rate if by_velocity else at)
        if turning[i] != 0.0:
            error = within(at, shorter(error), lower[i], upper[i])
        change = (error - last[i]) / dt
        whole = clamp(i_error[i] + dt * error, sum_least[i], sum_most[i])
        out = pid_output(error, whole, change, p[i], i_gain[i], d[i], term_least[i], term_most[i])
        errors[i] = last[i] = p_error[i] = error
        i_error[i], d_error[i], output[i] = whole, change, out
        out = effort_within(out, at, rate, least[i], most[i], fastest[i], strongest[i])
        command[i] = out
        out = finite(0.0 if stopped else out)
        pushed[i] = 1.0 if out != applied[i] else pushed[i]
        applied[i] = out
