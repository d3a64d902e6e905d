"""Base classes of plugins: code that a file names, run with the simulation.

Subclass one of these, override what you need, and register it under the file name that
SDF and URDF files use (see ``registry``). All worlds of a batch share one plugin object, so
its state is arrays with a leading axis over worlds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.description import Parameters
from gazelle.simulation.base_plugin import BasePlugin

if TYPE_CHECKING:
    from gazelle.simulation.robot import Robot, SensorUnit
    from gazelle.simulation.simulation import Simulation


class WorldPlugin(BasePlugin):
    """A plugin of the world."""

    belongs_into = "world"

    def load(self, simulation: Simulation, parameters: Parameters) -> None:
        """Start: read the parameters and store references."""


class SystemPlugin(WorldPlugin):
    """A plugin that no file names: ``gazelle run --system MODULE:CLASS``, ``gzserver -s``.

    It is loaded with empty parameters, once the world is there; see ``Simulation.load_plugin``.
    """


class ModelPlugin(BasePlugin):
    """A plugin of a model."""

    belongs_into = "model"

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Start: read the parameters, open ports on the robot."""


class VisualPlugin(BasePlugin):
    """A plugin of a visual, such as one that shows a video on it."""

    belongs_into = "visual"

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Start, on the robot that has the visual."""


class SensorPlugin(BasePlugin):
    """A plugin of a sensor."""

    belongs_into = "sensor"

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Start: read the parameters, open ports on ``sensor.robot``."""
