"""Bring a model to life: its handle, its sensors, the plugins that its file names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle import description
from gazelle.description import Model
from gazelle.simulation import registry
from gazelle.simulation.plugin import ModelPlugin, Plugin, SensorPlugin, WorldPlugin
from gazelle.simulation.robot import Robot
from gazelle.simulation.stepping import make_scheduled

if TYPE_CHECKING:
    from gazelle.simulation.simulation import Simulation


def adopt(simulation: Simulation, model: Model, robot: Robot) -> None:
    """Start the plugins of a model that the engine has, in file order."""
    for placed in model.walk():
        for plugin in placed.model.plugins:
            found = registry.find(plugin)
            if found is not None and issubclass(found, ModelPlugin):
                loaded = found()
                loaded.load(robot, plugin.parameters)
                _keep(simulation, loaded, plugin, robot.name)
    for unit in robot.sensors.values():
        for plugin in unit.description.plugins:
            found = registry.find(plugin)
            if found is not None and issubclass(found, SensorPlugin):
                on_sensor = found()
                on_sensor.load(unit, plugin.parameters)
                _keep(simulation, on_sensor, plugin, robot.name)


def load_world_plugin(simulation: Simulation, plugin: description.Plugin) -> None:
    """Start a plugin of the world."""
    found = registry.find(plugin)
    if found is not None and issubclass(found, WorldPlugin):
        loaded = found()
        loaded.load(simulation, plugin.parameters)
        _keep(simulation, loaded, plugin, "")


def _keep(simulation: Simulation, loaded: Plugin, plugin: description.Plugin, owner: str) -> None:
    simulation.plugins.append(make_scheduled(loaded, plugin.name, owner))
