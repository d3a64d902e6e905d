"""One distance from a fan of rays: what ``libgazebo_ros_range.so`` does."""

from __future__ import annotations

import numpy as np

from gazelle.description import Noise, Parameters
from gazelle.plugins.sensor_kinds import model_of
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import LidarModel, NoiseModel
from gazelle.simulation import (
    FramePrefix,
    SensorOutput,
    SensorPlugin,
    SensorUnit,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import RangeValue


class RangeFinder(Noisy, SensorPlugin):
    """Publishes the shortest of a sensor's rays, as an ultrasonic or infrared sensor would."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        robot = sensor.robot
        simulation = robot.simulation
        self._sensor, self._clock = sensor, simulation.clock
        lidar = model_of(sensor, LidarModel, parameters).lidar
        self._least, self._most = lidar.range_min, lidar.range_max
        self._ultrasound = parameters.get("radiation", "ultrasound") == "ultrasound"
        self._fov = parameters.get("fov", 0.05)
        noise = Noise("gaussian", stddev=parameters.get("gaussianNoise", 0.0))
        self._noise = NoiseModel(
            noise, simulation.seed, f"{sensor.name}::range", simulation.nworld, 1
        )
        self._noises = {"noise": self._noise}
        sensor.limit_rate(parameters.get("updateRate", 0.0))
        topic = parameters.get("topicName", "/range")
        namespace = namespace_of(robot, parameters)
        robot.outputs[topic.strip("/")] = SensorOutput(
            sensor,
            absolute(namespace, topic),
            RangeValue,
            frame=parameters.get("frameName", "/world"),
            read=self._read,
            namespace=namespace,
            prefix=FramePrefix.OWN,
        )

    def _read(self) -> RangeValue:
        nearest = np.minimum(self._sensor.current().min(axis=1), self._most)
        noisy = self._noise.apply(nearest[:, None], 0.0)[:, 0]
        # The original spares what is out of reach from its noise.
        distance = np.where(nearest < self._most, noisy, nearest)
        return RangeValue(
            self._clock.now_ns,
            np.clip(distance, self._least, self._most),
            self._least,
            self._most,
            self._fov,
            self._ultrasound,
        )
