"""Hector's sonar: what ``libhector_gazebo_ros_sonar.so`` does."""

from __future__ import annotations

import numpy as np

from gazelle.description import Parameters
from gazelle.plugins.hector_errors import Interval, SensorErrors
from gazelle.plugins.hector_imu import rate_of
from gazelle.plugins.sensor_kinds import model_of
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import LidarModel
from gazelle.simulation import SensorOutput, SensorPlugin, SensorUnit, absolute, namespace_of
from gazelle.simulation.values import SonarValue


class HectorSonar(Noisy, SensorPlugin):
    """Publishes the shortest of a sensor's rays with its errors."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        model = model_of(sensor, LidarModel, parameters)
        robot, simulation = sensor.robot, sensor.robot.simulation
        self._sensor, self._clock = sensor, simulation.clock
        lidar = model.lidar
        self._least, self._most = lidar.range_min, lidar.range_max
        spans = [
            float(angles[-1] - angles[0])
            for angles in (model.angles, model.vertical_angles)
            if len(angles) > 1
        ]
        self._fov = min(spans, default=0.0)
        self._interval = Interval()
        self._error = SensorErrors(
            parameters, "", 1, simulation.seed, f"{sensor.name}::sonar", simulation.nworld
        )
        self._noises = {"errors": self._error, "interval": self._interval}
        sensor.schedule.rate = rate_of(parameters, 10.0)
        topic = parameters.get("topicName", "sonar")
        robot.outputs[topic.strip("/")] = SensorOutput(
            sensor,
            absolute(namespace_of(robot, parameters), topic),
            SonarValue,
            frame=parameters.get("frameId", "/sonar_link"),
            read=self._read,
        )
        robot.tunings[topic.strip("/")] = self._error.tuning(
            absolute(namespace_of(robot, parameters), topic)
        )

    def _read(self) -> SonarValue:
        nearest = np.minimum(self._sensor.current().min(axis=1), self._most)
        interval = self._interval.since(self._clock.now_ns)
        wrong = self._error.apply(nearest[:, None], interval)[:, 0]
        distance = np.where(nearest < self._most, wrong, nearest)
        return SonarValue(
            self._clock.now_ns,
            np.clip(distance, self._least, self._most),
            self._least,
            self._most,
            self._fov,
            ultrasound=True,
        )
