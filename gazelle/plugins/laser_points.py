"""Point clouds from lidars: what ``libgazebo_ros_block_laser.so`` and the Velodyne plugins do."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Noise, Parameters
from gazelle.plugins.sensor_kinds import model_of
from gazelle.plugins.stateful import Noisy
from gazelle.sensors import LidarModel, NoiseModel
from gazelle.sensors.lidar import directions_of
from gazelle.simulation import (
    FramePrefix,
    SensorOutput,
    SensorPlugin,
    SensorUnit,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import ChannelPoints, LaserPoints


class PointLaser(Noisy, SensorPlugin):
    """Knows where the rays of its sensor end.

    Attributes:
        prefix: Prefix of the frame.
    """

    prefix = FramePrefix.NEAREST

    def watch(self, sensor: SensorUnit, parameters: Parameters, *, channels: int = 1) -> LidarModel:
        """Use a sensor.

        Args:
            sensor: With rays.
            parameters: With ``gaussianNoise``.
            channels: Numbers of noise a ray.

        Raises:
            SimulationError: It has no rays.
        """
        model = model_of(sensor, LidarModel, parameters)
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
            rays * channels,
        )
        self._noises = {"noise": self._noise}
        return model

    def open(self, kind: type[LaserPoints], parameters: Parameters, topic: str, frame: str) -> None:
        """Open the output of points."""
        robot = self._sensor.robot
        namespace = namespace_of(robot, parameters)
        robot.outputs[topic.strip("/")] = SensorOutput(
            self._sensor,
            absolute(namespace, topic),
            kind,
            frame=frame,
            read=self.read,
            namespace=namespace,
            prefix=self.prefix,
        )

    def read(self) -> LaserPoints:
        """Return the points now."""
        raise NotImplementedError


class BlockLaser(PointLaser):
    """Publishes the ends of all rays as a ``PointCloud``; what sees nothing ends at its reach.

    Noise moves the ends along each axis, but not those out of reach. ``updateRate`` and
    ``hokuyoMinIntensity`` have no effect. All that is so in the original.
    """

    prefix = FramePrefix.OWN

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        model = self.watch(sensor, parameters, channels=3)
        self._least, self._most = model.lidar.range_min, model.lidar.range_max
        topic = parameters.get("topicName", "/world")
        self.open(ChannelPoints, parameters, topic, parameters.get("frameName", "/world"))

    def read(self) -> ChannelPoints:
        """Return the points now."""
        ranges = np.clip(self._sensor.current(), self._least, self._most)
        points = ranges[:, :, None] * self._directions
        noisy = self._noise.apply(points.reshape(len(points), -1), 0.0).reshape(points.shape)
        return ChannelPoints(
            self._clock.now_ns,
            np.where((ranges < self._most)[:, :, None], noisy, points),
            self._intensities,
            self._rings,
            np.ones(ranges.shape, np.bool_),
        )


class Velodyne(PointLaser):
    """Publishes the ends of rays that meet something as a ``PointCloud2`` with rings."""

    # A namespace goes before the frame even without a tf_prefix.
    prefix = FramePrefix.NAMESPACE

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
        """Return the points now."""
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
