"""Sensors and inputs of one of Stage's robots: rows of what a fleet has."""

from __future__ import annotations

from gazelle.array_types import Floats
from gazelle.description import Model, Sensor
from gazelle.sensors import SensorModel
from gazelle.simulation.ports import TwistInput
from gazelle.simulation.stage.camera_model import StageCameraModel
from gazelle.simulation.stage.cameras import cameras_of
from gazelle.simulation.stage.drive_input import DriveInput
from gazelle.simulation.stage.fleet import StageFleet
from gazelle.simulation.stage.ranger_model import RangerModel


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


def _camera_model(fleet: StageFleet, name: str, which: int, sensor: Sensor) -> SensorModel:
    (camera,) = sensor.cameras
    return StageCameraModel(camera, lambda worlds: fleet.pictures([name], which, worlds))


def _ranger_model(fleet: StageFleet, name: str, which: int, number: int) -> RangerModel:
    def ranges() -> Floats:  # other models may have come or gone
        scanner, place = fleet.robot(name).rangers[which].places[number]
        seen: Floats = fleet.scan(scanner)[:, place]
        return seen

    return RangerModel(fleet.robot(name).rangers[which].sensors[number], ranges)
