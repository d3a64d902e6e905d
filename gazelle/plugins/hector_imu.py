"""Hector's IMU: what ``libhector_gazebo_ros_imu.so`` does."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Imu, Parameters, Pose
from gazelle.plugins.hector_errors import Interval, SensorErrors
from gazelle.plugins.publishing import Publishing
from gazelle.plugins.stateful import Noisy
from gazelle.rotations import from_yaw, multiply, rotate
from gazelle.sensors import ImuModel, ImuReading
from gazelle.simulation import Output, Robot, Service, absolute, namespace_of
from gazelle.simulation.values import Bias, UnsureImu


class HectorImu(Noisy, Publishing):
    """Publishes orientation, turning rate and acceleration, gravity included, with their errors."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find the body, open topics and services."""
        simulation = robot.simulation
        self._simulation = simulation
        body = parameters.get("bodyName", next(iter(robot.links)))
        link, frame = robot.frame(body)
        offset = parameters.numbers("xyzOffset", (0.0, 0.0, 0.0))
        turn = parameters.numbers("rpyOffset", (0.0, 0.0, 0.0))
        pose = frame * Pose(*offset, *turn)
        name = f"{robot.name}::{body}::hector_imu"
        self._model = ImuModel(Imu(), simulation.engine, link.name, pose, simulation.seed, name)
        self._accel, self._rate, self._yaw = (
            SensorErrors(
                parameters, prefix, axes, simulation.seed, f"{name}::{prefix}", simulation.nworld
            )
            for prefix, axes in (("accel", 3), ("rate", 3), ("yaw", 1))
        )
        if parameters.get("gaussianNoise", 0.0) != 0.0:
            self._accel.spread[:] = parameters.get("gaussianNoise", 0.0)
            self._rate.spread[:] = parameters.get("gaussianNoise", 0.0)
        self._interval = Interval()
        self._noises = {
            "accel": self._accel,
            "rate": self._rate,
            "yaw": self._yaw,
            "interval": self._interval,
        }
        self.update_rate = rate_of(parameters, 0.0)
        self._open(robot, parameters, parameters.get("frameId", body))

    def _open(self, robot: Robot, parameters: Parameters, frame: str) -> None:
        namespace = namespace_of(robot, parameters)
        topic = parameters.get("topicName", "imu")
        bias = parameters.get("biasTopicName", f"{topic}/bias")
        for name, kind, produce in (
            (topic, UnsureImu, self._measure),
            (bias, ImuReading, self._biases),
        ):
            output = robot.outputs[name.strip("/")] = Output(
                absolute(namespace, name), kind, produce, frame=frame, queue_size=10
            )
            self.published.append(output)
        calibrate = parameters.get("serviceName", f"{topic}/calibrate")
        robot.services[calibrate.strip("/")] = Service(
            absolute(namespace, calibrate), None, None, self._calibrate
        )
        for name, errors in (("accel", self._accel), ("rate", self._rate)):
            service = f"{topic}/set_{name}_bias"
            robot.services[service.strip("/")] = Service(
                absolute(namespace, service), Bias, None, _setter(errors)
            )
        for name, errors in (("accel", self._accel), ("rate", self._rate), ("yaw", self._yaw)):
            tuned = f"{topic}/{name}"
            robot.tunings[tuned.strip("/")] = errors.tuning(absolute(namespace, tuned))

    def _calibrate(self, _request: None, worlds: Worlds | None) -> None:
        self._rate.set_drift(0.0, worlds)

    def _measure(self) -> UnsureImu:
        now = self._simulation.clock
        true = self._model.reading(self._model.measure(), now.now_ns)
        interval = self._interval.since(now.now_ns)
        rates = self._rate.apply(true.angular_velocity, interval)
        accelerations = self._accel.apply(true.linear_acceleration, interval)
        self._yaw.apply(np.zeros((self._simulation.nworld, 1)), interval)
        orientation = multiply(self._misled(true.orientation), true.orientation)
        reading = ImuReading(now.now_ns, orientation, rates, accelerations)
        # Roll and pitch come from the accelerometer, heading from its own errors.
        level = (self._accel.spread[:2] / self._gravity) ** 2 if self._gravity > 0.0 else (-1, -1)
        return UnsureImu(
            reading,
            np.array([*level, self._yaw.spread[0] ** 2]),
            self._rate.spread**2,
            self._accel.spread**2,
        )

    def _misled(self, orientation: Floats) -> Floats:
        """Return the rotation by which the biases tilt up and ahead."""
        heading = from_yaw(self._yaw.bias[:, 0])
        if self._gravity <= 0.0:
            return heading
        pull = rotate(orientation, self._accel.bias) / (2.0 * self._gravity)
        tilt = np.stack((pull[:, 1], -pull[:, 0], np.zeros(len(pull)), np.ones(len(pull))), axis=1)
        return multiply(heading, tilt / np.linalg.norm(tilt, axis=1, keepdims=True))

    @property
    def _gravity(self) -> float:
        """Magnitude of gravity [m/s²]."""
        return float(np.linalg.norm(self._simulation.physics.gravity))

    def _biases(self) -> ImuReading:
        now_ns = self._simulation.clock.now_ns
        true = self._model.reading(self._model.measure(), now_ns).orientation
        return ImuReading(now_ns, self._misled(true), self._rate.bias, self._accel.bias)


def rate_of(parameters: Parameters, default: float) -> float:
    """Return the update rate [Hz] of ``updateRate`` or ``updatePeriod``."""
    period = parameters.get("updatePeriod", 0.0)
    if "updateRate" not in parameters and period > 0.0:
        return 1.0 / period
    return parameters.get("updateRate", default)


def _setter(errors: SensorErrors) -> Callable[[Bias, Worlds | None], None]:
    def answer(bias: Bias, worlds: Worlds | None) -> None:
        errors.set_drift(bias.values, worlds)

    return answer
