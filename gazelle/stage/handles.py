"""Sensors, inputs and outputs of one of Stage's robots: rows of what a fleet has."""

from __future__ import annotations

from functools import partial

from gazelle.array_types import Floats
from gazelle.description import Model, Sensor
from gazelle.sensors import LaserScan, SensorModel
from gazelle.simulation.ports import TwistInput
from gazelle.simulation.robot import Robot
from gazelle.simulation.sensors import SensorOutput
from gazelle.simulation.topics import absolute
from gazelle.simulation.values import Odometry
from gazelle.stage.camera_model import StageCameraModel
from gazelle.stage.cameras import cameras_of
from gazelle.stage.description import StagePlugin
from gazelle.stage.drive_input import DriveInput
from gazelle.stage.fleet import StageFleet
from gazelle.stage.ranger_model import RangerModel
from gazelle.stage.step_output import StepOutput


def sensor_models(fleet: StageFleet, model: Model) -> list[tuple[Sensor, SensorModel]]:
    """Return the models that measure with a model's rangers and cameras, and their descriptions."""
    robot = fleet.named.get(model.name)
    if robot is None:
        return []
    known = {sensor.name: sensor for link in model.links for sensor in link.sensors}
    rangers: list[tuple[Sensor, SensorModel]] = [
        (known[name], RangerModel(fleet, robot.name, which, number))
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
    """Return the inputs of a model: ``cmd_vel`` of a robot."""
    robot = fleet.named.get(name)
    if robot is None:
        return {}

    def commands() -> Floats:  # other models may have come or gone
        own: Floats = fleet.commands[:, fleet.robot(name).index]
        return own

    steers = robot.position.drive == "car"
    return {"cmd_vel": DriveInput(fleet.nworld, commands, steers=steers)}


def open_outputs(fleet: StageFleet, robot: Robot) -> None:
    """Open ``odom``, and the scans that its file publishes, under stage_ros's names."""
    for unit in robot.sensors.values():
        for plugin in unit.description.plugins:
            if isinstance(plugin, StagePlugin):
                tags = plugin.parameters
                topic, own = tags.get("topicName", "base_scan"), tags.get("robotNamespace", "")
                frame = tags.get("frameName", "base_laser_link")
                robot.outputs[topic] = SensorOutput(
                    unit, absolute(own, topic), LaserScan, frame=frame, namespace=own
                )
    for plugin in robot.description.plugins:
        if isinstance(plugin, StagePlugin) and robot.name in fleet.named:
            tags = plugin.parameters
            own = tags.get("robotNamespace", "")
            frames = tags.get("odometryFrame", "odom"), tags.get("robotBaseFrame", "base_link")
            measure = partial(_odometry_of, fleet, robot.name, frames)
            robot.outputs["odom"] = StepOutput(robot, absolute(own, "odom"), Odometry, measure, own)


def _odometry_of(fleet: StageFleet, name: str, frames: tuple[str, str]) -> Odometry:
    return fleet.measured_odometry.of(name, frames)  # of a fleet with other models, another


def _camera_model(fleet: StageFleet, name: str, which: int, sensor: Sensor) -> SensorModel:
    (camera,) = sensor.cameras
    return StageCameraModel(camera, lambda worlds: fleet.pictures([name], which, worlds))
