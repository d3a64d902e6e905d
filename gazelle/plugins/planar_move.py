"""A base that slides as it is told: what ``libgazebo_ros_planar_move.so`` does."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.plugins.odometry import OdometryOutputs, true_odometry
from gazelle.rotations import from_yaw, rotate, yaw_of
from gazelle.simulation import (
    ModelPlugin,
    Odometry,
    Robot,
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
        self._frame = parameters.get("odometryFrame", "odom")
        self._base = parameters.get("robotBaseFrame", "base_footprint")
        rate = parameters.get("odometryRate", 20.0)
        self._schedule = Schedule(rate) if rate > 0.0 else None
        odometry = absolute(namespace, parameters.get("odometryTopic", "odom"))
        self._odometry = OdometryOutputs(robot, odometry, self._measure, namespace)

    def on_update(self, time: float) -> None:  # noqa: ARG002  the watch tells
        """Move, and publish when it is time to."""
        self._give_up_old()
        turn = from_yaw(yaw_of(self._robot.quaternion))
        planar = self._command.linear * (1.0, 1.0, 0.0)
        spin = self._command.angular * (0.0, 0.0, 1.0)
        self._robot.simulation.engine.set_model_motion(self._robot.name, rotate(turn, planar), spin)
        if self._schedule is not None and self._schedule.is_due(self._clock.now_ns):
            self._schedule.done(self._clock.now_ns)
            self._odometry.publish()

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
        if self._command.revision != self._heard:
            self._heard = self._command.revision
            self._silence.restart()
        elif 0.0 <= self._timeout < self._silence.elapsed:
            self._command.clear()
            self._heard = self._command.revision
            self._silence.restart()

    def _measure(self) -> Odometry:
        return true_odometry(self._robot, self._frame, self._base)
