"""Plugin that navigates a robot of a running simulation."""

from __future__ import annotations

from typing import cast

from gazelle.description import Parameters, Plugin
from gazelle.errors import SimulationError
from gazelle.simulation import registry
from gazelle.simulation.navigation import NavigationControl
from gazelle.simulation.plugin import ModelPlugin
from gazelle.simulation.robot import Robot
from gazelle.simulation.scheduled_plugin import make_scheduled

FILE = "libgazelle_navigation.so"


def navigation_of(robot: Robot) -> NavigationControl:
    """Return a robot's navigation, created at first access.

    Raises:
        SimulationError: The robot has no drive or no laser.
    """
    plugins = robot.simulation.plugins
    kind = registry.find(Plugin("navigation", FILE))
    if kind is None or not issubclass(kind, ModelPlugin):
        raise SimulationError(f"there is no plugin '{FILE}'")
    for entry in plugins:
        if entry.owner == robot.name and isinstance(entry.plugin, kind):
            return cast("NavigationControl", entry.plugin)
    made = kind()
    made.load(robot, Parameters("plugin"))
    plugins.append(make_scheduled(made, "navigation", robot.name, robot.simulation.lock))
    return cast("NavigationControl", made)
