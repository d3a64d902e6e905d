"""Controllers of a simulated robot, between its physics steps."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Worlds
from gazelle.control import ControllerManager
from gazelle.control.control_cycle import ControlCycle
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import state_below
from gazelle.control.joint_law import JointLaw
from gazelle.control.limits import JointLimits
from gazelle.description import Model
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import ControlWarning
from gazelle.simulation.joint_hardware import JointHardware
from gazelle.simulation.plugin import ModelPlugin
from gazelle.simulation.plugin_system import InStepWork, PluginSystem
from gazelle.simulation.robot import Robot
from gazelle.simulation.scheduled_plugin import make_scheduled
from gazelle.simulation.simulated_hardware import (
    INTERFACES,
    CommandedJoint,
    HardwareSetup,
    SimulatedHardware,
)

R = TypeVar("R")


class ControlLoop(ModelPlugin):
    """Reads joints, updates controllers, and writes their commands, as gazebo_ros_control does.

    Controllers act once a control period; limits act at every physics step. The first period after
    loading and after a reset is one period, however late that is.

    Attributes:
        manager: Of the controllers.
        hardware: Of the robot.
    """

    update_rate = 0.0

    def begin(
        self, robot: Robot, hardware: SimulatedHardware, model: Model, namespace: str
    ) -> None:
        """Control a robot.

        Args:
            robot: In the simulation.
            hardware: Hardware interface of the controllers.
            model: As its URDF describes it.
            namespace: Of its topics.
        """
        self._robot, self._clock = robot, robot.simulation.clock
        self.system = ControlSystem
        self.hardware = hardware
        self.manager = ControllerManager(
            hardware,
            model=model,
            call=self._call,
            namespace=namespace,
            measure=self._measure,
            sync=self.sync,
        )
        self.manager.now_ns = self._clock.now_ns
        self.stopped: Bools = np.zeros(hardware.nworld, bool)
        self._released: Bools = np.zeros(hardware.nworld, bool)
        self._stop_written = self._restarts = False
        self._period_ns: int | None = None
        self._updated_ns: int | None = None
        self._written_ns: int | None = None
        self._native_run: tuple[ControlCycle, JointLaw, list[ControlLaw], int, int] | None = None
        self._handed_over = self._resting = False

    def change_hardware(self, hardware: SimulatedHardware) -> None:
        """Control through other hardware; nothing is loaded yet."""
        self._invalidate()
        for name in self.hardware.motors - hardware.motors:
            self._robot.joints[name].add_motor(0.0)
        self.hardware = self.manager.hardware = hardware
        self._stop_written = False

    # -- what is done in steps --------------------------------------------------------------

    def _call(self, work: Callable[[], R], /) -> R:
        """Call a function between two steps; it may change what is due."""
        with self._robot.simulation.lock:
            self._invalidate()
            return work()

    def _invalidate(self) -> None:
        """Return control from native code to Python."""
        if self._handed_over or self._resting:
            self._robot.simulation.loop.in_step.invalidate(self)
        self._resting = False
        if self._handed_over:
            self._handed_over = False
            self._catch_up()

    def sync(self) -> None:
        """Take over the state that native code computed so far."""
        if self._handed_over:
            with self._robot.simulation.lock:
                self._catch_up()

    # -- commands ---------------------------------------------------------------

    def _measure(self) -> int:
        """Read the joints again, for controllers that start; returns the time [ns].

        Since the last update the joints may have been placed elsewhere, and where nothing was to be
        done there was none for long: that is no period of control.
        """
        if not self.active:
            self._updated_ns = self._written_ns = None
        self.hardware.measure(self._clock.now)
        return self._clock.now_ns

    def set_period(self, seconds: float) -> None:
        """Set the period of the controllers; by default that of the physics."""
        self._invalidate()
        self._period_ns = round(seconds * NANOSECONDS)
        if self._period_ns < self._clock.step_ns:
            text = (
                f"the control period of {seconds:g} s on '{self._robot.name}' is shorter than the "
                f"physics step of {self._clock.step_ns / NANOSECONDS:g} s: controllers act once a step"
            )
            warnings.warn(ControlWarning(text), stacklevel=2)

    def press(self, worlds: Worlds | None, *, on: bool) -> None:
        """Press or release the emergency stop."""
        self._invalidate()
        rows = slice(None) if worlds is None else worlds
        before = self.stopped.copy()
        self.stopped[rows] = on
        self._released = (self._released | (before & ~self.stopped)) & ~self.stopped
        self._clear_stop_record()

    def _clear_stop_record(self) -> None:
        """Clear the hardware's record of the emergency stop."""
        self._stop_written, self._restarts = False, bool(self._released.any())

    def _stop_emergency(self) -> None:
        """Report a change of the emergency stop to the hardware."""
        if not self._stop_written:
            self.hardware.stop_emergency(self.stopped)
            self._stop_written = (
                type(self.hardware) is JointHardware
            )  # another is informed each time

    # -- steps -------------------------------------------------------------------------

    @property
    def active(self) -> bool:
        """True if there is anything to do: a controller, or a joint that has to be held."""
        return self.manager.busy or not self.hardware.idle

    def on_update(self, time: float) -> None:
        """Read, control, write."""
        self._invalidate()
        now, step, period = self._clock.now_ns, self._clock.step_ns, self._control_ns
        self._stop_emergency()
        due = self._updated_ns is None or now - self._updated_ns >= period
        if due:
            passed = period if self._updated_ns is None else now - self._updated_ns
            self._updated_ns = now
            self.hardware.read(time, passed / NANOSECONDS)
            restart = np.flatnonzero(self._released) if self._restarts else None
            self._released[:] = self._restarts = False
            self.manager.update(now, passed / NANOSECONDS, restart=restart)
        since = step if self._written_ns is None else now - self._written_ns
        self._written_ns = now
        self.hardware.write(time, since / NANOSECONDS)

    def in_step(self) -> InStepWork | None:
        """Return all of ``on_update`` in native code, and until when that is good."""
        self._invalidate()
        hardware = self.hardware
        if not isinstance(hardware, JointHardware) or self._restarts:
            return None
        laws = self.manager.laws()
        if laws is None:
            return None
        if not (laws or self.active):
            # A class of a user's own may have more to do than it reports.
            self._resting = type(hardware) is JointHardware
            return InStepWork((), math.inf, lasting=True) if self._resting else None
        cycle = hardware.in_step
        if cycle is None:
            return None
        self._stop_emergency()
        arguments = (cycle, hardware.law, laws, self._control_ns, self._clock.step_ns)
        if self._native_run != arguments:
            cycle.run(*arguments[1:])
            self._native_run = arguments
        cycle.begin(_or_never(self._updated_ns), _or_never(self._written_ns))
        self._handed_over = True
        # Without controllers nothing reports when there is nothing left to do.
        return InStepWork((cycle,), self.manager.wake_ns(), bool(laws) and self.manager.deferrable)

    @property
    def _control_ns(self) -> int:
        """The period of control [ns]."""
        return self._clock.step_ns if self._period_ns is None else self._period_ns

    def _catch_up(self) -> None:
        if self._native_run is None:
            return
        cycle, _, _, period, step = self._native_run
        before, (now, written) = self._updated_ns, cycle.times()
        self._updated_ns = None if now < 0 else now
        self._written_ns = None if written < 0 else written
        if self._updated_ns == before:
            return
        each = max(step, -(-period // step) * step)
        updates = 1 if before is None else max(1, round((now - before) / each))
        self.manager.catch_up(now, updates, each / NANOSECONDS)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset these worlds: running controllers hold the robot where it is placed."""
        self._invalidate()
        rows = slice(None) if worlds is None else worlds
        self.stopped[rows] = self._released[rows] = False
        self._clear_stop_record()
        self.hardware.reset(worlds)
        now, rewind = self._clock.now_ns, worlds is None
        if rewind:
            self._updated_ns = self._written_ns = None
        self.hardware.read(now / NANOSECONDS, 0.0)
        self.manager.now_ns = now
        self.manager.reset(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the state of hardware and controllers."""
        self.sync()
        times = [-1 if each is None else each for each in (self._updated_ns, self._written_ns)]
        return {
            "times": np.array(times, np.int64),
            "now": np.array(self.manager.now_ns),
            "stop": np.stack((self.stopped, self._released)),
            **{f"hardware/{name}": value for name, value in self.hardware.state().items()},
            **{f"controllers/{name}": value for name, value in self.manager.states().items()},
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._invalidate()
        times = [None if each < 0 else int(each) for each in state["times"]]
        self._updated_ns, self._written_ns = times
        self.stopped, self._released = (np.array(row, bool) for row in state["stop"])
        self._clear_stop_record()
        self.hardware.restore(state_below("hardware/", state))
        self.manager.now_ns = int(state["now"])
        self.manager.restore(state_below("controllers/", state))


class ControlSystem(PluginSystem[ControlLoop]):
    """Controllers of one robot, in native code as long as nothing is done to them.

    Args:
        plugins: One.
    """

    single = True

    @property
    def active(self) -> bool:
        """True where there is a controller, or a joint that has to be held."""
        return self.plugins[0].active

    def update(self, time: float) -> None:
        """Read, control, write."""
        self.plugins[0].on_update(time)

    def in_step(self) -> InStepWork | None:
        """Return the control cycle, and until when it is good."""
        return self.plugins[0].in_step()

    def sync(self) -> None:
        """Take over the state that native code computed."""
        self.plugins[0].sync()


def _or_never(time_ns: int | None) -> int:
    return -1 if time_ns is None else time_ns


def add_controllers(robot: Robot) -> ControllerManager:
    """Add controllers to a robot without any: each single-axis joint through any interface."""
    joints = [
        CommandedJoint(name, INTERFACES, JointLimits.of_joint(robot.joint_description(name)))
        for name, handle in robot.joints.items()
        if handle.axes == 1
    ]
    namespace = robot.namespace or robot.name
    setup = HardwareSetup(namespace, joints, robot.description)
    loop = ControlLoop()
    loop.begin(robot, JointHardware(robot, setup), robot.description, namespace)
    robot.simulation.plugins.append(
        make_scheduled(loop, "controllers", robot.name, robot.simulation.lock)
    )
    robot.add_manager(namespace, loop.manager)
    return loop.manager
