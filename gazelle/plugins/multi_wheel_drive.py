"""Bases on six or any number of wheels: Hector's ``diffdrive_plugin_6w`` and ``_multi_wheel``."""

from __future__ import annotations

from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.odometry import OdometryOutputs, TrueOdometry
from gazelle.plugins.wheels import Side, WheeledDrive
from gazelle.simulation import Robot, absolute, namespace_of


class MultiWheelDrive(WheeledDrive):
    """Turns velocity commands into the speeds of any number of wheels a side."""

    _usual_torque = 5.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, put motors on the wheels, open ``cmd_vel`` and ``odom``."""
        self._robot = robot
        self.drive(
            robot,
            self._joints(parameters),
            separation=parameters.get("wheelSeparation", 0.34),
            diameter=parameters.get("wheelDiameter", 0.15),
            torque=parameters.get("torque", self._usual_torque),
            source=parameters.source,
        )
        self.update_rate = parameters.get("updateRate", 100.0)
        namespace = namespace_of(robot, parameters)
        self.listen(robot, absolute(namespace, self._command_topic(parameters)))
        frame = parameters.get("odometryFrame", "odom")
        base = parameters.get("robotBaseFrame", "base_footprint")
        topic = absolute(namespace, parameters.get("odometryTopic", "odom"))
        published = parameters.get("publishOdometryMsg", True)
        framed = parameters.get("publishOdometryTf", True)
        measure = TrueOdometry(robot, frame, base)
        self.publish_odometry(
            OdometryOutputs(robot, topic, measure, namespace, published=published, framed=framed)
        )

    def _joints(self, parameters: Parameters) -> list[tuple[str, Side]]:
        """Return names of the joints, and their sides."""
        found = []
        for tag, side in (("leftJoints", Side.LEFT), ("rightJoints", Side.RIGHT)):
            names = parameters.require(tag, str).split()
            if not names:
                raise SimulationError(f"<{tag}> names no joint", source=parameters.source)
            found += [(name, side) for name in names]
        return found

    def _command_topic(self, parameters: Parameters) -> str:
        return parameters.get("commandTopic", "cmd_vel")


class SixWheelDrive(MultiWheelDrive):
    """Turns velocity commands into the speeds of three wheels a side."""

    _usual_torque = 10.0

    def _joints(self, parameters: Parameters) -> list[tuple[str, Side]]:
        return [
            (parameters.require(f"{place}{word}Joint", str), side)
            for word, side in (("Left", Side.LEFT), ("Right", Side.RIGHT))
            for place in ("front", "mid", "rear")
        ]

    def _command_topic(self, parameters: Parameters) -> str:
        return parameters.get("topicName", "cmd_vel")
