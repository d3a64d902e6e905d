"""Stage's well-known controllers, each for all robots that name it at once.

Their figures are those of the controllers of the same names that come with Stage.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Model, World
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.native.system import System
from gazelle.stage.description import stage_model, stage_world
from gazelle.stage.description.models import StageController
from gazelle.stage.fleet import StageFleet
from gazelle.stage.fleet_controller import FleetController
from gazelle.stage.format.models import known_controllers
from gazelle.stage.robots import Ranger, StageRobot
from gazelle.stage.wandering import Wandering
from gazelle.streams import Stream

CRUISE = 0.4  # [m/s]
CREEP = 0.05  # [m/s]
TURN = 0.5  # [rad/s]
FRONT = 1.0  # distance ahead at which it turns away [m]
STOP = 0.3  # distance at which it stands [m]
PATIENCE = 10  # least updates that it turns for, and how many more it may
FEW: Final = 8  # samples with which Stage's own does not run
DEVIATION = 0.05  # of lasernoise [m]
_SHARE = 64  # robots that are worth a thread


Wanted = list[tuple[StageRobot, str]]
"""The robots whose ``ctrl`` names a controller, each with what comes after the name."""

Maker = Callable[[StageFleet, Wanted], list[FleetController]]


def register_controller(name: str, make: Maker) -> None:
    """Register a Python controller for robots that name it, in simulations made later.

    Args:
        name: What ``ctrl "NAME ..."`` says; one of that name is replaced.
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
    named: dict[str, Wanted] = {}
    for robot in simulation.robots:
        models = [robot.model, *(ranger.model for ranger in robot.rangers)]
        for controller in (each for model in models for each in model.controllers):
            named.setdefault(controller.name, []).append((robot, controller.arguments))
    made: list[FleetController] = []
    for name, wanted in named.items():
        maker = _makers.get(name)
        if maker is not None:
            made += maker(simulation, wanted)
    return made


def with_wander(world: World) -> World:
    """Return the world of a Stage file with ``wander`` for each robot that no controller drives.

    Raises:
        SimulationError: It is of no Stage file.
    """
    if stage_world(world) is None:
        raise SimulationError(
            f"only robots of Stage files wander, and '{world.name}' is none",
            hint="robots of other files drive by 'cmd_vel', from --ros or the page of --view",
        )
    return replace(world, models=tuple(map(_wandering, world.models)))


def _wandering(model: Model) -> Model:
    stage = stage_model(model)
    if stage is None or stage.position is None:
        return model
    if any(placed.model.controllers for placed in stage.walk()):
        return model
    return replace(model, content=replace(stage, controllers=(StageController("wander"),)))


class Wander(FleetController):
    """Goes ahead until something is near, then turns away from it for a while.

    Args:
        simulation: Runs.
        robots: Those it drives, each with what it looks at; all of one scanner.
        scanner: That.
    """

    def __init__(
        self, simulation: StageFleet, robots: list[tuple[StageRobot, Ranger]], scanner: int
    ) -> None:
        self._simulation, self._scanner = simulation, scanner
        self._own = np.array([robot.index for robot, _ in robots], np.int64)
        self._places = np.array([ranger.places[0][1] for _, ranger in robots], np.int64)
        self.rebind()
        self._mood = np.zeros((len(self._bodies), 2), np.int64)
        key = Stream(simulation.seed, f"wander/{scanner}", 1).keys[0]
        self._seed = int(key >> np.uint64(1))

    def rebind(self) -> None:
        """Find the robots and what they see with among all."""
        simulation = self._simulation
        worlds = np.arange(simulation.nworld, dtype=np.int64)[:, None]
        self._bodies = (worlds * simulation.fleet.nbody + self._own).ravel()
        count = len(simulation.mounts[self._scanner])
        self._sensors = (worlds * count + self._places).ravel()
        self._made: tuple[Floats, Wandering] | None = None

    def update(self) -> None:
        """Update speed and turn of every robot by its scan."""
        law, now = self._law(self._simulation.scan(self._scanner)), self._simulation.clock.now_ns
        self._simulation.fleet.pool.share(
            lambda first, last, _: law.choose(first, last, now), len(self._bodies), _SHARE
        )

    def systems(self) -> list[System] | None:
        """Return its systems; see `FleetController.systems`."""
        looking = self._simulation.scan_system(self._scanner)
        return None if looking is None else [looking[0], self._law(looking[1])]

    def reset(self, worlds: Worlds | None = None) -> None:
        """Stop turning."""
        rows = slice(None) if worlds is None else worlds
        self._mood.reshape(self._simulation.nworld, -1, 2)[rows] = 0

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the remaining turning times."""
        return {"mood": self._mood.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._mood[:] = state["mood"]

    def _law(self, ranges: Floats) -> Wandering:
        """Return the law for these ranges; kept while they are written to the same place."""
        if self._made is None or self._made[0] is not ranges:
            law = Wandering(
                self._simulation.fleet.command.reshape(-1, 3),
                ranges.reshape(-1, ranges.shape[-1]),
                self._sensors,
                self._bodies,
                self._mood,
                nworld=self._simulation.nworld,
                seed=self._seed,
                cruise=CRUISE,
                creep=CREEP,
                turn=TURN,
                front=FRONT,
                stop=STOP,
                patience=PATIENCE,
            )
            self._made = ranges, law
        return self._made[1]


class LaserNoise(FleetController):
    """Adds white noise to what the rangers of some robots measure; it acts in the scan itself."""

    def __init__(self, simulation: StageFleet, robots: Wanted) -> None:
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


def _make_wander(simulation: StageFleet, wanted: Wanted) -> list[FleetController]:
    groups: dict[int, list[tuple[StageRobot, Ranger]]] = {}
    blind = []
    for robot, _ in wanted:
        ranger = _looked_at(robot)
        if ranger is None:
            blind.append(robot.name)
        else:
            groups.setdefault(ranger.places[0][0], []).append((robot, ranger))
    if blind:
        warnings.warn(
            f"'wander' needs a ranger; these have none and stand: {', '.join(blind[:5])}",
            SimulationWarning,
            stacklevel=2,
        )
    return [Wander(simulation, robots, scanner) for scanner, robots in groups.items()]


def _looked_at(robot: StageRobot) -> Ranger | None:
    """Return the first ranger of more than 8 samples, as in Stage; without one the first."""
    rangers = [ranger for ranger in robot.rangers if ranger.places]
    fine = [ranger for ranger in rangers if ranger.sensors[0].samples > FEW]
    return next(iter(fine or rangers), None)


def _make_noise(simulation: StageFleet, wanted: Wanted) -> list[FleetController]:
    return [LaserNoise(simulation, wanted)]


_makers: dict[str, Maker] = {"wander": _make_wander, "lasernoise": _make_noise}
