"""A base that slides as it is told: what ``libgazebo_ros_planar_move.so`` does."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.engines.planar.twist_commands import TwistCommands
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.plugins.command_timeout import CommandGroup, CommandTimeout
from gazelle.plugins.odometry import OdometryOutputs, TrueOdometry, measure_wanted
from gazelle.simulation import (
    BasePlugin,
    ModelPlugin,
    Odometry,
    Robot,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.clock import Schedule
from gazelle.simulation.running_state import RunningState


class PlanarMove(ModelPlugin):
    """Sets the model's velocity at every step: forward, sideways and turning.

    Its weight has no effect: the velocity upwards is held at zero, as in the original.

    Attributes:
        command: What it is told, and how long that holds.
        odometry: What is published.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self._clock = robot.simulation.clock
        namespace = namespace_of(robot, parameters)
        topic = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, topic)
        timeout = parameters.get("cmdTimeout", -1.0)
        longest = timeout if timeout >= 0.0 else math.inf
        self.command = CommandTimeout(self._clock, self._command, longest)
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_footprint")
        rate = parameters.get("odometryRate", 20.0)
        self._schedule = Schedule(rate) if rate > 0.0 else None
        odometry = absolute(namespace, parameters.get("odometryTopic", "odom"))
        measure = TrueOdometry(robot, frame, base)
        self.odometry = OdometryOutputs(robot, odometry, measure, namespace)

    def kind(self) -> Hashable | None:
        """All, where the engine moves many at once; in native code those that go on for ever."""
        simulation = self._robot.simulation
        for_ever = math.isinf(self.command.longest)
        together = simulation.tables is not None or (simulation.native is not None and for_ever)
        return ("PlanarMove", for_ever) if together else None

    @classmethod
    def together(cls, plugins: Sequence[PlanarMove]) -> System | BasePlugin:
        """The commands of many bases; they are kept in arrays of all from then on."""
        simulation = plugins[0].robot.simulation
        told = [each.command for each in plugins]
        commands = CommandGroup(simulation.clock, told, simulation.nworld)
        names = [each.robot.name for each in plugins]
        if simulation.native is None:
            return SlidingGroup(simulation, names, commands)
        law = TwistCommands(commands.linear, commands.angular)
        simulation.native.model_table(names).command(law)
        return law

    @property
    def robot(self) -> Robot:
        """What moves."""
        return self._robot

    @property
    def is_heard(self) -> bool:
        """Whether anybody listens to the odometry."""
        return self._schedule is not None and self.odometry.wanted

    @classmethod
    def measure_together(cls, plugins: Sequence[PlanarMove]) -> list[Odometry | None]:
        """The odometry of those that publish it now."""
        due = [each.odometry for each in plugins if each.is_due]
        measured = iter(measure_wanted(due))
        return [next(measured) if each.is_due else None for each in plugins]

    @property
    def is_due(self) -> bool:
        """Whether the odometry is to be published in this step."""
        schedule, now_ns = self._schedule, self._clock.now_ns
        if schedule is None:
            return False
        last_ns = now_ns - self._clock.step_ns
        if schedule.due_ns <= last_ns:  # nobody listened then, and nobody asked
            schedule.done(last_ns)
        return schedule.is_due(now_ns)

    def publish_measured(self, measured: Odometry | None = None) -> None:
        """Publish the odometry when it is time to."""
        if self._schedule is not None and self.is_due:
            self._schedule.done(self._clock.now_ns)
            self.odometry.publish(measured)

    def on_update(self, time: float) -> None:  # noqa: ARG002  the watch tells
        """Move, and publish when it is time to."""
        self.command.clear_old()
        twist = self._command.linear.copy()
        twist[:, 2] = self._command.angular[:, 2]
        self._robot.simulation.engine.set_ground_motion(self._robot.name, twist)
        self.publish_measured()

    def reset(self, worlds: Worlds | None) -> None:
        """Begin anew."""
        self.command.restart()
        if worlds is None and self._schedule is not None:
            self._schedule.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """The time of the last command."""
        return {"heard_at": np.array(self.command.since_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self.command.restart(int(state["heard_at"]))
        if self._schedule is not None:
            self._schedule.done(self._clock.now_ns)


class SlidingGroup(BasePlugin):
    """Sets the velocities of some models at every step.

    Args:
        simulation: Has them.
        models: Their names.
        commands: What they are told.
    """

    def __init__(
        self, simulation: RunningState, models: Sequence[str], commands: CommandGroup
    ) -> None:
        self._simulation, self._models, self._commands = simulation, tuple(models), commands

    def on_update(self, time: float) -> None:  # noqa: ARG002  the clock knows it exactly
        """Move."""
        engine = self._simulation.tables
        if engine is None:
            raise SimulationError("the engine moves one model at a time")
        self._commands.clear_old()
        twist = self._commands.linear.copy()
        twist[:, :, 2] = self._commands.angular[:, :, 2]
        if len(self._models) == 1:  # a single one is moved faster by itself
            self._simulation.engine.set_ground_motion(self._models[0], twist[:, 0])
        else:
            engine.set_ground_motions(self._models, twist)
