"""Contact sensor: ``libgazebo_ros_bumper.so``."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.plugins.sensor_kinds import model_of
from gazelle.sensors import ContactModel, ContactReading
from gazelle.simulation import (
    FramePrefix,
    SensorOutput,
    SensorPlugin,
    SensorUnit,
    absolute,
    namespace_of,
)
from gazelle.simulation.values import Touches


class Bumper(SensorPlugin):
    """Publishes the contacts of a sensor's collisions at its rate, also when there are none."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read the tags, open the port."""
        model_of(sensor, ContactModel, parameters)
        robot = sensor.robot
        topic = parameters.get("bumperTopicName", "bumper_states")
        namespace = namespace_of(robot, parameters)

        def read() -> Touches:
            stamp = robot.simulation.clock.now_ns
            readings: list[ContactReading] = [
                sensor.model.reading(values, stamp) for values in sensor.current()
            ]
            return Touches(stamp, tuple(each.contacts for each in readings))

        robot.outputs[topic.strip("/")] = SensorOutput(
            sensor,
            absolute(namespace, topic),
            Touches,
            frame=parameters.get("frameName", "world"),
            read=read,
            namespace=namespace,
            prefix=FramePrefix.OWN,
        )
