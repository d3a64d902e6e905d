"""A Stage file as a simulation, with the arrays of all its robots at hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from gazelle import formats
from gazelle.description import Model, World
from gazelle.engines.laws import with_profile
from gazelle.errors import SimulationError
from gazelle.simulation.clock import Clock
from gazelle.simulation.simulation import Simulation
from gazelle.simulation.state_lock import StateLock
from gazelle.stage.description import StageModel, stage_model, stage_world
from gazelle.stage.fleet import StageFleet
from gazelle_ros.base.closing import Closeable


def stage_of(simulation: Simulation) -> StageFleet:
    """Return the robots of Stage files in a simulation, as arrays.

    Raises:
        SimulationError: The engine does not move them as Stage does, or it has none.
    """
    fleet = simulation.extension(StageFleet)
    if fleet is None:
        raise SimulationError(
            "this is not a world of Stage in the plane", hint='use a Stage file and engine="planar"'
        )
    return fleet


class StageSimulation(Closeable):
    """``Simulation(world, engine="planar")`` and its ``StageFleet`` as one object.

    What a ``StageFleet`` has is an attribute here too; time is that of the simulation.

    Args:
        world: A description, or a file or bundled name to load one from.
        nworld: Copies.
        seed: Decides all random numbers; world i's do not depend on ``nworld``.
        threads: Native threads; all processors if None. Results do not depend on it.
        euler: Move as Stage does, straight ahead and then turning, not along the exact arc.
        sweep: Look for what is in the way within a step too, so that fast robots jump over nothing.
        controllers: Whether the controllers that the file names (``wander``, ``lasernoise``)
            run.

    Attributes:
        simulation: Simulation.
        stage_fleet: All robots, as arrays.

    Raises:
        FormatError: The file cannot be read, or is not Stage's.
        EngineError: The world cannot be simulated.
    """

    def __init__(
        self,
        world: World | str | Path,
        *,
        nworld: int = 1,
        seed: int = 0,
        threads: int | None = None,
        euler: bool = False,
        sweep: bool = False,
        controllers: bool = True,
    ) -> None:
        loaded = world if isinstance(world, World) else formats.load(world)
        if stage_world(loaded) is None:
            place = loaded.source.file if loaded.source is not None else None
            raise SimulationError("this is not a world of Stage", file=place, hint="use Simulation")
        integrator = "euler" if euler else loaded.profile.integrator
        profile = replace(loaded.profile, integrator=integrator, speculative_contacts=sweep)
        loaded = with_profile(loaded, profile)
        if not controllers:
            loaded = replace(loaded, models=tuple(map(_uncontrolled, loaded.models)))
        self.simulation = Simulation(loaded, "planar", nworld=nworld, seed=seed, threads=threads)
        self.stage_fleet = stage_of(self.simulation)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or "stage_fleet" not in self.__dict__:
            raise AttributeError(name)
        return getattr(self.stage_fleet, name)

    @property
    def clock(self) -> Clock:
        """Simulated time."""
        return self.simulation.clock

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.simulation.time

    @property
    def lock(self) -> StateLock:
        """The simulation's lock."""
        return self.simulation.lock

    @property
    def paused(self) -> bool:
        """True if ``run`` refuses to run."""
        return self.simulation.paused

    def step(self, count: int = 1) -> None:
        """Advance by steps; see ``Simulation.step``."""
        self.simulation.step(count)

    def run(self, seconds: float, *, rate: float | None = None) -> None:
        """Run the simulation; see ``Simulation.run``."""
        self.simulation.run(seconds, rate=rate)

    def pause(self) -> None:
        """Pause the simulation; see ``Simulation.pause``."""
        self.simulation.pause()

    def unpause(self) -> None:
        """Unpause the simulation; see ``Simulation.unpause``."""
        self.simulation.unpause()

    def subscribe(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Subscribe to steps; see ``Simulation.subscribe``."""
        return self.simulation.subscribe(listener)

    def reset(self) -> None:
        """Reset the simulation; see ``Simulation.reset``."""
        self.simulation.reset()

    def close(self) -> None:
        """Close the simulation; see ``Simulation.close``."""
        self.simulation.close()


def _uncontrolled(model: Model) -> Model:
    stage = stage_model(model)
    if stage is None or not any(placed.model.controllers for placed in stage.walk()):
        return model
    return replace(model, content=_without_controllers(stage))


def _without_controllers(model: StageModel) -> StageModel:
    children = tuple(map(_without_controllers, model.children))
    return replace(model, controllers=(), children=children)
