"""Joints of a simulated robot as controllers see them: what gazebo_ros_control's DefaultRobotHWSim does.

A joint is commanded through one interface at a time. Gains turn a position or a velocity into an effort;
without gains a joint is put at its position, and a motor holds its velocity. Commands are held within the
joint's limits at every physics step.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Indices, Worlds
from gazelle.control import (
    EFFORT,
    POSITION,
    VELOCITY,
    ControllerInfo,
    JointCommandInterface,
    RobotHardware,
)
from gazelle.control.angles import distance, shortest
from gazelle.control.limits import EffortLimiter, JointLimits, PositionLimiter, VelocityLimiter
from gazelle.control.pid import Pid, PidGains
from gazelle.description import Model
from gazelle.errors import SimulationError
from gazelle.simulation.robot import Robot
from gazelle.simulation.sensor_hardware import sensor_interfaces

INTERFACES = (EFFORT, POSITION, VELOCITY)
"""Those that a simulated joint can be commanded through."""

# A joint that is put somewhere faster than this jumped, and has no velocity [m/s or rad/s].
_JUMP = 100.0

# What a motor may use at most where the robot's file gives no effort limit [N or N m].
_STRONG = 1e6


@dataclass(frozen=True, slots=True)
class CommandedJoint:
    """A joint that controllers command.

    Attributes:
        name: Within the robot.
        interfaces: That it can be commanded through, at least one; the first one acts at first.
        limits: That commands are held within.
        gains: For positions and velocities; None to be put there.
    """

    name: str
    interfaces: tuple[str, ...]
    limits: JointLimits = field(default_factory=JointLimits)
    gains: PidGains | None = None


@dataclass(frozen=True, slots=True)
class HardwareSetup:
    """What the robot's side of control is made of.

    Attributes:
        namespace: Of the robot.
        joints: To be commanded.
        model: The robot as its URDF describes it.
        parameters: Of the plugin that asks, as tags; None without one.
    """

    namespace: str
    joints: Sequence[CommandedJoint]
    model: Model
    parameters: Any = None


class SimulatedHardware(RobotHardware):
    """Base class of the robot's side in a simulation; ``robotSimType`` may name a subclass of yours.

    Args:
        robot: In the simulation.
        setup: What was found in its files.
    """

    def __init__(self, robot: Robot, setup: HardwareSetup) -> None:
        super().__init__(robot.simulation.nworld)
        self.robot, self.setup = robot, setup

    @property
    def idle(self) -> bool:
        """Whether nothing is to be done while no controller runs."""
        return False

    @property
    def motors(self) -> frozenset[str]:
        """The joints on which it has put motors; what takes its place switches those off."""
        return frozenset()

    def stop_emergency(self, stopped: Bools) -> None:
        """Whether the emergency stop is pressed now, shape (nworld,); told before every step."""


class JointHardware(SimulatedHardware):
    """Joints with one axis each.

    Raises:
        SimulationError: The model has no joint of a name that moves, or one has several axes.
    """

    def __init__(self, robot: Robot, setup: HardwareSetup) -> None:
        super().__init__(robot, setup)
        self._joints = tuple(setup.joints)
        names = [each.name for each in self._joints]
        self._handles = [robot.joints[name] for name in names]
        self._names = [handle.name for handle in self._handles]
        self._loads = robot.simulation.loads
        for handle in self._handles:
            if handle.axes != 1:
                raise SimulationError(
                    f"joint '{handle.name}' has {handle.axes} axes and cannot be controlled"
                )
        offered = {
            kind: [each.name for each in self._joints if kind in each.interfaces]
            for kind in INTERFACES
        }
        self.states = self.register_joints(names, {k: of for k, of in offered.items() if of})
        for interface in sensor_interfaces(robot):
            self.register(interface)
        described = [robot.joint_description(name) for name in names]
        self._turning = np.array([each.type != "prismatic" for each in described], bool)
        self._lower = np.array([each.limits.lower for each in self._joints])
        self._upper = np.array([each.limits.upper for each in self._joints])
        self._endless = self._turning & np.isinf(self._lower) & np.isinf(self._upper)
        self._strength = np.array([each.limits.effort for each in self._joints])
        self._active = [each.interfaces[0] for each in self._joints]
        self._stopped: Bools = np.zeros(self.nworld, bool)
        self._held: Floats = np.full((self.nworld, len(names)), math.nan)
        self._motors: dict[int, Floats] = {}
        self._placed: Floats = np.full((self.nworld, len(names)), math.nan)
        self._pids: dict[str, Pid] = {}
        self._applied, self._speeds = np.zeros((2, self.nworld, len(names)))
        self._arrange()

    # -- arranging ---------------------------------------------------------------------

    def _arrange(self) -> None:
        """Sort the joints by how they are commanded now."""
        self._columns: dict[str, Indices] = {}
        self._commands: dict[str, tuple[Floats, Indices]] = {}
        for kind in INTERFACES:
            chosen = [i for i, active in enumerate(self._active) if active == kind]
            self._columns[kind] = np.array(chosen, np.intp)
            if chosen:
                table = self.interfaces[kind]
                if isinstance(table, JointCommandInterface):
                    own = [table.resources.index(self._joints[i].name) for i in chosen]
                    values = next(iter(table.commands.values()))
                    self._commands[kind] = (values, np.array(own, np.intp))
        self._limit()
        self._tune()
        self._put = set(self._columns[POSITION][~self._with_gains[POSITION]].tolist())
        self._move_motors()

    def _limit(self) -> None:
        limits = {
            kind: [self._joints[i].limits for i in self._columns[kind]] for kind in INTERFACES
        }
        self._effort_limiter = EffortLimiter(limits[EFFORT])
        self._position_limiter = PositionLimiter(limits[POSITION], self.nworld)
        self._velocity_limiter = VelocityLimiter(limits[VELOCITY], self.nworld)

    def _tune(self) -> None:
        """Find out which joints have gains, and which have not."""
        self._with_gains: dict[str, Bools] = {}
        for kind in (POSITION, VELOCITY):
            gains = [self._joints[i].gains for i in self._columns[kind]]
            self._with_gains[kind] = np.array([each is not None for each in gains], bool)
            self._pids[kind] = Pid([each for each in gains if each is not None], self.nworld)

    def _move_motors(self) -> None:
        """Put motors on joints that hold velocities, and switch those of others off."""
        wanted = set(self._columns[VELOCITY][~self._with_gains[VELOCITY]].tolist())
        for index in [*self._motors]:
            if index not in wanted:
                self._handles[index].add_motor(0.0)
                del self._motors[index]
        for index in sorted(wanted):
            if index not in self._motors:
                strength = self._strength[index]
                self._handles[index].add_motor(min(_STRONG, strength))
                self._motors[index] = np.full(self.nworld, math.nan)

    @property
    def motors(self) -> frozenset[str]:
        """Those that hold velocities without gains."""
        return frozenset(self._joints[index].name for index in self._motors)

    def do_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> None:
        """Command joints through the interfaces that controllers claim."""
        del stop
        names = [each.name for each in self._joints]
        before = list(self._active)
        for info in start:
            for kind, claimed in info.claimed.items():
                for name in claimed if kind in INTERFACES else ():
                    self._active[names.index(name)] = kind
        pairs = enumerate(zip(before, self._active, strict=True))
        left = np.array([index for index, (old, new) in pairs if old != new], np.intp)
        if left.size:
            self._set_efforts(left, np.zeros((self.nworld, left.size)))
            self._arrange()

    # -- the loop ----------------------------------------------------------------------

    def read(self, time: float, period: float) -> None:  # noqa: ARG002  it asks the engine
        """Measure; joints that turn are followed round and round, and never jump."""
        if not self._handles:
            return
        states = self.states
        engine = self.robot.simulation.engine
        measured = np.concatenate([engine.joint_position(name) for name in self._names], axis=1)
        onward = states.position + shortest(states.position, measured)
        states.position[:] = np.where(self._turning, onward, measured)
        states.effort[:] = self._applied
        for column, name in enumerate(self._names):
            if column not in self._put:
                states.velocity[:, column] = engine.joint_velocity(name)[:, 0]
            else:  # what a step adds to it the next one takes away
                states.velocity[:, column] = self._speeds[:, column]

    def stop_emergency(self, stopped: Bools) -> None:
        """Take the power from joints, and hold those where they are that hold positions."""
        begun = stopped & ~self._stopped
        self._held[begun] = self.states.position[begun]
        self._stopped = stopped.copy()

    @property
    def idle(self) -> bool:
        """Whether efforts are all that is commanded, and there are none."""
        if self._columns[POSITION].size or self._columns[VELOCITY].size:
            return False
        commands = [values for values, _ in self._commands.values()]
        return not (self._applied.any() or any(values.any() for values in commands))

    def write(self, time: float, period: float) -> None:  # noqa: ARG002  it needs no time
        """Hold the commands within limits, and act on them."""
        for kind, act in (
            (EFFORT, self._write_efforts),
            (POSITION, self._write_positions),
            (VELOCITY, self._write_velocities),
        ):
            if kind in self._commands:
                act(period)

    def _state(self, kind: str) -> tuple[Floats, Floats]:
        columns = self._columns[kind]
        return self.states.position[:, columns], self.states.velocity[:, columns]

    def _write_efforts(self, period: float) -> None:
        del period
        values, own = self._commands[EFFORT]
        limited = self._effort_limiter.enforce(values[:, own], *self._state(EFFORT))
        values[:, own] = limited
        efforts = np.where(self._stopped[:, None], 0.0, limited)
        self._set_efforts(self._columns[EFFORT], efforts)

    def _write_positions(self, period: float) -> None:
        values, own = self._commands[POSITION]
        columns = self._columns[POSITION]
        position, _ = self._state(POSITION)
        if self._stopped.any():
            stopped = self._stopped[:, None]
            values[:, own] = np.where(stopped, self._held[:, columns], values[:, own])
        wanted = self._position_limiter.enforce(values[:, own], position, period)
        values[:, own] = wanted
        pushed = self._with_gains[POSITION]
        if pushed.any():
            there = columns[pushed]
            error = self._error(position[:, pushed], wanted[:, pushed], there)
            self._push(POSITION, there, error, period)
        for row in np.flatnonzero(~pushed).tolist():
            self._place(int(columns[row]), wanted[:, row], period)

    def _error(self, position: Floats, wanted: Floats, columns: Indices) -> Floats:
        """What is missing, the way round that limits allow."""
        low, high = self._lower[columns], self._upper[columns]
        turned = distance(position, wanted, self._endless[columns], low, high)
        return np.where(self._turning[columns], turned, wanted - position)

    def _write_velocities(self, period: float) -> None:
        values, own = self._commands[VELOCITY]
        columns = self._columns[VELOCITY]
        limited = self._velocity_limiter.enforce(values[:, own], *self._state(VELOCITY), period)
        values[:, own] = limited
        wanted = np.where(self._stopped[:, None], 0.0, limited)
        pushed = self._with_gains[VELOCITY]
        if pushed.any():
            there = columns[pushed]
            error = wanted[:, pushed] - self.states.velocity[:, there]
            self._push(VELOCITY, there, error, period)
        for row in np.flatnonzero(~pushed).tolist():
            index, speeds = int(columns[row]), wanted[:, row]
            if not np.array_equal(self._motors[index], speeds):
                self._motors[index] = speeds.copy()
                self._handles[index].drive(speeds)

    def _push(self, kind: str, columns: Indices, error: Floats, period: float) -> None:
        """Turn errors into efforts."""
        most = self._strength[columns]
        efforts = np.clip(self._pids[kind].compute(error, period), -most, most)
        self._set_efforts(columns, efforts)

    def _place(self, index: int, wanted: Floats, period: float) -> None:
        """Put a joint where it has to be after the step, as fast as its command moves."""
        handle, before = self._handles[index], self._placed[:, index]
        good = np.isfinite(wanted)
        speed = np.zeros(self.nworld)
        if period > 0.0:
            moved = np.isfinite(before) & good
            speed[moved] = (wanted[moved] - before[moved]) / period
            speed[np.abs(speed) > _JUMP] = 0.0
        self._placed[:, index] = np.where(good, wanted, before)
        self._speeds[:, index] = speed
        rows = None if good.all() else np.flatnonzero(good)
        chosen = slice(None) if rows is None else rows
        engine = self.robot.simulation.engine
        start = wanted - speed * period
        engine.set_joint_position(handle.name, start[chosen, None], rows)
        engine.set_joint_velocity(handle.name, speed[chosen, None], rows)

    def _set_efforts(self, columns: Indices, efforts: Floats) -> None:
        """Let efforts act on joints, shape (nworld, n)."""
        # What is no number would end the world; the engine is spared it.
        safe = np.where(np.isfinite(efforts), efforts, 0.0)
        changed = (safe != self._applied[:, columns]).any(axis=0)
        # What acts already, such as what Python makes of a joint that nothing controls, stays.
        for row in np.flatnonzero(changed).tolist():
            index = int(columns[row])
            self._applied[:, index] = safe[:, row]
            self._loads.set_lasting(self._names[index], safe[:, row, None])

    # -- beginning anew ----------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Know nothing of these worlds."""
        rows = slice(None) if worlds is None else worlds
        states = self.states
        states.position[rows] = states.effort[rows] = 1.0
        states.velocity[rows] = self._applied[rows] = self._speeds[rows] = 0.0
        self._stopped[rows] = False
        self._held[rows] = self._placed[rows] = math.nan
        self._position_limiter.previous[rows] = math.nan
        self._velocity_limiter.previous[rows] = 0.0
        for pid in self._pids.values():
            pid.reset(worlds)
        for interface in self.interfaces.values():
            if isinstance(interface, JointCommandInterface):
                for values in interface.commands.values():
                    values[rows] = 0.0
        for speeds in self._motors.values():
            speeds[rows] = math.nan

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """All that changes."""
        own = {
            "stopped": self._stopped.copy(),
            "held": self._held.copy(),
            "placed": self._placed.copy(),
            "applied": self._applied.copy(),
            "speeds": self._speeds.copy(),
            "active": np.array([INTERFACES.index(each) for each in self._active], np.int64),
            "position_before": self._position_limiter.previous.copy(),
            "velocity_before": self._velocity_limiter.previous.copy(),
        }
        for kind, pid in self._pids.items():
            own |= {f"pid.{kind}.{name}": value for name, value in pid.state().items()}
        return {**super().state(), **own}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        super().restore(state)
        active = [INTERFACES[int(each)] for each in state["active"]]
        if active != self._active:
            self._active = active
            self._arrange()
        self._stopped = np.array(state["stopped"], bool)
        self._held, self._placed = np.array(state["held"]), np.array(state["placed"])
        self._applied, self._speeds = np.array(state["applied"]), np.array(state["speeds"])
        self._position_limiter.previous = np.array(state["position_before"])
        self._velocity_limiter.previous = np.array(state["velocity_before"])
        for kind, pid in self._pids.items():
            begin = f"pid.{kind}."
            pid.restore({k.removeprefix(begin): v for k, v in state.items() if k.startswith(begin)})
        for speeds in self._motors.values():
            speeds[:] = math.nan
