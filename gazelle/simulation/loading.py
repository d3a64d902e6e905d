"""Bring a model to life: its handle, its sensors, the plugins that its file names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle import description
from gazelle.description import Model
from gazelle.errors import Error
from gazelle.simulation import registry
from gazelle.simulation.plugin import ModelPlugin, SensorPlugin, WorldPlugin
from gazelle.simulation.robot import Robot
from gazelle.simulation.stepping import make_scheduled, warn_of_fault

if TYPE_CHECKING:
    from gazelle.simulation.simulation import Simulation


def adopt(simulation: Simulation, model: Model, robot: Robot) -> None:
    """Start the plugins of a model that the engine has, in file order."""
    for placed in model.walk():
        for plugin in placed.model.plugins:
            found = registry.find(plugin)
            if found is not None and issubclass(found, ModelPlugin):
                _start(simulation, found(), robot, plugin, robot.name)
    for unit in robot.sensors.values():
        for plugin in unit.description.plugins:
            found = registry.find(plugin)
            if found is not None and issubclass(found, SensorPlugin):
                _start(simulation, found(), unit, plugin, robot.name)


def load_world_plugin(simulation: Simulation, plugin: description.Plugin) -> None:
    """Start a plugin of the world."""
    found = registry.find(plugin)
    if found is not None and issubclass(found, WorldPlugin):
        _start(simulation, found(), simulation, plugin, "")


def _start(
    simulation: Simulation, loaded: Any, entity: object, plugin: description.Plugin, owner: str
) -> None:
    """Load a plugin; one that breaks down is left out with a warning, a wrong file is an error."""
    try:
        loaded.load(entity, plugin.parameters)
    except Error:
        raise
    except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
        warn_of_fault(f"plugin '{plugin.name}'", owner, "while loading and is left out", error)
        return
    simulation.plugins.append(make_scheduled(loaded, plugin.name, owner))
