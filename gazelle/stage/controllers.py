"""Stage's well-known controllers, each for all robots that name it at once.

Their figures are those of the controllers of the same names that come with Stage.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Final

from gazelle.array_types import Worlds
from gazelle.description import Model, World
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean
from gazelle.native.system import System
from gazelle.stage.description import stage_model, stage_world
from gazelle.stage.description.models import StageController
from gazelle.stage.fleet import StageFleet
from gazelle.stage.fleet_controller import FleetController
from gazelle.stage.format.models import known_controllers
from gazelle.stage.ranger_controller import RangerController
from gazelle.stage.robots import Ranger, StageRobot
from gazelle.stage.rounds import Rounds
from gazelle.stage.wander import Wander

FEW: Final = 8  # samples with which Stage's own does not run
DEVIATION = 0.05  # of lasernoise [m]


RobotArguments = list[tuple[StageRobot, str]]
"""The robots whose ``ctrl`` names a controller, each with what comes after the name."""

Maker = Callable[[StageFleet, RobotArguments], list[FleetController]]


def register_controller(name: str, make: Maker) -> None:
    """Register a Python controller for robots that name it, in simulations made later.

    Args:
        name: Name in ``ctrl "NAME ..."``; one of that name is replaced.
        make: Called once a simulation, with it and all those robots; the controllers it returns
            are asked before every step.

    Raises:
        SimulationError: The name is none.
    """
    if len(name.split()) != 1:
        raise SimulationError(f"a controller's name is one word, not '{name}'")
    _makers[name] = make
    known_controllers.add(name)


def make_controllers(simulation: StageFleet) -> list[FleetController]:
    """Create the controllers that robots name; unknown ones were warned of on loading."""
    named: dict[str, RobotArguments] = {}
    for robot in simulation.robots:
        models = [robot.model, *(ranger.model for ranger in robot.rangers)]
        for controller in (each for model in models for each in model.controllers):
            named.setdefault(controller.name, []).append((robot, controller.arguments))
    made: list[FleetController] = []
    for name, robots in named.items():
        maker = _makers.get(name)
        if maker is not None:
            made += maker(simulation, robots)
    return made


def with_wander(world: World, controller: str = "wander") -> World:
    """Return the world of a Stage file with a controller for each robot that has none.

    Args:
        world: The world.
        controller: ``wander``, or ``rounds``: in a round through all starting places.

    Raises:
        SimulationError: It is of no Stage file, or there is no such controller.
    """
    if controller not in _makers:
        hint = did_you_mean(controller, _makers)
        raise SimulationError(f"there is no controller '{controller}'", hint=hint)
    if stage_world(world) is None:
        raise SimulationError(
            f"only robots of Stage files can wander, and '{world.name}' is not a Stage file",
            hint="robots of other files drive by 'cmd_vel', from --ros or the page of --view",
        )
    return replace(world, models=tuple(_driven(model, controller) for model in world.models))


def _driven(model: Model, controller: str) -> Model:
    stage = stage_model(model)
    if stage is None or stage.position is None:
        return model
    if any(placed.model.controllers for placed in stage.walk()):
        return model
    return replace(model, content=replace(stage, controllers=(StageController(controller),)))


class LaserNoise(FleetController):
    """Adds white noise to what the rangers of some robots measure; it acts in the scan itself."""

    def __init__(self, simulation: StageFleet, robots: RobotArguments) -> None:
        self._simulation, self._robots = simulation, robots
        self.rebind()

    def rebind(self) -> None:
        """Add the noise to the scanners."""
        for robot, arguments in self._robots:
            deviation = _number(arguments, DEVIATION)
            for ranger in robot.rangers:
                for scanner, place in ranger.places:
                    self._simulation.noise[scanner].constant[place] += deviation

    def update(self) -> None:
        """Do nothing: the noise is in the scans."""

    def systems(self) -> list[System]:
        """Return None: the noise is in the scans."""
        return []

    def reset(self, worlds: Worlds | None = None) -> None:
        """Do nothing: there is no state."""


def _number(text: str, default: float) -> float:
    try:
        return abs(float(text.split(maxsplit=1)[0])) if text.split() else default
    except ValueError:
        return default


def _make_rangers(
    kind: type[RangerController], simulation: StageFleet, robots: RobotArguments
) -> list[FleetController]:
    groups: dict[int, list[tuple[StageRobot, Ranger]]] = {}
    blind = []
    for robot, _ in robots:
        ranger = _looked_at(robot)
        if ranger is None:
            blind.append(robot.name)
        else:
            groups.setdefault(ranger.places[0][0], []).append((robot, ranger))
    if blind:
        warnings.warn(
            f"'{kind.__name__.lower()}' needs a ranger; these robots have none and do not move: {', '.join(blind[:5])}",
            SimulationWarning,
            stacklevel=2,
        )
    return [kind(simulation, robots, scanner) for scanner, robots in groups.items()]


def _looked_at(robot: StageRobot) -> Ranger | None:
    """Return the first ranger of more than 8 samples, as in Stage; without one the first."""
    rangers = [ranger for ranger in robot.rangers if ranger.places]
    fine = [ranger for ranger in rangers if ranger.sensors[0].samples > FEW]
    return next(iter(fine or rangers), None)


def _make_noise(simulation: StageFleet, robots: RobotArguments) -> list[FleetController]:
    return [LaserNoise(simulation, robots)]


_makers: dict[str, Maker] = {
    "rounds": partial(_make_rangers, Rounds),
    "lasernoise": _make_noise,
    "wander": partial(_make_rangers, Wander),
}
