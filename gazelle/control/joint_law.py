# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Joints read and commanded as gazebo_ros_control's DefaultRobotHWSim does, in native code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.control.angle_law import distance, shorter, shortest
from cython.cimports.gazelle.control.limit_law import LimitLaw, clamp
from cython.cimports.gazelle.control.pid_law import PidLaw
from cython.cimports.gazelle.native.joint_system import copy
from cython.cimports.gazelle.native.rows import column, offset, start
from cython.cimports.libc.math import isfinite, isnan

from gazelle.array_types import Bools, Floats
from gazelle.native.rows import first_of_run

_TURN = cython.declare(cython.double, 6.283185307179586)

# How a joint is commanded: by an effort, by a position or a velocity that gains turn into one, by
# a motor, or by being put there.
if not cython.compiled:  # else what joint_law.pxd says
    BY_EFFORT, BY_POSITION, BY_VELOCITY, BY_MOTOR, BY_PLACE = 0, 1, 2, 3, 4


@dataclass(frozen=True, slots=True)
class JointMemory:
    """State of joints, shape (nworld, joints) but for ``stopped``; used in place.

    Attributes:
        placed_speed: Of joints that are put somewhere [m/s or rad/s].
        previous: Last commands that limits of positions and velocities go by; NaN for none.
        held: Positions that an emergency stop holds [m or rad].
        desired: Commands within limits.
        stopped: Whether the emergency stop is pressed, shape (nworld,).
    """

    placed_speed: Floats
    previous: Floats
    held: Floats
    desired: Floats
    stopped: Bools

    @classmethod
    def empty(cls, nworld: int, joints: int) -> JointMemory:
        """Return the memory of joints without commands."""
        zero, nothing = np.zeros((2, nworld, joints)), np.full((2, nworld, joints), np.nan)
        return cls(zero[0], nothing[0], nothing[1], zero[1], np.zeros(nworld, bool))


