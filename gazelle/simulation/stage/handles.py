"""Sensors, inputs and outputs of one of Stage's robots: rows of what a fleet has."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Model, Sensor
from gazelle.formats.stage.plugins import STAND_INS
from gazelle.rotations import from_yaw
from gazelle.sensors import LaserScan, SensorModel
from gazelle.simulation.ports import Output, TwistInput
from gazelle.simulation.requests import between_steps
from gazelle.simulation.robot import Robot
from gazelle.simulation.sensors import SensorOutput
from gazelle.simulation.stage.camera_model import StageCameraModel
from gazelle.simulation.stage.cameras import cameras_of
from gazelle.simulation.stage.drive_input import DriveInput
from gazelle.simulation.stage.fleet import StageFleet
from gazelle.simulation.stage.ranger_model import RangerModel
from gazelle.simulation.topics import absolute
from gazelle.simulation.values import Odometry


def sensor_models(fleet: StageFleet, model: Model) -> list[tuple[Sensor, SensorModel]]:
    """What measures with the rangers and cameras of a model, and what its file says of each."""
    robot = fleet.named.get(model.name)
    if robot is None:
        return []
    known = {sensor.name: sensor for link in model.links for sensor in link.sensors}
    rangers: list[tuple[Sensor, SensorModel]] = [
        (known[name], _ranger_model(fleet, robot.name, which, number))
        for which, ranger in enumerate(robot.rangers)
        for number in range(len(ranger.sensors))
        if (name := ranger.sensor_name(number)) in known
    ]
    return rangers + [
        (known[camera.path], _camera_model(fleet, robot.name, which, known[camera.path]))
        for which, camera in enumerate(cameras_of(robot))
        if camera.path in known
    ]


def inputs_of(fleet: StageFleet, name: str) -> dict[str, TwistInput]:
    """The inputs of a model: ``cmd_vel`` of a robot."""
    if name not in fleet.named:
        return {}
    return {"cmd_vel": DriveInput(fleet.nworld, lambda: fleet.commands[:, fleet.robot(name).index])}


def open_outputs(fleet: StageFleet, robot: Robot) -> None:
    """Give a robot ``odom``, and the scans that its file has published, under stage_ros's names."""
    for unit in robot.sensors.values():
        for plugin in unit.description.plugins:
            if plugin.filename in STAND_INS:
                given = plugin.parameters
                topic, own = given.get("topicName", "base_scan"), given.get("robotNamespace", "")
                frame = given.get("frameName", "base_laser_link")
                robot.outputs[topic] = SensorOutput(
                    unit, absolute(own, topic), LaserScan, frame=frame, namespace=own
                )
    for plugin in robot.description.plugins:
        if plugin.filename in STAND_INS and robot.name in fleet.named:
            given = plugin.parameters
            own = given.get("robotNamespace", "")
            frames = given.get("odometryFrame", "odom"), given.get("robotBaseFrame", "base_link")
            robot.outputs["odom"] = _OdometryOutput(fleet, robot, own, frames)


class _OdometryOutput(Output[Odometry]):
    """Where a robot believes it is, after every step while somebody listens."""

    def __init__(
        self, fleet: StageFleet, robot: Robot, namespace: str, frames: tuple[str, str]
    ) -> None:
        super().__init__(absolute(namespace, "odom"), Odometry, self._measure, namespace=namespace)
        self._fleet, self._robot, self._frames = fleet, robot, frames
        self._stop_telling: Callable[[], None] | None = None

    @between_steps
    def subscribe(self, listener: Callable[[Odometry], None]) -> Callable[[], None]:
        """Call a function with every value published; returns what ends it."""
        end = super().subscribe(listener)
        if self._stop_telling is None:
            self._stop_telling = self._robot.simulation.subscribe(self.publish)

        def finish() -> None:
            end()
            if not self.wanted and self._stop_telling is not None:
                self._stop_telling()
                self._stop_telling = None

        return finish

    def _measure(self) -> Odometry:
        fleet, nworld = self._fleet, self._fleet.nworld
        robot = fleet.robot(self._robot.name)
        pose, driven = fleet.odometry[:, robot.index], fleet.velocities[:, robot.index]
        position, linear, angular = (np.zeros((nworld, 3)) for _ in range(3))
        position[:, :2], position[:, 2] = pose[:, :2], robot.model.pose.z
        linear[:, :2], angular[:, 2] = driven[:, :2], driven[:, 2]
        none: Any = (0.0,) * 6
        now = fleet.clock.now_ns
        turned = from_yaw(pose[:, 2])
        return Odometry(now, *self._frames, position, turned, linear, angular, none, none)


def _camera_model(fleet: StageFleet, name: str, which: int, sensor: Sensor) -> SensorModel:
    (camera,) = sensor.cameras
    return StageCameraModel(camera, lambda worlds: fleet.pictures([name], which, worlds))


def _ranger_model(fleet: StageFleet, name: str, which: int, number: int) -> RangerModel:
    def ranges() -> Floats:  # other models may have come or gone
        scanner, place = fleet.robot(name).rangers[which].places[number]
        seen: Floats = fleet.scan(scanner)[:, place]
        return seen

    return RangerModel(fleet.robot(name).rangers[which].sensors[number], ranges)
