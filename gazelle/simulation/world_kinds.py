"""Kinds of world files with a runner of their own.

A description names its kind (``World.kind``, ``Model.kind``). What runs a kind is
found by an entry point of the group ``gazelle.simulation.kinds``, named as the kind, when a
simulation first has such a model.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol

from gazelle.description import Model, Plugin, Sensor
from gazelle.errors import SimulationError
from gazelle.sensors import SensorModel
from gazelle.simulation.robot import Robot, RobotHost
from gazelle_ros.base.entry_points import entry_points_of, load

_GROUP = "gazelle.simulation.kinds"


class WorldKind(Protocol):
    """Sensors, ports and plugins of models of one kind, in one simulation.

    Attributes:
        extension: Given to users by ``Simulation.extension``, by its class.
    """

    extension: Any

    def sensors(self, model: Model) -> Sequence[tuple[Sensor, SensorModel]]:
        """Return what measures with the sensors of a model, and their descriptions."""

    def open_ports(self, robot: Robot) -> None:
        """Open the inputs and outputs of a model of the kind."""

    def starts(self, plugin: Plugin) -> bool:
        """Return whether the simulation starts a plugin of a model, as the kind does not replace it."""


Start = Callable[[RobotHost], WorldKind | None]
"""Makes what runs a kind; None if the engine moves such models as all others."""


def find_world_kind(name: str) -> Start | None:
    """Return the starter of a kind; None where models run as in any other world.

    Raises:
        SimulationError: It cannot be imported.
    """
    point = entry_points_of(_GROUP).get(name) if name else None
    if point is None:
        return None
    start: Start = load(point, f"what runs '{name}' models", SimulationError)
    return start
