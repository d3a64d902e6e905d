"""Camera images of a robot as observations, in all worlds at once."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import gymnasium as gym
import numpy as np

from gazelle.array_types import Bytes, Worlds
from gazelle.description import Model, Sensor
from gazelle.errors import TaskError, did_you_mean
from gazelle.sensors import CameraModel
from gazelle.simulation import Robot


class CameraObservation:
    """The pictures of one camera of a robot, for a task of one's own.

    They are rendered on request, of just the requested worlds, whatever the
    ``update_rate`` of the camera.

    Args:
        robot: In a simulation with any engine.
        sensor: Name of the camera; the only one if None.

    Attributes:
        space: Of one world: colours, ``Box(0, 255, (height, width, 3), uint8)``.

    Raises:
        TaskError: There is no such camera, or several and no name.
    """

    def __init__(self, robot: Robot, sensor: str | None = None) -> None:
        cameras = [
            name for name, unit in robot.sensors.items() if isinstance(unit.model, CameraModel)
        ]
        if sensor is None and len(cameras) != 1:
            raise TaskError(
                f"the robot '{robot.name}' has {len(cameras)} cameras",
                hint=f"name one: {', '.join(cameras)}"
                if cameras
                else "add a <sensor>, or take another",
            )
        name = sensor or cameras[0]
        if name not in cameras:
            raise TaskError(
                f"the robot '{robot.name}' has no camera '{name}'",
                hint=did_you_mean(name, cameras),
            )
        self._unit = robot.sensors[name]
        model = self._unit.model
        if not isinstance(model, CameraModel) or len(model.cameras) != 1:
            raise TaskError(f"'{name}' has several cameras; the task needs one")
        camera = model.cameras[0]
        self.space = gym.spaces.Box(0, 255, (camera.height, camera.width, 3), np.uint8)

    def read(self, worlds: Worlds | None = None) -> Bytes:
        """Return the present images, shape (n, height, width, 3), top row first.

        Args:
            worlds: Of these worlds, shape (n,); of all if None.
        """
        color: Bytes = self._unit.reading(self._unit.measure(worlds)).color
        return color


def fit_camera(model: Model, width: int, height: int) -> Model:
    """Return the robot, its cameras with a given number of pixels; the horizontal field of view stays.

    Args:
        model: The robot.
        width: Columns.
        height: Rows.

    Raises:
        TaskError: It has no camera.
    """
    if next(_cameras(model), None) is None:
        raise TaskError(
            f"the robot '{model.name}' has no camera, which this task needs",
            source=model.source,
            hint="add a <sensor type='camera'>, or take turtlebot3_waffle_pi",
        )
    return _fitted(model, width, height)


def _cameras(model: Model) -> Iterator[Sensor]:
    for placed in model.walk():
        for link in placed.model.links:
            yield from (sensor for sensor in link.sensors if sensor.cameras)


def _fitted(model: Model, width: int, height: int) -> Model:
    def fit(sensor: Sensor) -> Sensor:
        cameras = tuple(replace(each, width=width, height=height) for each in sensor.cameras)
        return replace(sensor, cameras=cameras) if cameras else sensor

    links = tuple(replace(link, sensors=tuple(map(fit, link.sensors))) for link in model.links)
    nested = tuple(_fitted(inner, width, height) for inner in model.models)
    return replace(model, links=links, models=nested)
