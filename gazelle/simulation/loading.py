"""Load a model: its handle, its sensors and the plugins of its file."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from typing import Any, cast

from gazelle import description
from gazelle.description import Link, Model
from gazelle.errors import SimulationWarning, located
from gazelle.simulation import registry
from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.ports import Ports
from gazelle.simulation.robot import Robot, RobotHost
from gazelle.simulation.scheduled_plugin import make_scheduled, title
from gazelle.simulation.world_kinds import WorldKind


def is_plain(model: Model, kind: WorldKind) -> bool:
    """Return whether a kind of world does all that the file says of a model."""
    return not any(
        kind.starts(plugin)
        for plugin in (*model.plugins, *(p for link in model.links for p in _plugins_on(link)))
    )


def _plugins_on(link: Link) -> Iterator[description.Plugin]:
    for visual in link.visuals:
        yield from visual.plugins
    for sensor in link.sensors:
        yield from sensor.plugins


def start_plugins(
    simulation: RobotHost, model: Model, robot: Robot, kind: WorldKind | None = None
) -> None:
    """Start the plugins of a model that the engine has, in file order.

    Args:
        simulation: Runs.
        model: Model of the plugins.
        robot: Its handle.
        kind: Runs it, in place of some of its plugins; None for models of no special kind.
    """

    def start(element: str, entity: object, plugins: Iterable[description.Plugin]) -> None:
        for plugin in plugins:
            if kind is None or kind.starts(plugin):
                _start(simulation, element, entity, plugin, robot)

    if kind is not None:
        kind.open_ports(robot)
    for placed in model.walk():
        start("model", robot, placed.model.plugins)
        for visual in (visual for link in placed.model.links for visual in link.visuals):
            start("visual", robot, visual.plugins)
    for unit in robot.sensors.values():
        start("sensor", unit, unit.description.plugins)


def load_world_plugin(simulation: RobotHost, plugin: description.Plugin) -> None:
    """Start a plugin of the world, or one that is given besides it."""
    _start(simulation, "world", simulation, plugin, None)


def _start(
    simulation: RobotHost,
    element: str,
    entity: object,
    plugin: description.Plugin,
    robot: Robot | None,
) -> None:
    """Load a plugin; one that cannot be had or that fails is left out with a warning."""
    owner = robot.name if robot is not None else ""
    name, loaded = title(plugin.name, owner), None
    ports: Ports = robot if robot is not None else simulation.ports
    opened = ports.mark()
    try:
        found = registry.find(plugin)
        if found is None or not _fits(found, element, name, plugin):
            return
        loaded = cast("Any", found())
        loaded.handle = plugin.name
        loaded.load(entity, plugin.parameters)
    except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
        ports.back_to(opened)
        warn_of_fault(loaded, name, "while loading and is left out", error, plugin.source)
        return
    simulation.plugins.append(make_scheduled(loaded, plugin.name, owner, simulation.lock))


def _fits(found: type[BasePlugin], element: str, name: str, plugin: description.Plugin) -> bool:
    """Return whether a plugin is in an element of its kind; warn if it is not."""
    kinds = [vars(each).get("belongs_into", "") for each in found.__mro__]
    if element in kinds:
        return True
    expected = " or ".join(f"a <{tag}>" for tag in kinds if tag)
    text = f"{name} ({plugin.filename}) belongs into {expected}, not into a <{element}>"
    said = located(f"{text}, and is left out", plugin.source)
    warnings.warn(SimulationWarning(said), stacklevel=5)
    return False