@cython.cclass
class JointLaw:
    """The joints of a robot.

    Args:
        ports: Arrays of a ``JointSystem``, and of the interfaces of the robot: ``measured``,
            ``measured_rate``, ``applied``, ``pushed``, ``speed``, ``driven``; ``position``, ``velocity``,
            ``effort``, shape (nworld, joints); and ``effort_command``, ``position_command`` and
            ``velocity_command``, shape (nworld, n).
        memory: Of the joints.
        turning: Mask of joints that turn, shape (joints,).
        endless: Mask of those without limits.
    """

    def __init__(
        self, ports: Mapping[str, Any], memory: JointMemory, turning: Bools, endless: Bools
    ) -> None:
        self.measured, self.measured_rate = ports["measured"], ports["measured_rate"]
        self.applied, self.pushed = ports["applied"], ports["pushed"]
        self.speed, self.driven = ports["speed"], ports["driven"]
        self.position, self.velocity = ports["position"], ports["velocity"]
        self.effort = ports["effort"]
        self.effort_command = ports["effort_command"]
        self.position_command = ports["position_command"]
        self.velocity_command = ports["velocity_command"]
        self.placed_speed, self.previous = memory.placed_speed, memory.previous
        self.held, self.desired = memory.held, memory.desired
        self.stopped = memory.stopped.view(np.uint8)
        self.turning, self.endless = np.array(turning, np.float64), np.array(endless, np.uint8)
        self.count = self.position.shape[1]
        self.measured_at, self.applied_at = start(self.measured), start(self.applied)
        self.measured_rate_at = start(self.measured_rate)
        self.position_at, self.velocity_at = start(self.position), start(self.velocity)
        self.effort_at, self.turning_at = start(self.effort), column(self.turning)
        self.pushed_at = start(self.pushed)
        self.desired_at, self.command_at = start(self.desired), start(self.effort_command)
        self.width = self.effort_command.shape[1]

    def arrange(self, kinds: Any, columns: Any, limits: LimitLaw, pid: PidLaw) -> None:
        """Command joints in other ways.

        Args:
            kinds: Of each joint, ``BY_EFFORT`` and so on, shape (joints,).
            columns: Columns of their commands.
            limits: Of the joints.
            pid: With a loop for each joint.
        """
        self.kinds, self.columns = np.array(kinds, np.int64), np.array(columns, np.intp)
        self.limits, self.pid = limits, pid
        self.first = first_of_run(columns)
        self.placing = BY_PLACE in kinds
        self.by_effort = self.first >= 0 and all(each == BY_EFFORT for each in kinds)

    def read(self, world: int, measured: Floats, rates: Floats) -> None:
        """Measure; joints that turn are followed round and round, and never jump.

        Args:
            world: Index of the world.
            measured: Positions, in order.
            rates: Velocities.
        """
        count, first = self.count, world * self.count
        at = offset(self.position_at, first)
        if not follow(count, at, measured, self.turning_at):
            for i in range(count):
                if self.turning[i] != 0.0:
                    at[i] += shortest(at[i], measured[i])
                else:
                    at[i] = measured[i]
        copy(count, offset(self.applied_at, first), offset(self.effort_at, first))
        copy(count, rates, offset(self.velocity_at, first))
        if self.placing:
            for i in range(count):
                if self.kinds[i] == BY_PLACE:  # what a step adds to it the next one takes away
                    self.velocity[world, i] = self.placed_speed[world, i]

    def write(self, world: int, period: float) -> None:
        """Apply commands within limits."""
        if self.by_effort:
            self.write_efforts(world)
            return
        for i in range(self.kinds.shape[0]):
            kind, out = self.kinds[i], self.hold(world, i, period)
            self.desired[world, i] = out
            if kind == BY_EFFORT:
                self.push(world, i, out)
            elif kind == BY_MOTOR:
                self.drive(world, i, out)
            elif kind != BY_PLACE:
                out = self.pid.push(world, i, self.error(world, i, out), period, False, 0.0)
                most = self.limits.effort[i]
                self.push(world, i, clamp(out, -most, most))

    def write_efforts(self, world: int) -> None:
        """Apply the commands of joints that all have effort commands."""
        first, stopped = world * self.count, self.stopped[world]
        command = offset(self.command_at, world * self.width + self.first)
        at, rate = offset(self.position_at, first), offset(self.velocity_at, first)
        desired, applied = offset(self.desired_at, first), offset(self.applied_at, first)
        if self.limits.hard:
            write_within(
                self.count, stopped, command, at, rate, desired, applied, offset(self.pushed_at, first),
                self.limits.lower_at, self.limits.upper_at, self.limits.velocity_at,
                self.limits.effort_at,
            )  # fmt: skip
            return
        for i in range(self.count):
            command[i] = self.limits.hold_effort(i, command[i], at[i], rate[i])
            desired[i] = 0.0 if stopped else command[i]
            self.push(world, i, desired[i])

    def hold(self, world: int, i: int, period: float) -> float:
        """Return a command within limits, as modified by the emergency stop."""
        kind, c = self.kinds[i], self.columns[i]
        at, rate = self.position[world, i], self.velocity[world, i]
        if kind == BY_EFFORT:
            value = self.limits.hold_effort(i, self.effort_command[world, c], at, rate)
            self.effort_command[world, c] = value
        elif kind in (BY_POSITION, BY_PLACE):
            value = self.position_command[world, c]
            if self.stopped[world]:
                value = self.held[world, i]
            before = self.previous[world, i]
            value = self.limits.hold_position(i, value, at if isnan(before) else before, period)
            self.previous[world, i] = self.position_command[world, c] = value
            return value
        else:
            value, before = self.velocity_command[world, c], self.previous[world, i]
            before = 0.0 if isnan(before) else before
            value = self.limits.hold_velocity(i, value, at, rate, before, period)
            self.previous[world, i] = self.velocity_command[world, c] = value
        return 0.0 if self.stopped[world] else value

    def error(self, world: int, i: int, desired: float) -> float:
        """Return the error; that of a position goes the way round that limits allow."""
        if self.kinds[i] == BY_VELOCITY:
            return desired - self.velocity[world, i]
        if self.turning[i] == 0.0:
            return desired - self.position[world, i]
        low, high = self.limits.lower[i], self.limits.upper[i]
        return distance(self.position[world, i], desired, self.endless[i], low, high)

    def push(self, world: int, i: int, effort: float) -> None:
        """Apply an effort, added to what acts already."""
        safe = effort if isfinite(effort) else 0.0  # what is not a number would end the world
        if safe != self.applied[world, i]:
            self.applied[world, i], self.pushed[world, i] = safe, 1.0

    def drive(self, world: int, i: int, speed: float) -> None:
        """Set the velocity of a joint's motor."""
        if isfinite(speed) and speed != self.speed[world, i]:
            self.speed[world, i], self.driven[world, i] = speed, 1

    def read_all(self) -> None:
        """Call ``read`` in all worlds, for callers in Python."""
        with cython.nogil:
            for w in range(self.position.shape[0]):
                first = w * self.count
                measured, rates = (
                    offset(self.measured_at, first),
                    offset(self.measured_rate_at, first),
                )
                self.read(w, measured, rates)

    def write_all(self, period: float) -> None:
        """Call ``write`` in all worlds, for callers in Python."""
        since = period
        with cython.nogil:
            for w in range(self.position.shape[0]):
                self.write(w, since)


def follow(count: int, position: Floats, measured: Floats, turning: Floats) -> bool:
    """Follow joints, those that turn the shorter way; False, and nothing done, where one is far."""
    far = 0
    for i in range(count):
        turn = measured[i] - position[i]
        far += 0 if -_TURN < turn < _TURN else 1
    if far > 0:
        return False
    for i in range(count):
        turn = position[i] + shorter(measured[i] - position[i])
        position[i] = turn if turning[i] != 0.0 else measured[i]
    return True


def write_within(
    count: int, stopped: bool, command: Floats, position: Floats, velocity: Floats, desired: Floats,  # noqa: FBT001
    applied: Floats, pushed: Floats, lower: Floats, upper: Floats, fastest: Floats, strongest: Floats,
) -> None:  # fmt: skip
    """Apply efforts within hard limits, several joints at a time; see ``LimitLaw.hold_effort``."""
    for i in range(count):
        low = 0.0 if velocity[i] < -fastest[i] else -strongest[i]
        low = 0.0 if position[i] < lower[i] else low
        high = 0.0 if velocity[i] > fastest[i] else strongest[i]
        high = 0.0 if position[i] > upper[i] else high
        held = min(max(command[i], low), high)
        command[i] = held
        held = 0.0 if stopped else held
        desired[i] = held
        held = held if isfinite(held) else 0.0
        pushed[i] = 1.0 if held != applied[i] else pushed[i]
        applied[i] = held
