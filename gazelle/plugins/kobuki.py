"""The Kobuki base: what ``libgazebo_ros_kobuki.so`` does."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.dead_reckoning import DeadReckoning
from gazelle.plugins.kobuki_sensors import Bumpers, Cliffs
from gazelle.plugins.odometry import OdometryOutputs
from gazelle.plugins.publishing import Published
from gazelle.sensors import ImuReading
from gazelle.simulation import (
    Input,
    JointStates,
    ModelPlugin,
    Odometry,
    Output,
    Robot,
    Setting,
    Stopwatch,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import MotorPower, SixNumbers, Trigger

# Of the base's own topics, unless the parameter base_prefix has another.
_PREFIX = "mobile_base"
_VARIANCE: SixNumbers = (0.1, 0.1, 1e6, 1e6, 1e6, 0.05)


class Kobuki(ModelPlugin):
    """Drives two wheels until the last command is too old; tells of cliffs, bumps and the gyro.

    The odometry takes distances from the wheels and the heading from the gyro.
    """

    update_rate = 0.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find wheels and sensors, open the ports."""
        self._robot, self._clock = robot, robot.simulation.clock
        separation = parameters.require("wheel_separation", float)
        radius = parameters.require("wheel_diameter", float) / 2.0
        if separation <= 0.0 or radius <= 0.0:
            raise SimulationError(
                "wheel_separation and wheel_diameter must be positive", source=parameters.source
            )
        self._half, self._radius = separation / 2.0, radius
        self._names = tuple(
            parameters.require(f"{side}_wheel_joint_name", str) for side in ("left", "right")
        )
        self._wheels = [robot.joints[name] for name in self._names]
        for wheel in self._wheels:
            wheel.add_motor(parameters.require("torque", float))
        self._timeout = parameters.require("velocity_command_timeout", float)
        self._imu = robot.sensors[parameters.require("imu_name", str)]
        self._cliffs, self._bumpers = Cliffs(robot, parameters), Bumpers(robot, parameters)
        self._power = np.ones(robot.simulation.nworld, np.bool_)
        self._reckoning = DeadReckoning(separation, radius, self._angles())
        self._watch, self._silence = Stopwatch(self._clock), Stopwatch(self._clock)
        self._open_ports(robot, parameters)
        self._heard = self._command.revision

    def _open_ports(self, robot: Robot, parameters: Parameters) -> None:
        namespace = namespace_of(robot, parameters)
        nworld = robot.simulation.nworld
        self._command = robot.inputs["cmd_vel"] = TwistInput(nworld, "")
        robot.inputs["motor_power"] = Input("", MotorPower, self._switch)
        robot.inputs["reset_odometry"] = Input(
            "", Trigger, lambda _, worlds: self._reckoning.reset(worlds, self._angles())
        )
        opened: dict[str, Output[Any]] = {
            "joint_states": Output(
                absolute(namespace, "joint_states"),
                JointStates,
                self._read_wheels,
                frame="base_link",
            ),
            "imu_data": Output("", ImuReading, self._feel, frame="gyro_link"),
        }
        robot.outputs.update(opened)
        framed = parameters.get("publish_tf", False)
        topic = absolute(namespace, "odom")
        odometry = OdometryOutputs(robot, topic, self._measure, namespace, framed=framed)
        self._published: tuple[Published, ...] = (*opened.values(), odometry)
        self._cliffs.open(robot)
        self._bumpers.open(robot)
        self._namespace = namespace
        self._name_topics(_PREFIX)
        robot.settings["base_prefix"] = Setting(
            absolute(namespace, "base_prefix"), _PREFIX, self._name_topics
        )

    def _name_topics(self, prefix: str) -> None:
        """Put the base's own topics below a prefix."""
        base = absolute(self._namespace, prefix).rstrip("/")
        inputs, outputs = self._robot.inputs, self._robot.outputs
        inputs["cmd_vel"].topic = f"{base}/commands/velocity"
        inputs["motor_power"].topic = f"{base}/commands/motor_power"
        inputs["reset_odometry"].topic = f"{base}/commands/reset_odometry"
        outputs["imu_data"].topic = f"{base}/sensors/imu_data"
        for name, output in outputs.items():
            kind, _, _ = name.partition("_")
            if kind in ("cliff", "bumper"):
                output.topic = f"{base}/events/{kind}"

    def _switch(self, power: MotorPower, worlds: Worlds | None) -> None:
        self._power[slice(None) if worlds is None else worlds] = power.on

    def on_update(self, time: float) -> None:  # noqa: ARG002  the watch tells
        """Drive, count and tell."""
        interval = self._watch.lap()
        turning = self._feel().angular_velocity[:, 2]
        self._reckoning.advance(self._angles(), interval, turning * interval)
        self._drive()
        for output in self._published:
            output.publish()
        self._cliffs.tell()
        self._bumpers.tell()

    def _drive(self) -> None:
        if self._command.revision != self._heard:
            self._heard = self._command.revision
            self._silence.restart()
        elif self._silence.elapsed > self._timeout:
            self._command.clear()
            self._heard = self._command.revision
            self._silence.restart()
        forward = self._command.linear[:, 0] * self._power
        across = self._command.angular[:, 2] * self._half * self._power
        for wheel, sign in zip(self._wheels, (-1.0, 1.0), strict=True):
            wheel.drive((forward + sign * across) / self._radius)

    def _angles(self) -> Floats:
        return np.concatenate([wheel.positions()[:, :1] for wheel in self._wheels], axis=1)

    def _feel(self) -> ImuReading:
        reading: ImuReading = self._imu.model.reading(self._imu.current(), self._clock.now_ns)
        return reading

    def _measure(self) -> Odometry:
        return self._reckoning.odometry(self._clock.now_ns, "odom", "base_footprint", _VARIANCE)

    def _read_wheels(self) -> JointStates:
        speeds = [wheel.velocities()[:, :1] for wheel in self._wheels]
        angles = self._angles()
        return JointStates(
            self._clock.now_ns,
            self._names,
            angles,
            np.concatenate(speeds, axis=1),
            np.zeros_like(angles),
        )

    def reset(self, worlds: Worlds | None) -> None:
        """Power on, odometry at its origin, nothing touched."""
        self._power[slice(None) if worlds is None else worlds] = True
        self._reckoning.reset(worlds, self._angles())
        self._cliffs.reset(worlds)
        self._bumpers.reset(worlds)
        self._heard = self._command.revision
        self._silence.restart()
        if worlds is None:
            self._watch.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Odometry, power, what is touched, and the times."""
        return {
            **self._reckoning.state(),
            "power": self._power.copy(),
            "deep": self._cliffs.deep.copy(),
            "pressed": self._bumpers.pressed.copy(),
            "times": np.array([self._watch.start_ns, self._silence.start_ns]),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._reckoning.restore(state)
        self._power[:] = state["power"]
        self._cliffs.deep[:], self._bumpers.pressed[:] = state["deep"], state["pressed"]
        self._watch.start_ns, self._silence.start_ns = (int(x) for x in state["times"])
        self._heard = self._command.revision
