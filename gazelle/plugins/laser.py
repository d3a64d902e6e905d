"""A lidar's topic: what ``libgazebo_ros_laser.so`` and ``libgazebo_ros_gpu_laser.so`` do."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.simulation import Output, SensorPlugin, SensorUnit


class Laser(SensorPlugin):
    """Opens an output of the sensor's scans under the topic that the file names."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read topic and frame, open the port."""
        self._sensor = sensor
        self.frame = parameters.get("frameName", "/world")
        topic = parameters.get("topicName", "/world")
        sensor.robot.outputs[topic.strip("/") or "scan"] = Output(
            topic, lambda: sensor.reading(sensor.latest())
        )
