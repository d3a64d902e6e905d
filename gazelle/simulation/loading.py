"""Bring a model to life: its handle, its sensors, the plugins that its file names."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, cast

from gazelle import description
from gazelle.description import Link, Model, StagePlugin
from gazelle.errors import SimulationWarning, located
from gazelle.formats.stage.plugins import without_stage_plugins
from gazelle.simulation import registry
from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.ports import Ports
from gazelle.simulation.robot import Robot, RobotHost
from gazelle.simulation.scheduled_plugin import make_scheduled, title

if TYPE_CHECKING:
    from gazelle.simulation.stage.fleet import StageFleet


def run_stage(simulation: RobotHost) -> StageFleet | None:
    """Run the models of Stage files as Stage does; None if the engine moves them in another way."""
    from gazelle.engines.planar import PlanarEngine
    from gazelle.simulation.stage.controllers import make_controllers
    from gazelle.simulation.stage.fleet import StageFleet
    from gazelle.simulation.stage.running import StageRunner

    engine = simulation.engine
    if not isinstance(engine, PlanarEngine):
        return None
    clock, lock, seed = simulation.clock, simulation.lock, simulation.seed
    fleet = StageFleet(engine, clock, lock, seed, make_controllers)
    runner = StageRunner(fleet, simulation.loop)
    simulation.plugins.append(make_scheduled(runner, "stage", ""))
    return fleet


def is_plain(model: Model) -> bool:
    """Whether a model is all of a Stage file, without plugins of its own."""
    return model.stage is not None and not any(
        not isinstance(plugin, StagePlugin)
        for plugin in (*model.plugins, *(p for link in model.links for p in _plugins_on(link)))
    )


def _plugins_on(link: Link) -> Iterator[description.Plugin]:
    for visual in link.visuals:
        yield from visual.plugins
    for sensor in link.sensors:
        yield from sensor.plugins


def adopt(
    simulation: RobotHost, model: Model, robot: Robot, stage: StageFleet | None = None
) -> None:
    """Start the plugins of a model that the engine has, in file order.

    Args:
        simulation: Runs.
        model: That.
        robot: Its handle.
        stage: Moves it, and lets it see; plugins that do so in other engines are left out.
    """
    if stage is not None:
        from gazelle.simulation.stage.device_ports import open_devices
        from gazelle.simulation.stage.handles import inputs_of, open_outputs

        robot.inputs.update(inputs_of(stage, model.name))
        open_outputs(stage, robot)
        open_devices(stage, robot)
        model = without_stage_plugins(model)
    for placed in model.walk():
        for plugin in placed.model.plugins:
            _start(simulation, "model", robot, plugin, robot)
        for visual in (visual for link in placed.model.links for visual in link.visuals):
            for plugin in visual.plugins:
                _start(simulation, "visual", robot, plugin, robot)
    for unit in robot.sensors.values():
        for plugin in unit.description.plugins:
            if stage is None or not isinstance(plugin, StagePlugin):
                _start(simulation, "sensor", unit, plugin, robot)


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
    """Whether a plugin is in an element of its kind; says so if it is not."""
    kinds = [vars(each).get("belongs_into", "") for each in found.__mro__]
    if element in kinds:
        return True
    wanted = " or ".join(f"a <{tag}>" for tag in kinds if tag)
    text = f"{name} ({plugin.filename}) belongs into {wanted}, not into a <{element}>"
    said = located(f"{text}, and is left out", plugin.source)
    warnings.warn(SimulationWarning(said), stacklevel=5)
    return False
