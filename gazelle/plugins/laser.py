"""A lidar's topic: what ``libgazebo_ros_laser.so`` and ``libgazebo_ros_gpu_laser.so`` do."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.plugins.sensor_kinds import model_of
from gazelle.sensors import LaserScan, LidarModel
from gazelle.simulation import SensorOutput, SensorPlugin, SensorUnit, absolute, namespace_of


class Laser(SensorPlugin):
    """Opens an output of the sensor's scans under the topic that the file names."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read topic and frame, open the port."""
        model_of(sensor, LidarModel, parameters)
        robot = sensor.robot
        # Absent means the root; there but empty means the model's name.
        unnamed = robot.name if "robotNamespace" in parameters else ""
        namespace = namespace_of(robot, parameters, unnamed)
        topic = parameters.get("topicName", "/world")
        frame = parameters.get("frameName", "/world")
        robot.outputs[topic.strip("/")] = SensorOutput(
            sensor,
            absolute(namespace, topic),
            LaserScan,
            frame=frame,
            namespace=namespace,
        )
