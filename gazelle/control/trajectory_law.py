# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Trajectories of joints followed and checked, in native code."""

from __future__ import annotations

from dataclasses import dataclass, fields

import cython
import numpy as np
from cython.cimports.gazelle.control.angle_law import shortest
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.pid_law import PidLaw
from cython.cimports.libc.math import INFINITY, fabs

from gazelle.array_types import Bools, Floats, Ints64
from gazelle.control.interfaces import JointHandles

# What ``TrajectoryMemory.event`` says, the worst first.
if not cython.compiled:  # else what trajectory_law.pxd says
    NOTHING, STRAYED, LATE, THERE = 0, 1, 2, 3


@dataclass(frozen=True, slots=True)
class TrajectoryMemory:
    """State of a trajectory controller, in all worlds; used in place.

    Attributes:
        uptime: Since the start [s], shape (nworld,).
        period: Of the last update [s], likewise.
        desired_position: Positions of the last update [m or rad], shape (nworld, joints).
        desired_velocity: Velocities [m/s or rad/s], likewise.
        desired_acceleration: Accelerations [m/s² or rad/s²], likewise.
        goal: Number of the goal that is active; 0 for none, shape (nworld,).
        reached: Joints that are where it wants them, shape (nworld, joints).
        path: Tolerances on the way: position, velocity, acceleration; shape (nworld, joints, 3).
        end: At the end, likewise.
        patience: Allowed delay of a goal's end [s], shape (nworld,).
        event: Outcome of a goal that was not reported yet, shape (nworld,).
        event_goal: Its goal, likewise.
        event_joint: Of the joint that strayed or is late, likewise.
        event_error: Its error [m or rad], likewise.
    """

    uptime: Floats
    period: Floats
    desired_position: Floats
    desired_velocity: Floats
    desired_acceleration: Floats
    goal: Ints64
    reached: Bools
    path: Floats
    end: Floats
    patience: Floats
    event: Ints64
    event_goal: Ints64
    event_joint: Ints64
    event_error: Floats

    @classmethod
    def empty(cls, nworld: int, joints: int) -> TrajectoryMemory:
        """Return the memory of a controller that was never started."""
        shapes: dict[str, tuple[int, ...]] = {
            field.name: (nworld, joints)
            for field in fields(cls)
            if field.name.startswith("desired") or field.name == "reached"
        }
        shapes |= dict.fromkeys(("path", "end"), (nworld, joints, 3))
        kinds = {"goal": np.int64, "reached": np.bool_, "event": np.int64}
        kinds |= {"event_goal": np.int64, "event_joint": np.int64}
        return cls(
            **{
                field.name: np.zeros(
                    shapes.get(field.name, (nworld,)), kinds.get(field.name, np.float64)
                )
                for field in fields(cls)
            }
        )


