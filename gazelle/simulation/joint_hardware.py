"""Joints of a simulated robot as controllers see them: what gazebo_ros_control's DefaultRobotHWSim does.

A joint is commanded through one interface at a time. Gains turn a position or a velocity into an effort;
without gains a joint is put at its position, and a motor holds its velocity. Commands are held within the
joint's limits at every physics step.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.control import (
    EFFORT,
    POSITION,
    VELOCITY,
    ControllerInfo,
    JointCommandInterface,
)
from gazelle.control.actuators import ActuatorStateInterface, drive_of
from gazelle.control.control_cycle import ControlCycle
from gazelle.control.interfaces import COMMAND_FIELDS
from gazelle.control.joint_law import (
    BY_EFFORT,
    BY_MOTOR,
    BY_PLACE,
    BY_POSITION,
    BY_VELOCITY,
    JointLaw,
    JointMemory,
)
from gazelle.control.limits import limit_law
from gazelle.control.pid import Pid, PidGains
from gazelle.engines.state import JointRows
from gazelle.errors import SimulationError
from gazelle.simulation.robot import Robot
from gazelle.simulation.sensor_hardware import sensor_interfaces
from gazelle.simulation.simulated_hardware import (
    INTERFACES,
    CommandedJoint,
    HardwareSetup,
    SimulatedHardware,
)

__all__ = ["INTERFACES", "CommandedJoint", "HardwareSetup", "JointHardware", "SimulatedHardware"]

# How a joint is commanded through an interface, without gains and with them.
_WAYS = {
    EFFORT: (BY_EFFORT, BY_EFFORT),
    POSITION: (BY_PLACE, BY_POSITION),
    VELOCITY: (BY_MOTOR, BY_VELOCITY),
}

# A joint that is put somewhere faster than this jumped, and has no velocity [m/s or rad/s].
_JUMP = 100.0

# What a motor may use at most where the robot's file gives no effort limit [N or N m].
_STRONG = 1e6


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
        self._names = tuple(handle.name for handle in self._handles)
        self._engine = robot.simulation.engine
        self._rows = self._engine.joints[self._names]
        self._applied_wrenches = robot.simulation.applied_wrenches
        described = [robot.joint_description(name) for name in names]
        for handle, joint in zip(self._handles, described, strict=True):
            # Read the description, not the engine: that would compile again for every robot.
            if len(joint.axes) != 1:
                count = handle.axes
                raise SimulationError(
                    f"joint '{handle.name}' has {count} axes and cannot be controlled"
                )
        offered = {
            kind: [each.name for each in self._joints if kind in each.interfaces]
            for kind in INTERFACES
        }
        self.states = self.register_joints(names, {k: of for k, of in offered.items() if of})
        if setup.transmissions:
            drives = [drive_of(each) for each in setup.transmissions]
            self.register(ActuatorStateInterface(drives, self.states))
        for interface in sensor_interfaces(robot):
            self.register(interface)
        lower = np.array([each.limits.lower for each in self._joints])
        upper = np.array([each.limits.upper for each in self._joints])
        turning = np.array([each.type != "prismatic" for each in described], bool)
        endless = turning & np.isinf(lower) & np.isinf(upper)
        self._limited = np.flatnonzero(turning & ~endless)
        self._strength = np.array([each.limits.effort for each in self._joints])
        self._active = [each.interfaces[0] for each in self._joints]
        self._placed: Floats = np.full((self.nworld, len(names)), math.nan)
        self._memory = JointMemory.empty(self.nworld, len(names))
        self.cycle = ControlCycle(self.nworld, len(names))
        self._bound = -1, False  # revision of the engine, and whether its steps can call the cycle
        self.law = JointLaw(self._ports(), self._memory, turning, endless)
        self._limits = limit_law([each.limits for each in self._joints])
        self._pid = Pid([each.gains or PidGains() for each in self._joints], self.nworld)
        self._motors: set[int] = set()
        self._arrange()

    def _ports(self) -> dict[str, Any]:
        """Return the arrays that native code works on."""
        cycle, states = self.cycle, self.states
        ports: dict[str, Any] = {
            "measured": cycle.position_in, "measured_rate": cycle.velocity_in,
            "applied": cycle.effort_out, "pushed": cycle.pushed_out,
            "speed": cycle.speed_out, "driven": cycle.driven_out,
            "position": states.position, "velocity": states.velocity, "effort": states.effort,
        }  # fmt: skip
        for kind in INTERFACES:
            table, field = self.interfaces.get(kind), COMMAND_FIELDS[kind][0]
            known = isinstance(table, JointCommandInterface)
            ports[f"{field}_command"] = table.commands[field] if known else np.zeros((1, 1))  # type: ignore[union-attr]
        return ports

    # -- arranging ---------------------------------------------------------------------

    def _arrange(self) -> None:
        """Sort the joints by how they are commanded now."""
        kinds, columns = [], []
        for joint, active in zip(self._joints, self._active, strict=True):
            kinds.append(_WAYS[active][joint.gains is not None])
            columns.append(self.interfaces[active].resources.index(joint.name))
        self._kinds = np.array(kinds, np.int64)
        self._put = np.flatnonzero(self._kinds == BY_PLACE)
        self._put_names = tuple(self._names[index] for index in self._put.tolist())
        self._memory.previous[:] = math.nan
        self._pid.reset()
        self.law.arrange(self._kinds, columns, self._limits, self._pid.law)
        self._move_motors()

    def _move_motors(self) -> None:
        """Add motors to joints that hold velocities, and switch off those of others."""
        needed = set(np.flatnonzero(self._kinds == BY_MOTOR).tolist())
        for index in sorted(self._motors - needed):
            self._handles[index].add_motor(0.0)
        for index in sorted(needed - self._motors):
            self._handles[index].add_motor(min(_STRONG, self._strength[index]))
            self.cycle.speed_out[:, index] = math.nan
        self._motors = needed

    @property
    def motors(self) -> frozenset[str]:
        """Joints that hold velocities without gains."""
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
            self.cycle.pushed_out[:, left] = self.cycle.effort_out[:, left] != 0.0
            self.cycle.effort_out[:, left] = 0.0
            self._act()
            self._arrange()
        needed = {name for info in start for held in info.claimed.values() for name in held}
        some = [index for index, name in enumerate(names) if name in needed]
        self._forget(some, np.arange(self.nworld))

    def _forget(self, joints: Iterable[int], worlds: Worlds) -> None:
        """Hold the current joint positions and discard earlier commands."""
        by_position = (BY_POSITION, BY_PLACE)
        some = np.array([i for i in joints if self._kinds[i] in by_position], np.intp)
        cells = np.ix_(worlds, some)
        self._memory.previous[cells] = self._placed[cells] = math.nan
        self._pid.forget_rates(some, worlds)

    # -- the loop ----------------------------------------------------------------------

    def read(self, time: float, period: float) -> None:  # noqa: ARG002  it reads the engine
        """Measure; joints that turn are followed round and round, and never jump."""
        self._read_joints()
        self.law.read_all()

    def measure(self, time: float) -> None:
        """Read the joints; positions of joints with limits are not wrapped."""
        self._read_joints()
        states = self.states
        states.position[:, self._limited] = self.cycle.position_in[:, self._limited]
        self.read(time, 0.0)

    def _read_joints(self) -> None:
        """Read where the joints are."""
        if self._names:
            self._bound_rows().read(self.cycle)

    def _bound_rows(self, *, in_step: bool = False) -> JointRows:
        """Return the joints, to which the cycle is bound."""
        needed = in_step or self._bound[1]
        if self._bound != (self._engine.revision, needed):
            self._rows.bind(self.cycle, in_step=needed)
            self._bound = self._engine.revision, needed
        return self._rows

    def stop_emergency(self, stopped: Bools) -> None:
        """Switch off efforts, and hold position-controlled joints where they are."""
        memory = self._memory
        begun = stopped & ~memory.stopped
        if begun.any():
            self.measure(self.robot.simulation.time)
            self._forget(range(len(self._joints)), np.flatnonzero(begun))
        memory.held[begun] = self.states.position[begun]
        memory.stopped[:] = stopped

    @property
    def idle(self) -> bool:
        """True if only efforts are commanded, and all are zero."""
        if (self._kinds != BY_EFFORT).any():
            return False
        commands = [each for each in self.interfaces.values() if each.name == EFFORT]
        needed = [each.commands for each in commands if isinstance(each, JointCommandInterface)]
        return not (
            self.cycle.effort_out.any() or any(v.any() for each in needed for v in each.values())
        )

    @property
    def in_step(self) -> ControlCycle | None:
        """Control cycle that an engine can run in its steps; None while Python has to act on joints."""
        own = type(self)
        if own.read is not JointHardware.read or own.write is not JointHardware.write:
            return None
        simulation = self.robot.simulation
        if not (self._names and simulation.controls_in_step) or self._put_names:
            return None
        if self._applied_wrenches.turns(self._names) or not self._rows.in_step:
            return None
        self._bound_rows(in_step=True)
        return self.cycle

    def write(self, time: float, period: float) -> None:  # noqa: ARG002  it needs no time
        """Apply the commands within limits."""
        self.law.write_all(period)
        if self._put_names:
            self._place(period)
        self._act()

    def _act(self) -> None:
        """Apply the commands that changed."""
        cycle = self.cycle
        if not (cycle.pushed_out.any() or cycle.driven_out.any()):
            return
        if not self._applied_wrenches.turns(self._names):
            self._bound_rows().act(cycle)
            return
        for index in np.flatnonzero(cycle.pushed_out.any(axis=0)).tolist():
            rows = np.flatnonzero(cycle.pushed_out[:, index])
            self._applied_wrenches.set_lasting(
                self._names[index], cycle.effort_out[rows, index, None], rows
            )
        for index in np.flatnonzero(cycle.driven_out.any(axis=0)).tolist():
            rows = np.flatnonzero(cycle.driven_out[:, index])
            self._handles[index].drive(cycle.speed_out[rows, index], rows)
        cycle.pushed_out[:], cycle.driven_out[:] = 0.0, 0

    def _place(self, period: float) -> None:
        """Set joint positions for the next step, at the speed of their commands."""
        put = self._put
        desired, before = self._memory.desired[:, put], self._placed[:, put]
        good = np.isfinite(desired)
        speed = np.zeros(desired.shape)
        if period > 0.0:
            moved = np.isfinite(before) & good
            speed[moved] = (desired[moved] - before[moved]) / period
            speed[np.abs(speed) > _JUMP] = 0.0
        self._placed[:, put] = np.where(good, desired, before)
        self._memory.placed_speed[:, put] = speed
        self._engine.joints[self._put_names].place(desired - speed * period, speed, good)

    # -- restarting ----------------------------------------------------------------

    def reset(self, worlds: Worlds | None) -> None:
        """Discard the state of these worlds."""
        rows = slice(None) if worlds is None else worlds
        states, memory, cycle = self.states, self._memory, self.cycle
        states.position[rows] = states.effort[rows] = 1.0
        states.velocity[rows] = memory.placed_speed[rows] = 0.0
        cycle.effort_out[rows], cycle.speed_out[rows] = 0.0, math.nan
        cycle.pushed_out[rows], cycle.driven_out[rows] = 0.0, 0
        memory.stopped[rows] = False
        memory.held[rows] = memory.previous[rows] = self._placed[rows] = math.nan
        self._pid.reset(worlds)
        for interface in self.interfaces.values():
            if isinstance(interface, JointCommandInterface):
                for values in interface.commands.values():
                    values[rows] = 0.0

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state."""
        memory = self._memory
        own = {
            "stopped": memory.stopped.copy(),
            "held": memory.held.copy(),
            "placed": self._placed.copy(),
            "applied": self.cycle.effort_out.copy(),
            "speeds": memory.placed_speed.copy(),
            "active": np.array([INTERFACES.index(each) for each in self._active], np.int64),
            "previous": memory.previous.copy(),
        }
        own |= {f"pid.{name}": value for name, value in self._pid.state().items()}
        return {**super().state(), **own}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        super().restore(state)
        active = [INTERFACES[int(each)] for each in state["active"]]
        if active != self._active:
            self._active = active
            self._arrange()
        memory = self._memory
        memory.stopped[:], memory.held[:] = state["stopped"], state["held"]
        memory.placed_speed[:], memory.previous[:] = state["speeds"], state["previous"]
        self._placed[:], self.cycle.effort_out[:] = state["placed"], state["applied"]
        self.cycle.speed_out[:] = math.nan
        self.cycle.pushed_out[:], self.cycle.driven_out[:] = 0.0, 0
        self._pid.restore({name: state[f"pid.{name}"] for name in ("p", "i", "last")})
