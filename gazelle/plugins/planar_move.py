"""A base that slides as it is told: what ``libgazebo_ros_planar_move.so`` does."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines.planar.twist_commands import TwistCommands
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.plugins.odometry import OdometryOutputs, TrueOdometry, measure_wanted
from gazelle.simulation import (
    BasePlugin,
    ModelPlugin,
    Odometry,
    Robot,
    Simulation,
    Stopwatch,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.clock import Schedule


class PlanarMove(ModelPlugin):
    """Sets the model's velocity at every step: forward, sideways and turning.

    Its weight has no effect: the velocity upwards is held at zero, as in the original.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self._clock = robot.simulation.clock
        namespace = namespace_of(robot, parameters)
        topic = absolute(namespace, parameters.get("commandTopic", "cmd_vel"))
        self._command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, topic)
        self._timeout = parameters.get("cmdTimeout", -1.0)
        self._heard, self._silence = self._command.revision, Stopwatch(self._clock)
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_footprint")
        rate = parameters.get("odometryRate", 20.0)
        self._schedule = Schedule(rate) if rate > 0.0 else None
        odometry = absolute(namespace, parameters.get("odometryTopic", "odom"))
        measure = TrueOdometry(robot, frame, base)
        self.odometry = OdometryOutputs(robot, odometry, measure, namespace)

    def kind(self) -> Hashable | None:
        """All that never give up an old command, where the engine moves many at once."""
        simulation = self._robot.simulation
        if self._timeout >= 0.0 or (simulation.native is None and simulation.tables is None):
            return None
        return "PlanarMove"

    @classmethod
    def together(cls, plugins: Sequence[PlanarMove]) -> System | BasePlugin:
        """The commands of many bases; they are kept in arrays of all from then on."""
        simulation = plugins[0].robot.simulation
        linear, angular = np.zeros((2, simulation.nworld, len(plugins), 3))
        for part, each in enumerate(plugins):
            each.keep_in(linear[:, part], angular[:, part])
        names = [each.robot.name for each in plugins]
        if simulation.native is None:
            return SlidingGroup(simulation, names, linear, angular)
        law = TwistCommands(linear, angular)
        simulation.native.model_table(names).command(law)
        return law

    @property
    def robot(self) -> Robot:
        """What moves."""
        return self._robot

    def keep_in(self, linear: Floats, angular: Floats) -> None:
        """Keep commands in other arrays, shape (nworld, 3) each."""
        self._command.keep_in(linear, angular)

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
        self._give_up_old()
        twist = self._command.linear.copy()
        twist[:, 2] = self._command.angular[:, 2]
        self._robot.simulation.engine.set_ground_motion(self._robot.name, twist)
        self.publish_measured()

    def reset(self, worlds: Worlds | None) -> None:
        """Begin anew."""
        self._heard = self._command.revision
        self._silence.restart()
        if worlds is None and self._schedule is not None:
            self._schedule.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """The time of the last command."""
        return {"heard_at": np.array(self._silence.start_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._silence.start_ns = int(state["heard_at"])
        self._heard = self._command.revision
        if self._schedule is not None:
            self._schedule.done(self._clock.now_ns)

    def _give_up_old(self) -> None:
        """Stand still when no command came for too long."""
        if self._timeout < 0.0:
            return
        if self._command.revision != self._heard:
            self._heard = self._command.revision
            self._silence.restart()
        elif self._silence.elapsed > self._timeout:
            self._command.clear()
            self._heard = self._command.revision
            self._silence.restart()


class SlidingGroup(BasePlugin):
    """Sets the velocities of some models at every step.

    Args:
        simulation: Has them.
        models: Their names.
        linear: What they are told [m/s], shape (nworld, n, 3).
        angular: Likewise [rad/s].
    """

    def __init__(
        self, simulation: Simulation, models: Sequence[str], linear: Floats, angular: Floats
    ) -> None:
        self._simulation, self._models = simulation, tuple(models)
        self._linear, self._angular = linear, angular

    def on_update(self, time: float) -> None:  # noqa: ARG002  the last command holds
        """Move."""
        engine = self._simulation.tables
        if engine is None:
            raise SimulationError("the engine moves one model at a time")
        twist = self._linear.copy()
        twist[:, :, 2] = self._angular[:, :, 2]
        engine.set_ground_motions(self._models, twist)
