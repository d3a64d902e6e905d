"""One running set of worlds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle import description, formats
from gazelle.description import Model, Pose, World
from gazelle.engines import make_engine
from gazelle.engines.tracer import Tracer, make_tracer
from gazelle.errors import SimulationError, did_you_mean
from gazelle.sensors import View, render
from gazelle.simulation import pacing, registry, saving
from gazelle.simulation.clock import Clock
from gazelle.simulation.plugin import ModelPlugin, SensorPlugin, WorldPlugin
from gazelle.simulation.requests import RequestQueue
from gazelle.simulation.robot import Named, Robot
from gazelle.simulation.sensors import SensorUnit
from gazelle.simulation.stepping import (
    ScheduledPlugin,
    make_scheduled,
    update_plugins,
    update_sensors,
)

Worlds = NDArray[np.intp]


class Simulation:
    """A world that runs, or many copies of it in step.

    Everything that changes the state from outside is done between two steps, also when it
    comes from another thread, and is true when the call returns.

    Args:
        world: A description, or a file or bundled name to load one from.
        engine: ``mujoco``.
        nworld: Number of copies.
        seed: Decides all random numbers; world i's do not depend on ``nworld``.
        threads: Native threads; all processors if None. Results do not depend on it.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.

    Raises:
        FormatError: The file cannot be read.
        EngineError: The world cannot be simulated.
    """

    def __init__(
        self,
        world: World | str | Path,
        engine: str = "mujoco",
        *,
        nworld: int = 1,
        seed: int = 0,
        threads: int | None = None,
        time_step: float | None = None,
    ) -> None:
        loaded = world if isinstance(world, World) else formats.load(world)
        self.engine = make_engine(engine, loaded, nworld, time_step=time_step, threads=threads)
        self.seed = seed
        self.clock = Clock(self.engine.time_step)
        self.requests = RequestQueue()
        self.plugins: list[ScheduledPlugin] = []
        self.paused = False
        self._robots: dict[str, Robot] = {}
        self._sensors: list[SensorUnit] = []
        self._closed = False
        self._tracer: tuple[World, Tracer] | None = None
        for plugin in loaded.plugins:
            self._load_world_plugin(plugin)
        for model in loaded.models:
            self._adopt(model, "")

    # -- what there is -----------------------------------------------------------------

    @property
    def world(self) -> World:
        """The world that runs, with what was spawned and without what was deleted."""
        return self.engine.world

    @property
    def nworld(self) -> int:
        """Number of copies."""
        return self.engine.nworld

    @property
    def robots(self) -> Mapping[str, Robot]:
        """All models by name, immovable ones too."""
        return Named("model", self._robots)

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.clock.now

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance by physics steps, also while paused.

        Raises:
            SimulationError: The simulation is closed, or ``count`` is negative.
            EngineError: The state became infinite.
        """
        if self._closed:
            raise SimulationError("the simulation is closed")
        if count < 0:
            raise SimulationError(f"cannot step {count} times; time goes forward only")
        with self.requests.owned():
            remaining = count
            while remaining > 0:
                self.requests.drain()
                remaining -= self._advance(remaining)

    def run(self, seconds: float, *, rate: float | None = None) -> None:
        """Advance by simulated time.

        Args:
            seconds: How long [s]; rounded to whole physics steps.
            rate: Real-time factor to keep to; None means as fast as possible.

        Raises:
            SimulationError: The simulation is paused or closed.
            EngineError: The state became infinite.
        """
        if self.paused:
            raise SimulationError("the simulation is paused", hint="call unpause(), or step()")
        pacing.run_paced(lambda piece: self.step(self.clock.steps_in(piece)), seconds, rate)

    def pause(self) -> None:
        """Let ``run`` refuse to run."""
        self.requests.call(lambda: setattr(self, "paused", True))

    def unpause(self) -> None:
        """Let ``run`` run again."""
        self.requests.call(lambda: setattr(self, "paused", False))

    def _advance(self, most: int) -> int:
        """Do what is due, then step to the next thing that will be; returns the steps made."""
        clock = self.clock
        update_plugins(self.plugins, clock.now_ns, clock.now)
        schedules = [unit.schedule for unit in self._sensors if unit.awake]
        schedules += [e.schedule for e in self.plugins if e.schedule and e.plugin.active]
        steps = min([most, *(schedule.steps_until(clock) for schedule in schedules)])
        self.engine.step(steps)
        clock.advance(steps)
        update_sensors(self._sensors, clock.now_ns)
        return steps

    # -- change ------------------------------------------------------------------------

    def spawn(
        self,
        model: Model | str | Path,
        name: str | None = None,
        pose: Pose | None = None,
        namespace: str = "",
    ) -> Robot:
        """Add a model to every world.

        Args:
            model: A description, or a file, directory, URI or bundled name to load one from.
            name: Its name in the world; the model's own if None.
            pose: Where; composed with the pose the model's file gives.
            namespace: Put before its topics.

        Raises:
            SimulationError: The name is taken, or a plugin refuses; nothing is changed.
            FormatError: The file cannot be read.
            EngineError: The model cannot be simulated.
        """
        loaded = model if isinstance(model, Model) else formats.load_model(model)
        placed = replace(loaded, name=name or loaded.name, pose=(pose or Pose()) * loaded.pose)
        return self.requests.call(lambda: self._spawn(placed, namespace))

    def delete(self, name: str) -> None:
        """Take a model out of every world, with its plugins.

        Raises:
            SimulationError: There is no such model.
        """
        self.requests.call(lambda: self._delete(name))

    def reset(self, worlds: ArrayLike | None = None) -> None:
        """Put everything back to its initial state.

        That is poses, velocities, commands, plugins, sensors and noise.

        Args:
            worlds: Indices or a mask of worlds; all if None, and then time goes back to
                zero and noise starts over. The clock of some worlds cannot: it is common.
        """
        chosen = self._worlds(worlds)
        self.requests.call(lambda: self._reset(chosen))

    def _spawn(self, model: Model, namespace: str) -> Robot:
        if model.name in self._robots:
            raise SimulationError(
                f"there is a model '{model.name}' already",
                source=model.source,
                hint="give the new one another name, or delete the old one",
            )
        self.engine.spawn(model)
        try:
            return self._adopt(model, namespace)
        except Exception:
            self._delete(model.name)
            raise

    def _delete(self, name: str) -> None:
        if name not in {model.name for model in self.engine.world.models}:
            raise SimulationError(
                f"there is no model '{name}'", hint=did_you_mean(name, self._robots)
            )
        self.plugins = [entry for entry in self.plugins if entry.owner != name]
        gone = self._robots.pop(name, None)
        self._sensors = [unit for unit in self._sensors if unit.robot is not gone]
        self.engine.delete(name)

    def _reset(self, worlds: Worlds | None) -> None:
        self.engine.reset(worlds)
        if worlds is None:
            self.clock.now_ns = 0
        for robot in self._robots.values():
            for port in robot.inputs.values():
                port.clear(worlds)
            for unit in robot.sensors.values():
                unit.reset(worlds)
        for entry in self.plugins:
            entry.plugin.reset(worlds)
            if worlds is None and entry.schedule is not None:
                entry.schedule.restart()

    def _worlds(self, worlds: ArrayLike | None) -> Worlds | None:
        if worlds is None:
            return None
        given = np.asarray(worlds)
        indices = np.flatnonzero(given) if given.dtype == np.bool_ else np.unique(given)
        if indices.size and (indices[0] < 0 or indices[-1] >= self.nworld):
            raise SimulationError(f"worlds must be in 0 to {self.nworld - 1}, not {worlds}")
        return indices.astype(np.intp)

    # -- plugins -----------------------------------------------------------------------

    def _adopt(self, model: Model, namespace: str) -> Robot:
        """Make the handle of a model that the engine has, and start its plugins."""
        robot = Robot(self, model, namespace)
        self._robots[model.name] = robot
        self._sensors.extend(robot.sensors.values())
        for placed in model.walk():
            for plugin in placed.model.plugins:
                self._load_model_plugin(robot, plugin)
        for unit in robot.sensors.values():
            for plugin in unit.description.plugins:
                found = registry.find(plugin)
                if found is not None and issubclass(found, SensorPlugin):
                    loaded = found()
                    loaded.load(unit, plugin.parameters)
                    self._keep(loaded, plugin, robot.name)
        return robot

    def _load_model_plugin(self, robot: Robot, plugin: description.Plugin) -> None:
        found = registry.find(plugin)
        if found is not None and issubclass(found, ModelPlugin):
            loaded = found()
            loaded.load(robot, plugin.parameters)
            self._keep(loaded, plugin, robot.name)

    def _load_world_plugin(self, plugin: description.Plugin) -> None:
        found = registry.find(plugin)
        if found is not None and issubclass(found, WorldPlugin):
            loaded = found()
            loaded.load(self, plugin.parameters)
            self._keep(loaded, plugin, "")

    def _keep(
        self,
        loaded: ModelPlugin | SensorPlugin | WorldPlugin,
        plugin: description.Plugin,
        owner: str,
    ) -> None:
        self.plugins.append(make_scheduled(loaded, plugin.name, owner))

    # -- seeing ------------------------------------------------------------------------

    def render(self, view: View, world: int = 0) -> NDArray[np.uint8]:
        """A picture of one world, shape (height, width, 3), made without a graphics card.

        Args:
            view: From where and how; ``gazelle.sensors.look_at`` helps.
            world: Which world.
        """
        if self._tracer is None or self._tracer[0] is not self.engine.world:
            self._tracer = (self.engine.world, make_tracer(self.engine.world))
        chosen = np.array([world])
        places = {name: self.engine.link_placement(name, chosen) for name in self.engine.link_names}
        tracer = self._tracer[1]
        tracer.place(
            {
                name: Pose.from_quaternion(tuple(p.position[0]), tuple(p.quaternion[0]))
                for name, p in places.items()
            }
        )
        return render(tracer, self.engine.world, view)

    # -- saving and ending -------------------------------------------------------------

    def snapshot(self) -> bytes:
        """The whole state of all worlds."""
        return self.requests.call(lambda: saving.snapshot(self))

    def restore(self, data: bytes) -> None:
        """Put back what ``snapshot`` gave; the models must be the same.

        Raises:
            SimulationError: The bytes are no snapshot of this simulation.
        """
        self.requests.call(lambda: saving.restore(self, data))

    def close(self) -> None:
        """Free the engine; a second call does nothing."""
        if not self._closed:
            self._closed = True
            self.engine.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
