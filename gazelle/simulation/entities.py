"""The models of a running simulation, with their sensors and plugins."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from gazelle.array_types import Worlds
from gazelle.description import Model
from gazelle.errors import SimulationError, did_you_mean
from gazelle.simulation.loading import adopt, is_plain, run_stage
from gazelle.simulation.robot import Robot, RobotHost, SensorUnit
from gazelle.simulation.robots import MadeOnDemand
from gazelle.simulation.scheduled_plugin import ScheduledPlugin

if TYPE_CHECKING:
    from gazelle.simulation.stage.fleet import StageFleet


class EntityManager:
    """Makes, resets and ends what lives in a simulation; its methods are called by the owner.

    Args:
        simulation: Whose.

    Attributes:
        robots: All models by name.
        sensors: Of all models.
        plugins: Of the world and of all models, in the order they were loaded.
    """

    def __init__(self, simulation: RobotHost) -> None:
        self._simulation = simulation
        self.robots: MadeOnDemand[Robot] = MadeOnDemand(self._make)
        self._awaited: dict[str, Model] = {}
        self._stage: StageFleet | None = None
        self.sensors: list[SensorUnit] = []
        self.plugins: list[ScheduledPlugin] = []

    def spawn(self, model: Model, namespace: str) -> Robot:
        """Add a model to every world; what cannot be added leaves nothing behind."""
        if model.name in self.robots:
            raise SimulationError(
                f"there is a model '{model.name}' already",
                source=model.source,
                hint="give the new one another name, or delete the old one",
            )
        self._simulation.engine.spawn(model)
        try:
            robot = self.adopt(model, namespace)
        except Exception:
            self.delete(model.name)
            raise
        self._simulation.events.spawned.tell(robot)
        return robot

    @property
    def stage(self) -> StageFleet | None:
        """All robots of Stage files, as arrays; None without."""
        return self._stage

    def adopt_all(self, models: Sequence[Model]) -> None:
        """Make the handles of models that the engine has, and start their plugins.

        Those of Stage files are run all together, so that a handle can wait until it is needed.
        All handles are made before the first plugin is started: plugins ask the engine for motors
        and the like, which it compiles all together when it is next asked for what it has.
        """
        self._look_for_stage(models)
        made = []
        for model in models:
            if self._stage is not None and is_plain(model):
                self._awaited[model.name] = model
                self.robots.put_off(model.name)
            else:
                made.append((model, self._handle(model, "")))
        for model, robot in made:
            adopt(self._simulation, model, robot, self._stage_of(model))

    def adopt(self, model: Model, namespace: str) -> Robot:
        """Make the handle of a model that the engine has, and start its plugins."""
        self._look_for_stage((model,))
        robot = self._handle(model, namespace)
        adopt(self._simulation, model, robot, self._stage_of(model))
        return robot

    def _handle(self, model: Model, namespace: str) -> Robot:
        robot = Robot(self._simulation, model, namespace, self._stage_of(model))
        self.robots[model.name] = robot
        self.sensors.extend(robot.sensors.values())
        self._simulation.lock.changes += 1
        return robot

    def _stage_of(self, model: Model) -> StageFleet | None:
        return self._stage if model.stage is not None else None

    def _look_for_stage(self, models: Sequence[Model]) -> None:
        """Run models of Stage files as Stage does, if the engine can."""
        simulation = self._simulation
        of_stage = simulation.world.stage is not None
        if self._stage is None and (of_stage or any(m.stage is not None for m in models)):
            self._stage = run_stage(simulation)

    def _make(self, name: str) -> Robot:
        """Make the handle of a model that was put off."""
        with self._simulation.lock:
            model = self._awaited.pop(name, None)
            return self.robots[name] if model is None else self.adopt(model, "")

    def delete(self, name: str) -> None:
        """Take a model out of every world, with its plugins.

        Raises:
            SimulationError: There is no such model.
        """
        simulation = self._simulation
        simulation.lock.changes += 1
        if name not in {model.name for model in simulation.engine.world.models}:
            raise SimulationError(
                f"there is no model '{name}'", hint=did_you_mean(name, self.robots)
            )
        self.plugins[:] = [entry for entry in self.plugins if entry.owner != name]
        gone = self.robots.pop(name, None)
        self._awaited.pop(name, None)
        for unit in gone.sensors.values() if gone is not None else ():
            unit.retire()
        self.sensors[:] = [unit for unit in self.sensors if unit.robot is not gone]
        simulation.loads.forget(name)
        simulation.parameters.pose.forget(name)
        simulation.engine.delete(name)
        if gone is not None:
            simulation.events.deleted.tell(gone)

    def reset(self, worlds: Worlds | None, *, seed: int | None = None, time: bool = True) -> None:
        """Put everything back to its initial state; see ``Simulation.reset``."""
        simulation = self._simulation
        simulation.engine.reset(worlds)
        simulation.loads.reset(worlds)
        if seed is not None:
            self._reseed(seed, worlds)
        simulation.parameters.pose.apply(worlds)
        rewind = worlds is None and time
        if rewind:
            simulation.clock.now_ns = 0
        for ports in (simulation.ports, *self.robots.made()):
            for port in ports.inputs.values():
                port.clear(worlds)
            for output in ports.outputs.values():
                output.forget()
        for unit in self.sensors:
            unit.reset(worlds)
        for entry in self.plugins:
            entry.reset(worlds)
            if rewind and entry.schedule is not None:
                entry.schedule.restart()
        simulation.events.reset.tell(worlds, rewind)

    def _reseed(self, seed: int, worlds: Worlds | None) -> None:
        if worlds is None:
            self._simulation.seed = seed
        self._simulation.parameters.reseed(seed, worlds)
        for unit in self.sensors:
            unit.reseed(seed, worlds)
        for entry in self.plugins:
            entry.reseed(seed, worlds)
