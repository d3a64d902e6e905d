"""An IMU sensor's topic: what ``libgazebo_ros_imu_sensor.so`` does."""

from __future__ import annotations

import numpy as np

from gazelle.description import Noise, Parameters, Pose
from gazelle.plugins.publishing import PublishingPlugin
from gazelle.plugins.sensor_kinds import model_of
from gazelle.plugins.stateful import Noisy
from gazelle.rotations import conjugate, multiply
from gazelle.sensors import ImuModel, ImuReading, NoiseModel
from gazelle.simulation import Output, SensorPlugin, SensorUnit, absolute, namespace_of


class ImuSensor(Noisy, PublishingPlugin, SensorPlugin):
    """Publishes an IMU sensor's readings at a rate of its own, gravity included."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        model_of(sensor, ImuModel, parameters)
        robot = sensor.robot
        simulation = robot.simulation
        self._sensor, self._clock = sensor, simulation.clock
        rate, own = parameters.get("updateRateHZ", 1.0), sensor.description.update_rate
        # It publishes what the sensor measures, so no more often than that does.
        self.update_rate = own if rate <= 0.0 or 0.0 < own < rate else rate
        deviation = parameters.get("gaussianNoise", 0.0)
        noise = Noise("gaussian", stddev=deviation)
        self._noise = NoiseModel(
            noise, simulation.seed, f"{sensor.name}::imu_sensor", simulation.nworld, 10
        )
        self._noises, self._variance = {"noise": self._noise}, deviation * deviation
        turn = parameters.numbers("rpyOffset", (0.0, 0.0, 0.0))
        self._turn = np.asarray(Pose(0.0, 0.0, 0.0, *turn).quaternion)
        self._from_start = parameters.get("initialOrientationAsReference", False)
        self._start = self._orientation()
        topic = parameters.get("topicName", "imu_data")
        # Absent means the model's name; there but empty means the root.
        unnamed = "" if "robotNamespace" in parameters else robot.name
        output = robot.outputs[topic.strip("/")] = Output(
            absolute(namespace_of(robot, parameters, unnamed), topic),
            ImuReading,
            self._measure,
            frame=parameters.get("frameName", sensor.description.name),
        )
        self.published.append(output)

    def _orientation(self) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
        values = self._sensor.measure()
        reading: ImuReading = self._sensor.model.reading(values, self._clock.now_ns)
        return reading.orientation

    def _measure(self) -> ImuReading:
        values = self._noise.apply(self._sensor.measure(), 0.0)
        reading: ImuReading = self._sensor.model.reading(values, self._clock.now_ns)
        orientation = reading.orientation
        if self._from_start:
            orientation = multiply(conjugate(self._start), orientation)
        # The original turns what is measured, not the sensor.
        orientation = multiply(np.broadcast_to(self._turn, orientation.shape), orientation)
        return ImuReading(
            reading.stamp,
            orientation / np.linalg.norm(orientation, axis=1, keepdims=True),
            reading.angular_velocity,
            reading.linear_acceleration,
            self._variance,
        )
