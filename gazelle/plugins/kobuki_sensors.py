"""Event sensors of a Kobuki: cliffs and bumpers."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.rotations import yaw_of
from gazelle.sensors import ContactModel, LidarModel
from gazelle.sensors.lidar import directions_of
from gazelle.simulation import Output, Robot, SensorUnit
from gazelle.simulation.values import BumperValue, CliffValue

_PLACES = ("left", "center", "right")
# Contacts at these heights above the floor press the bumper [m], from these sides [rad].
_LOW, _HIGH = 0.015, 0.085
_SIDE, _MIDDLE = math.pi / 2.0, math.pi / 6.0
# How the infrared sensor's converter counts: scale, and the height of its reference [m].
_SCALE, _HEIGHT = 76123.0, 0.995
# A bottomless depth [m].
_FAR = 1e3


class Cliffs:
    """Three sensors that look at the floor.

    Attributes:
        deep: Whether the floor is too far away, shape (nworld, 3).
    """

    def __init__(self, robot: Robot, parameters: Parameters) -> None:
        self._threshold = parameters.require("cliff_detection_threshold", float)
        self._sensors = [
            sensor_of(robot, parameters, f"cliff_sensor_{place}_name", LidarModel)
            for place in _PLACES
        ]
        self.deep = np.zeros((robot.simulation.nworld, 3), np.bool_)
        self._engine = robot.simulation.engine
        self._distances: Floats = np.zeros((robot.simulation.nworld, 3))
        self._outputs: list[Output[CliffValue]] = []

    def open(self, robot: Robot) -> None:
        """Open the output of changes; the topic is given later."""
        for place, name in enumerate(_PLACES):
            made = Output("", CliffValue, self._value_of(place), queue_size=10, event=True)
            robot.outputs[f"cliff_{name}"] = made
            self._outputs.append(made)

    def _value_of(self, place: int) -> Callable[[], CliffValue]:
        return lambda: CliffValue(place, self.deep[:, place].copy(), self.readings[:, place])

    @property
    def readings(self) -> Floats:
        """Readings of the sensors' converters, shape (nworld, 3)."""
        return np.clip(_SCALE * np.arctan2(self._distances, _HEIGHT), 0, 65535)

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""
        return any(output.has_subscribers for output in self._outputs)

    def publish(self) -> None:
        """Measure, and publish changes."""
        for place, sensor in enumerate(self._sensors):
            nearest = self._distances[:, place] = self._floor_distance(sensor)
            deep = nearest >= self._threshold
            changed = (deep != self.deep[:, place]).any()
            self.deep[:, place] = deep
            if changed:
                self._outputs[place].publish()

    def _floor_distance(self, sensor: SensorUnit) -> Floats:
        """Return the distance to the floor [m], without the base's own hull around the sensors."""
        model: LidarModel = sensor.model  # type: ignore[assignment]  # seen to in sensor_of
        pose, least = sensor.description.pose, model.lidar.range_min
        rays = directions_of(model.angles, model.vertical_angles) @ pose.matrix()[:3, :3].T
        origins = np.asarray(pose.position) + least * rays
        link = sensor.name.rpartition("::")[0]
        hits = self._engine.links[link].cast_rays(origins, rays, ignore_own=True)
        return np.asarray(np.minimum(hits.distance.min(axis=1) + least, _FAR), np.float64)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset to a floor below all sensors."""
        self.deep[slice(None) if worlds is None else worlds] = False


class Bumpers:
    """A contact sensor that distinguishes its sides by the place of the contact.

    Attributes:
        pressed: Shape (nworld, 3).
    """

    def __init__(self, robot: Robot, parameters: Parameters) -> None:
        self._robot = robot
        self._sensor = sensor_of(robot, parameters, "bumper_name", ContactModel)
        self.pressed = np.zeros((robot.simulation.nworld, 3), np.bool_)
        self._outputs: list[Output[BumperValue]] = []

    def open(self, robot: Robot) -> None:
        """Open the output of changes; the topic is given later."""
        for place, name in enumerate(_PLACES):
            made = Output("", BumperValue, self._value_of(place), queue_size=10, event=True)
            robot.outputs[f"bumper_{name}"] = made
            self._outputs.append(made)

    def _value_of(self, place: int) -> Callable[[], BumperValue]:
        return lambda: BumperValue(place, self.pressed[:, place].copy())

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""
        return any(output.has_subscribers for output in self._outputs)

    def publish(self) -> None:
        """Update contacts, and publish changes."""
        touched = self._touched()
        changed = (touched != self.pressed).any(axis=0)
        self.pressed[:] = touched
        for output in np.array(self._outputs, object)[changed]:
            output.publish()

    def _touched(self) -> NDArray[np.bool_]:
        values = self._sensor.current()
        contacts = values.reshape(len(values), -1, 15)
        place = self._robot.placement()
        apart = contacts[:, :, 2:5] - place.position[:, None]
        heading = np.arctan2(apart[..., 1], apart[..., 0]) - yaw_of(place.quaternion)[:, None]
        heading = np.arctan2(np.sin(heading), np.cos(heading))
        counts = (apart[..., 2] >= _LOW) & (apart[..., 2] <= _HIGH)
        sides = (
            (heading > _MIDDLE) & (heading <= _SIDE),
            np.abs(heading) <= _MIDDLE,
            (heading < -_MIDDLE) & (heading >= -_SIDE),
        )
        return np.stack([(counts & side).any(axis=1) for side in sides], axis=1)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset to no contacts."""
        self.pressed[slice(None) if worlds is None else worlds] = False


def sensor_of(robot: Robot, parameters: Parameters, tag: str, model: type[object]) -> SensorUnit:
    """Return the sensor that a tag names, of the required kind."""
    sensor = robot.sensors[parameters.require(tag, str)]
    if not isinstance(sensor.model, model):
        raise SimulationError(
            f"<{tag}> names '{sensor.name}', which is of type '{sensor.description.type}'",
            source=parameters.source,
        )
    return sensor
