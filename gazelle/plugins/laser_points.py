"""Point clouds from lidars: what ``libgazebo_ros_block_laser.so`` and the Velodyne plugins do."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Noise, Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import LidarModel, NoiseModel
from gazelle.sensors.lidar import directions_of
from gazelle.simulation import SensorOutput, SensorPlugin, SensorUnit, absolute, namespace_of
from gazelle.simulation.values import ChannelPoints, LaserPoints

Floats = NDArray[np.float64]


class PointLaser(Noisy, SensorPlugin):
    """Knows where the rays of its sensor end."""

    def watch(self, sensor: SensorUnit, parameters: Parameters) -> LidarModel:
        """Take hold of the sensor.

        Raises:
            SimulationError: It has no rays.
        """
        model = sensor.model
        if not isinstance(model, LidarModel):
            raise SimulationError(
                f"'{sensor.name}' has no rays to make points of", source=parameters.source
            )
        simulation = sensor.robot.simulation
        self._sensor, self._clock = sensor, simulation.clock
        self._directions = directions_of(model.angles, model.vertical_angles)
        self._rings = np.repeat(np.arange(len(model.vertical_angles)), len(model.angles))
        rays = len(self._directions)
        self._intensities: Floats = np.zeros(rays)
        self._noise = NoiseModel(
            Noise("gaussian", stddev=parameters.get("gaussianNoise", 0.0)),
            simulation.seed,
            f"{sensor.name}::points",
            simulation.nworld,
            rays,
        )
        self._noises = {"noise": self._noise}
        return model

    def open(self, kind: type[LaserPoints], parameters: Parameters, topic: str, frame: str) -> None:
        """Offer the points."""
        robot = self._sensor.robot
        robot.outputs[topic.strip("/")] = SensorOutput(
            self._sensor,
            absolute(namespace_of(robot, parameters), topic),
            kind,
            frame=frame,
            read=self.read,
        )

    def read(self) -> LaserPoints:
        """The points now."""
        raise NotImplementedError


class BlockLaser(PointLaser):
    """Publishes the ends of all rays as a ``PointCloud``; what sees nothing ends at its reach."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        model = self.watch(sensor, parameters)
        self._least, self._most = model.lidar.range_min, model.lidar.range_max
        # Nothing shines here: all returns are as faint as the file lets them be.
        self._intensities[:] = parameters.get("hokuyoMinIntensity", 101.0)
        rate = parameters.get("updateRate", 0.0)
        if rate > 0.0:
            sensor.schedule.rate = rate
        topic = parameters.get("topicName", "/world")
        self.open(ChannelPoints, parameters, topic, parameters.get("frameName", "/world"))

    def read(self) -> ChannelPoints:
        """The points now."""
        ranges = np.clip(self._sensor.current(), self._least, self._most)
        noisy = self._noise.apply(ranges, 0.0)
        # The original spares what is out of reach from its noise.
        distance = np.where(ranges < self._most, noisy, ranges)
        return ChannelPoints(
            self._clock.now_ns,
            distance[:, :, None] * self._directions,
            self._intensities,
            self._rings,
            np.ones(distance.shape, np.bool_),
        )


class Velodyne(PointLaser):
    """Publishes the ends of rays that meet something as a ``PointCloud2`` with rings."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        self.watch(sensor, parameters)
        self._least = parameters.get("min_range", 0.0)
        self._most = parameters.get("max_range", math.inf)
        # Nothing shines here, so all returns are too faint for any threshold above zero.
        self._faint = parameters.get("min_intensity", -math.inf) > 0.0
        topic = parameters.get("topicName", "/points")
        self.open(LaserPoints, parameters, topic, parameters.get("frameName", "/world"))

    def read(self) -> LaserPoints:
        """The points now."""
        ranges = self._sensor.current()
        kept = np.isfinite(ranges) & (ranges >= self._least) & (ranges <= self._most)
        distance = self._noise.apply(np.where(kept, ranges, 0.0), 0.0)
        return LaserPoints(
            self._clock.now_ns,
            distance[:, :, None] * self._directions,
            self._intensities,
            self._rings,
            kept & (not self._faint),
        )
