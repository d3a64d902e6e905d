"""Rays under any message: what ROS 2's ``libgazebo_ros_ray_sensor.so`` does."""

from __future__ import annotations

import numpy as np

from gazelle.description import Parameters
from gazelle.errors import SimulationError, did_you_mean
from gazelle.plugins.laser_points import PointLaser
from gazelle.sensors import LaserScan
from gazelle.simulation import SensorOutput, SensorUnit, absolute, namespace_of
from gazelle.simulation.values import ChannelPoints, LaserPoints, RangeValue

_KINDS = {
    "sensor_msgs/LaserScan": LaserScan,
    "sensor_msgs/PointCloud": ChannelPoints,
    "sensor_msgs/PointCloud2": LaserPoints,
    "sensor_msgs/Range": RangeValue,
}


class RaySensor(PointLaser):
    """Publishes scans, points or the shortest ray, as ``output_type`` says, on ``~/out``."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        model = self.watch(sensor, parameters)
        self._least, self._most = model.lidar.range_min, model.lidar.range_max
        name = parameters.get("output_type", "sensor_msgs/PointCloud2")
        if name not in _KINDS:
            raise SimulationError(
                f"output_type '{name}' is not known",
                source=parameters.source,
                hint=did_you_mean(name, _KINDS),
            )
        self._ultrasound = parameters.get("radiation_type", "ultrasound") == "ultrasound"
        kind, robot = _KINDS[name], sensor.robot
        self._fov = float(np.ptp(model.angles))
        ros = parameters.find("ros") or parameters
        topic = _remapped(ros) or parameters.get("topicName", f"{sensor.description.name}/out")
        namespace = ros.get("namespace", "") or namespace_of(robot, parameters)
        reads = {ChannelPoints: self._channels, LaserPoints: self.read, RangeValue: self._shortest}
        robot.outputs[topic.strip("/")] = SensorOutput(
            sensor,
            absolute(namespace, topic),
            kind,
            frame=parameters.get("frame_name", sensor.name.split("::")[-2]),
            read=reads.get(kind),
        )

    def read(self) -> LaserPoints:
        """Return the points now."""
        ranges = self._sensor.current()
        kept = np.isfinite(ranges)
        points = np.where(kept, ranges, 0.0)[:, :, None] * self._directions
        return LaserPoints(self._clock.now_ns, points, self._intensities, self._rings, kept)

    def _channels(self) -> ChannelPoints:
        value = self.read()
        return ChannelPoints(value.stamp, value.points, value.intensities, value.rings, value.kept)

    def _shortest(self) -> RangeValue:
        nearest = np.clip(self._sensor.current().min(axis=1), self._least, self._most)
        return RangeValue(
            self._clock.now_ns, nearest, self._least, self._most, self._fov, self._ultrasound
        )


def _remapped(ros: Parameters) -> str:
    """Return the new name of ``~/out``."""
    for remapping in (*ros.find_all("remapping"), *ros.find_all("argument")):
        old, found, new = remapping.text.partition(":=")
        if found and old.strip() in ("~/out", "~out", "out"):
            return new.strip()
    return ""
