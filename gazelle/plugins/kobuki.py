"""The Kobuki base: what ``libgazebo_ros_kobuki.so`` does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.command_timeout import CommandGroup, CommandTimeout
from gazelle.plugins.dead_reckoning import DeadReckoning, ReckoningGroup, RolledOdometry
from gazelle.plugins.gyros import Gyros
from gazelle.plugins.kobuki_sensors import Bumpers, Cliffs, sensor_of
from gazelle.plugins.odometry import OdometryOutputs, OdometrySystem
from gazelle.sensors import ImuModel, ImuReading
from gazelle.simulation import (
    Input,
    JointArray,
    JointStates,
    ModelPlugin,
    Odometry,
    Output,
    Robot,
    Setting,
    TwistInput,
    absolute,
    namespace_of,
)
from gazelle.simulation.clock import Schedule
from gazelle.simulation.values import KobukiCore, MotorPower, SixNumbers, Trigger

_CORE_HZ = 50.0
# Of the base's own topics, unless the parameter base_prefix has another.
_PREFIX = "mobile_base"
_VARIANCE: SixNumbers = (0.1, 0.1, 1e6, 1e6, 1e6, 0.05)


class Kobuki(ModelPlugin):
    """Drives two wheels until the last command is too old; publishes cliffs, bumps and the gyro.

    The odometry takes distances from the wheels and the heading from the gyro.

    Attributes:
        command: Its command, and how long that holds.
        half: Half the distance between the wheels [m].
        radius: Of the wheels [m].
        wheels: Left and right.
        imu: Its gyro.
        power: In which worlds its motors turn, shape (nworld,).
        gyro: Measurement of the gyro at the last update, shape (nworld, 10).
        reckoning: Of how far the wheels have rolled.
        odometry: Odometry output.
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
        self.system = KobukiSystem
        self.half, self.radius = separation / 2.0, radius
        self._names = tuple(
            parameters.require(f"{side}_wheel_joint_name", str) for side in ("left", "right")
        )
        self.wheels = [robot.joints[name] for name in self._names]
        for wheel in self.wheels:
            wheel.add_motor(parameters.require("torque", float))
        self.imu = sensor_of(robot, parameters, "imu_name", ImuModel)
        self._cliffs, self._bumpers = Cliffs(robot, parameters), Bumpers(robot, parameters)
        nworld = robot.simulation.nworld
        self.power, self.gyro = np.ones(nworld, np.bool_), np.zeros((nworld, 10))
        self.reckoning = DeadReckoning(self._clock, separation, radius, self.wheels)
        command = robot.inputs["cmd_vel"] = TwistInput(nworld, "")
        longest = parameters.require("velocity_command_timeout", float)
        self.command = CommandTimeout(self._clock, command, longest)
        self._core_times = Schedule(_CORE_HZ)
        self._open_ports(robot, parameters)

    def _open_ports(self, robot: Robot, parameters: Parameters) -> None:
        namespace = namespace_of(robot, parameters)
        robot.inputs["motor_power"] = Input("", MotorPower, self._switch)
        robot.inputs["reset_odometry"] = Input(
            "", Trigger, lambda _, worlds: self.reckoning.reset(worlds)
        )
        states = absolute(namespace, "joint_states")
        self._states = Output(states, JointStates, self._read_wheels, frame="base_link")
        self._imu_data = Output("", ImuReading, self._read_gyro, frame="gyro_link")
        self._core = Output("", KobukiCore, self._read_core, queue_size=100)
        robot.outputs.update(joint_states=self._states, imu_data=self._imu_data, core=self._core)
        framed = parameters.get("publish_tf", False)
        topic = absolute(namespace, "odom")
        measure = RolledOdometry(self.reckoning, "odom", "base_footprint", _VARIANCE)
        self.odometry = OdometryOutputs(robot, topic, measure, namespace, framed=framed)
        self._cliffs.open(robot)
        self._bumpers.open(robot)
        events = self._cliffs, self._bumpers
        self.published = self._states, self._imu_data, self.odometry, self._core, *events
        self._namespace = namespace
        self._name_topics(_PREFIX)
        robot.settings["base_prefix"] = Setting(
            absolute(namespace, "base_prefix"), _PREFIX, self._name_topics
        )

    def _name_topics(self, prefix: str) -> None:
        """Set the prefix of the base's own topics."""
        base = absolute(self._namespace, prefix).rstrip("/")
        inputs, outputs = self._robot.inputs, self._robot.outputs
        inputs["cmd_vel"].topic = f"{base}/commands/velocity"
        inputs["motor_power"].topic = f"{base}/commands/motor_power"
        inputs["reset_odometry"].topic = f"{base}/commands/reset_odometry"
        outputs["imu_data"].topic = f"{base}/sensors/imu_data"
        outputs["core"].topic = f"{base}/sensors/core"
        for name, output in outputs.items():
            kind, _, _ = name.partition("_")
            if kind in ("cliff", "bumper"):
                output.topic = f"{base}/events/{kind}"

    def _switch(self, power: MotorPower, worlds: Worlds | None) -> None:
        self.power[slice(None) if worlds is None else worlds] = power.on

    def join(self, power: Bools, gyro: Floats) -> None:
        """Store the motors' power and the gyro's measurement in other arrays."""
        power[:], gyro[:] = self.power, self.gyro
        self.power, self.gyro = power, gyro

    def publish(self, measured: Odometry | None) -> None:
        """Publish, with the odometry as it was measured."""
        self._states.publish()
        if self._imu_data.has_subscribers:
            self._imu_data.publish_computed(self._reading(self.gyro.copy()))
        self.odometry.publish(measured)
        times, now_ns = self._core_times, self._clock.now_ns
        core_due = self._core.has_subscribers and times.is_due(now_ns)
        for events in (self._cliffs, self._bumpers):
            if core_due or events.has_subscribers:
                events.publish()
        if core_due:
            times.done(now_ns)
            self._core.publish()

    def _read_gyro(self) -> ImuReading:
        return self._reading(self.imu.current())

    def _reading(self, values: Floats) -> ImuReading:
        reading: ImuReading = self.imu.model.reading(values, self._clock.now_ns)
        return reading

    def _read_core(self) -> KobukiCore:
        pressed, deep = self._bumpers.pressed.copy(), self._cliffs.deep.copy()
        return KobukiCore(
            self._clock.now_ns, pressed, deep, self._cliffs.readings, self._wheel_angles()
        )

    def _wheel_angles(self) -> Floats:
        return np.concatenate([wheel.positions()[:, :1] for wheel in self.wheels], axis=1)

    def _read_wheels(self) -> JointStates:
        angles = self._wheel_angles()
        speeds = np.concatenate([wheel.velocities()[:, :1] for wheel in self.wheels], axis=1)
        return JointStates(self._clock.now_ns, self._names, angles, speeds, np.zeros_like(angles))

    def reset(self, worlds: Worlds | None) -> None:
        """Reset power to on, the odometry to its origin, and contacts to none."""
        self.power[slice(None) if worlds is None else worlds] = True
        self.reckoning.reset(worlds)
        self._cliffs.reset(worlds)
        self._bumpers.reset(worlds)
        self.command.restart()
        if worlds is None:
            self.reckoning.restart()
            self._core_times.restart()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return odometry, power, contacts and times."""
        return {
            **self.reckoning.state(),
            "power": self.power.copy(),
            "deep": self._cliffs.deep.copy(),
            "pressed": self._bumpers.pressed.copy(),
            "times": np.array([self.reckoning.last_ns, self.command.since_ns]),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self.reckoning.restore(state)
        self.power[:] = state["power"]
        self._cliffs.deep[:], self._bumpers.pressed[:] = state["deep"], state["pressed"]
        self.reckoning.last_ns = int(state["times"][0])
        self.command.restart(int(state["times"][1]))
        self._core_times.done(self._clock.now_ns)


class KobukiSystem(OdometrySystem[Kobuki]):
    """Kobukis with shared tables of motors, wheel counts and gyros.

    Args:
        plugins: The bases.
    """

    def __init__(self, plugins: Sequence[Kobuki]) -> None:
        super().__init__(plugins)
        clock, nworld = plugins[0].reckoning.clock, len(plugins[0].power)
        self._commands = CommandGroup(clock, [each.command for each in plugins], nworld)
        self._rolled = ReckoningGroup([each.reckoning for each in plugins])
        self._gyros = Gyros([each.imu for each in plugins], nworld)
        self._power = np.zeros((nworld, len(plugins)), np.bool_)
        for part, each in enumerate(plugins):
            each.join(self._power[:, part], self._gyros.values[:, part])
        self._half = np.array([each.half for each in plugins])
        self._radius = np.array([each.radius for each in plugins])
        self._wheels = JointArray([wheel for each in plugins for wheel in each.wheels])

    def update(self, time: float) -> None:  # noqa: ARG002  the clock knows it exactly
        """Update contacts, counters and drive."""
        self._gyros.measure()
        self._rolled.advance(self._gyros.values[..., 6])
        self._commands.clear_old()
        forward = self._commands.linear[..., 0] * self._power
        across = self._commands.angular[..., 2] * self._half * self._power
        speeds = np.empty((*forward.shape, 2))
        speeds[..., 0] = (forward - across) / self._radius
        speeds[..., 1] = (forward + across) / self._radius
        self._wheels.drive(speeds.reshape(len(speeds), -1))

    def publish(self, plugin: Kobuki, measured: Odometry | None) -> None:
        """Publish all outputs of one base."""
        plugin.publish(measured)
