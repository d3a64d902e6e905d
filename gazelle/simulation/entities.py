"""The models of a running simulation, with their sensors and plugins."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from gazelle.array_types import Worlds
from gazelle.description import Model
from gazelle.errors import SimulationError, did_you_mean
from gazelle.simulation.loading import is_plain, start_plugins
from gazelle.simulation.mappings import LazyItems
from gazelle.simulation.robot import Robot, RobotHost, SensorUnit
from gazelle.simulation.scheduled_plugin import ScheduledPlugin
from gazelle.simulation.world_kinds import WorldKind, find_world_kind

T = TypeVar("T")


class EntityManager:
    """Makes, resets and ends what lives in a simulation; its methods are called by the owner.

    Args:
        simulation: The owner.

    Attributes:
        robots: All models by name.
        sensors: Of all models.
        plugins: Of the world and of all models, in the order they were loaded.
    """

    def __init__(self, simulation: RobotHost) -> None:
        self._simulation = simulation
        self.robots: LazyItems[Robot] = LazyItems(self._make)
        self._awaited: dict[str, Model] = {}
        self._kinds: dict[str, WorldKind | None] = {"": None}
        self.sensors: list[SensorUnit] = []
        self.plugins: list[ScheduledPlugin] = []

    def spawn(self, model: Model, namespace: str) -> Robot:
        """Add a model to every world; on failure no part of it remains."""
        if model.name in self.robots:
            raise SimulationError(
                f"there is a model '{model.name}' already",
                source=model.source,
                hint="give the new one another name, or delete the old one",
            )
        self._simulation.engine.spawn(model)
        try:
            robot = self.make_handle(model, namespace)
        except Exception:
            self.delete(model.name)
            raise
        self._simulation.events.spawned.emit(robot)
        return robot

    def extension(self, kind: type[T]) -> T | None:
        """Return what a kind of world adds to the simulation, by its class; None without."""
        found = (each.extension for each in self._kinds.values() if each is not None)
        return next((each for each in found if isinstance(each, kind)), None)

    def make_handles(self, models: Sequence[Model]) -> None:
        """Make the handles of models in the engine, and start their plugins.

        Those that a kind of world runs without a plugin can wait until their handle is needed.
        All handles are made before the first plugin is started: plugins ask the engine for motors
        and the like, which it compiles all together at the next access.
        """
        self._start_kinds(models)
        made = []
        for model in models:
            kind = self._kinds[model.kind]
            if kind is not None and is_plain(model, kind):
                self._awaited[model.name] = model
                self.robots.register_lazily(model.name)
            else:
                made.append((model, self._handle(model, "")))
        for model, robot in made:
            start_plugins(self._simulation, model, robot, self._kinds[model.kind])

    def make_handle(self, model: Model, namespace: str) -> Robot:
        """Make the handle of a model in the engine, and start its plugins."""
        self._start_kinds((model,))
        robot = self._handle(model, namespace)
        start_plugins(self._simulation, model, robot, self._kinds[model.kind])
        return robot

    def _handle(self, model: Model, namespace: str) -> Robot:
        kind = self._kinds[model.kind]
        sensors = None if kind is None else kind.sensors(model)
        robot = Robot(self._simulation, model, namespace, sensors)
        self.robots[model.name] = robot
        self.sensors.extend(robot.sensors.values())
        self._simulation.lock.changes += 1
        return robot

    def _start_kinds(self, models: Sequence[Model]) -> None:
        """Start what runs the world and models in a way of their own, if the engine can."""
        for name in (self._simulation.world.kind, *(model.kind for model in models)):
            if name not in self._kinds:
                start = find_world_kind(name)
                self._kinds[name] = None if start is None else start(self._simulation)

    def _make(self, name: str) -> Robot:
        """Make the handle of a model that was deferred."""
        with self._simulation.lock:
            model = self._awaited.pop(name, None)
            return self.robots[name] if model is None else self.make_handle(model, "")

    def delete(self, name: str) -> None:
        """Delete a model from every world, with its plugins.

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
        simulation.applied_wrenches.forget(name)
        simulation.parameters.pose.forget(name)
        simulation.engine.delete(name)
        if gone is not None:
            simulation.events.deleted.emit(gone)

    def reset(self, worlds: Worlds | None, *, seed: int | None = None, time: bool = True) -> None:
        """Reset everything to its initial state; see ``Simulation.reset``."""
        simulation = self._simulation
        simulation.engine.reset(worlds)
        simulation.applied_wrenches.reset(worlds)
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
        simulation.events.reset.emit(worlds, rewind)

    def _reseed(self, seed: int, worlds: Worlds | None) -> None:
        if worlds is None:
            self._simulation.seed = seed
        self._simulation.parameters.reseed(seed, worlds)
        for unit in self.sensors:
            unit.reseed(seed, worlds)
        for entry in self.plugins:
            entry.reseed(seed, worlds)
