"""Kinds of world files whose models run in a way of their own.

A description names its kind (``World.kind``, ``Model.kind``). What runs a kind is in a room above,
which is imported by its name when a simulation first has such a model: this room knows none.
"""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from gazelle.description import Model, Plugin, Sensor
from gazelle.sensors import SensorModel
from gazelle.simulation.robot import Robot, RobotHost

_KINDS = {"stage": "gazelle.stage.kind:run_stage"}


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
    """Return what starts a kind; None for one whose models run as all others."""
    if name not in _KINDS:
        return None
    start: Start = pkgutil.resolve_name(_KINDS[name])
    return start
