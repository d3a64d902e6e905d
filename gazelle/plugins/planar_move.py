"""A base that slides by commands: what ``libgazebo_ros_planar_move.so`` does."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.plugins.command_timeout import CommandGroup, CommandTimeout
from gazelle.plugins.odometry import OdometryOutputs, OdometrySystem, TrueOdometry
from gazelle.simulation import (
    ModelPlugin,
    Odometry,
    Robot,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.clock import Schedule


class PlanarMove(ModelPlugin):
    """Sets the model's velocity at every step: forward, sideways and turning.

    Its weight has no effect: the velocity upwards is held at zero, as in the original.

    Attributes:
        command: Its command, and how long that holds.
        odometry: Odometry output.
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
        self.system = SlidingSystem if math.isinf(longest) else CommandTimeoutSystem
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_footprint")
        rate = parameters.get("odometryRate", 20.0)
        self._schedule = Schedule(rate) if rate > 0.0 else None
        odometry = absolute(namespace, parameters.get("odometryTopic", "odom"))
        measure = TrueOdometry(robot, frame, base)
        self.odometry = OdometryOutputs(robot, odometry, measure, namespace)
        if self._schedule is not None:
            self.published = (self.odometry,)

    @property
    def robot(self) -> Robot:
        """Robot that is moved."""
        return self._robot

    @property
    def is_due(self) -> bool:
        """True if the odometry is to be published in this step."""
        schedule, now_ns = self._schedule, self._clock.now_ns
        if schedule is None:
            return False
        last_ns = now_ns - self._clock.step_ns
        if schedule.due_ns <= last_ns:  # it had no subscribers and no reader
            schedule.done(last_ns)
        return schedule.is_due(now_ns)

    def publish(self, measured: Odometry | None) -> None:
        """Publish the odometry, as it was measured, when it is time to."""
        if self._schedule is not None and self.is_due:
            self._schedule.done(self._clock.now_ns)
            self.odometry.publish(measured)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the odometry and commands."""
        self.command.restart()
        if worlds is None and self._schedule is not None:
            self._schedule.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the time of the last command."""
        return {"received_at": np.array(self.command.since_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.command.restart(int(state["received_at"]))
        if self._schedule is not None:
            self._schedule.done(self._clock.now_ns)


class SlidingSystem(OdometrySystem[PlanarMove]):
    """Bases that slide by commands.

    Args:
        plugins: The bases.
    """

    def __init__(self, plugins: Sequence[PlanarMove]) -> None:
        super().__init__(plugins)
        self._simulation = plugins[0].robot.simulation
        self._models = tuple(each.robot.name for each in plugins)
        commands = [each.command for each in plugins]
        self.commands = CommandGroup(self._simulation.clock, commands, self._simulation.nworld)
        models = self._simulation.engine.models[self._models]
        self.kernel = models.twist(self.commands.linear, self.commands.angular)

    def update(self, time: float) -> None:  # noqa: ARG002  commands hold for ever
        """Move."""
        twist = self.commands.linear.copy()
        twist[:, :, 2] = self.commands.angular[:, :, 2]
        self._simulation.engine.models[self._models].set_ground_motion(twist)

    def measure(self, plugins: Sequence[PlanarMove]) -> list[Odometry | None]:
        """Return the odometry of those that publish it now."""
        due = [each for each in plugins if each.is_due]
        measured = iter(super().measure(due))
        return [next(measured) if each.is_due else None for each in plugins]

    def publish(self, plugin: PlanarMove, measured: Odometry | None) -> None:
        """Publish the odometry of one base."""
        plugin.publish(measured)


class CommandTimeoutSystem(SlidingSystem):
    """Bases that stand without a command for too long."""

    def __init__(self, plugins: Sequence[PlanarMove]) -> None:
        super().__init__(plugins)
        self._law, self.kernel = self.kernel, None

    def update(self, time: float) -> None:
        """Stop robots with an expired command, and move."""
        self.commands.clear_old()
        if self._law is None:
            super().update(time)
        else:
            self._law.update_from_python(0, self._simulation.nworld * self._law.rows, 0)