@cython.cclass
class TrajectoryLaw(ControlLaw):
    """Follows the segments of a ``TrajectoryTable``, which passes them to ``follow``.

    Args:
        joints: To be read and commanded.
        memory: Of the controller.
    """

    def __init__(self, joints: JointHandles, memory: TrajectoryMemory) -> None:
        ControlLaw.__init__(self, len(memory.uptime))
        self.position, self.velocity = joints.states.position, joints.states.velocity
        self.joints = joints.columns
        self.uptime, self.period = memory.uptime, memory.period
        self.desired_position, self.desired_velocity = (
            memory.desired_position,
            memory.desired_velocity,
        )
        self.desired_acceleration = memory.desired_acceleration
        self.goal, self.reached = memory.goal, memory.reached.view(np.uint8)
        self.path, self.end, self.patience = memory.path, memory.end, memory.patience
        self.event, self.event_goal = memory.event, memory.event_goal
        self.event_joint, self.event_error = memory.event_joint, memory.event_error
        spare = np.zeros((self.nworld, len(joints.states.resources)))
        given = {name: each[0] for name, each in joints.commands.items()}
        self.columns = next(iter(joints.commands.values()))[1]
        self.places, self.speeds = "position" in given, "velocity" in given
        self.bends, self.by_pid = "acceleration" in given, False
        self.position_command = given.get("position", spare)
        self.velocity_command = given.get("velocity", spare)
        self.acceleration_command = given.get("acceleration", spare)
        self.effort_command = spare

    def push_by(self, pid: PidLaw, forward: Floats, command: Floats) -> None:
        """Command what a PID makes of errors.

        Args:
            pid: With as many loops as joints.
            forward: On the desired velocity besides, shape (joints,).
            command: Of the interface, in which the joints are.
        """
        self.pid, self.forward, self.effort_command, self.by_pid = pid, forward, command, True

    def follow(self, start: Floats, duration: Floats, polynomials: Floats, goals: Ints64) -> None:
        """Set the segments, the arrays of a ``TrajectoryTable``."""
        self.start, self.duration = start, duration
        self.polynomials, self.goals = polynomials, goals
        self.at = np.full(start.shape[:2], -1, np.intp)
        # What acts, side by side: begin, duration, begin of the next, and a polynomial.
        self.acting = np.zeros((*start.shape[:2], 9))

    def segment(self, world: int, joint: int, time: float) -> int:
        """Return the active segment: the last that has started, or the first before its time."""
        c, last = self.at[world, joint], self.start.shape[2] - 1
        if c >= 0 and self.acting[world, joint, 0] <= time < self.acting[world, joint, 2]:
            return c
        if c < 0 or self.start[world, joint, c] > time:
            c = last
            while c > 0 and self.start[world, joint, c] > time:
                if self.start[world, joint, c - 1] == INFINITY:
                    return c
                c -= 1
        while c < last and self.start[world, joint, c + 1] <= time:
            c += 1
        self.at[world, joint] = c
        self.acting[world, joint, 0] = self.start[world, joint, c]
        self.acting[world, joint, 1] = self.duration[world, joint, c]
        self.acting[world, joint, 2] = INFINITY if c == last else self.start[world, joint, c + 1]
        for k in range(6):
            self.acting[world, joint, 3 + k] = self.polynomials[world, joint, c, k]
        return c

    def sample(self, world: int, joint: int, time: float) -> None:
        """Evaluate the active segment of a joint."""
        t, lasting = time - self.acting[world, joint, 0], self.acting[world, joint, 1]
        moving = 1.0
        if t < 0.0:
            t, moving = 0.0, 0.0
        elif t > lasting:
            t, moving = lasting, 0.0
        c0, c1 = self.acting[world, joint, 3], self.acting[world, joint, 4]
        c2, c3 = self.acting[world, joint, 5], self.acting[world, joint, 6]
        c4, c5 = self.acting[world, joint, 7], self.acting[world, joint, 8]
        self.desired_position[world, joint] = c0 + t * (
            c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))
        )
        self.desired_velocity[world, joint] = moving * (
            c1 + t * (2 * c2 + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))
        )
        self.desired_acceleration[world, joint] = moving * (
            2 * c2 + t * (6 * c3 + t * (12 * c4 + t * 20 * c5))
        )

    def control(self, world: int, now: int, period: float) -> None:  # noqa: ARG002  as of others
        """Follow, check, command."""
        self.uptime[world] += period
        self.period[world] = period
        time, all_there = self.uptime[world], True
        missed = self.goal[world] > 0
        for i in range(self.joints.shape[0]):
            c = self.segment(world, i, time)
            self.sample(world, i, time)
            error = shortest(self.position[world, self.joints[i]], self.desired_position[world, i])
            velocity_error = self.desired_velocity[world, i] - self.velocity[world, self.joints[i]]
            if missed:
                self.check_tolerances(world, i, c, time, error, velocity_error)
                all_there = all_there and self.reached[world, i]
            self.command(world, i, error, velocity_error, period)
        if missed and self.event[world] == NOTHING and all_there:
            self.report(world, THERE, 0, 0.0)
        if missed and self.event[world] != NOTHING:
            self.event_goal[world] = self.goal[world]
            self.goal[world] = 0

    def check_tolerances(
        self, world: int, i: int, c: int, time: float, error: float, velocity_error: float
    ) -> None:
        """Check whether a joint is within the goal's tolerances."""
        if self.goals[world, i, c] != self.goal[world]:
            return
        end = self.acting[world, i, 0] + self.acting[world, i, 1]
        if time < end:
            if not within(error, velocity_error, self.path[world, i, 0], self.path[world, i, 1]):
                self.report(world, STRAYED, i, error)
        elif c == self.start.shape[2] - 1:
            there = within(error, velocity_error, self.end[world, i, 0], self.end[world, i, 1])
            if there:
                self.reached[world, i] = 1
            elif time >= end + self.patience[world]:
                self.report(world, LATE, i, error)

    def report(self, world: int, code: int, joint: int, error: float) -> None:
        """Record the outcome of a goal: its worst violation, of the first joint."""
        if self.event[world] == NOTHING or code < self.event[world]:
            self.event[world], self.event_joint[world] = code, joint
            self.event_error[world] = error

    def command(
        self, world: int, i: int, error: float, velocity_error: float, period: float
    ) -> None:
        """Write the desired values as commands, or the output of a PID for the errors."""
        if self.by_pid:
            self.effort_command[world, self.columns[i]] = self.forward[i] * self.desired_velocity[
                world, i
            ] + self.pid.push(world, i, error, period, True, velocity_error)
            return
        if self.places:
            self.position_command[world, self.columns[i]] = self.desired_position[world, i]
        if self.speeds:
            self.velocity_command[world, self.columns[i]] = self.desired_velocity[world, i]
        if self.bends:
            self.acceleration_command[world, self.columns[i]] = self.desired_acceleration[world, i]


def within(position: float, velocity: float, far: float, fast: float) -> bool:
    """Return whether errors are within bounds; 0 is none."""
    return not ((far > 0.0 and fabs(position) > far) or (fast > 0.0 and fabs(velocity) > fast))
