"""Lookup of the sensor model that a plugin needs."""

from __future__ import annotations

from typing import Any, TypeVar

from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.sensors import CameraModel, ContactModel, ImuModel, LidarModel, SonarModel
from gazelle.simulation import SensorUnit

M = TypeVar("M")

_WORDS: dict[type[Any], str] = {
    CameraModel: "camera, depth or multicamera",
    LidarModel: "ray or gpu_ray",
    ImuModel: "imu",
    ContactModel: "contact",
    SonarModel: "sonar",
}


def model_of(sensor: SensorUnit, kind: type[M], parameters: Parameters) -> M:
    """Return the model of a sensor, if it is of a kind.

    Raises:
        SimulationError: It is of another kind.
    """
    model: Any = sensor.model
    if isinstance(model, kind):
        return model
    raise SimulationError(
        f"it needs a sensor of type {_WORDS[kind]}; '{sensor.name}' is of type "
        f"'{sensor.description.type}'",
        source=parameters.source,
    )
