"""One running set of worlds."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle import formats
from gazelle.array_types import Worlds
from gazelle.description import Model, Plugin, Pose, World
from gazelle.engines import DivergenceError, make_engine
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean
from gazelle.sensors import View
from gazelle.simulation import inputs, pacing, saving
from gazelle.simulation.clock import Clock
from gazelle.simulation.events import Events
from gazelle.simulation.faults import Fault, FaultLog
from gazelle.simulation.handles import LinkHandle
from gazelle.simulation.lights import with_light
from gazelle.simulation.loading import adopt, load_world_plugin
from gazelle.simulation.loads import Loads
from gazelle.simulation.parameters import WorldParameters
from gazelle.simulation.physics import PhysicsProperties
from gazelle.simulation.ports import Ports
from gazelle.simulation.recording import Recorder, state_hash
from gazelle.simulation.requests import RequestQueue
from gazelle.simulation.robot import Named, Robot
from gazelle.simulation.seeing import Eye
from gazelle.simulation.sensors import SensorUnit
from gazelle.simulation.stepping import (
    ScheduledPlugin,
    indices_of,
    steps_to_next,
    update_plugins,
    update_sensors,
)
from gazelle.streams import seed_of


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
        on_fault: What to do when the state of a world becomes infinite: ``raise`` an error, or
            ``reset`` the world with a warning and go on. The other worlds make their steps
            either way, and the steps that broke it are written down for ``Replay``.
        fault_dump: File for that; a temporary one if None.

    Attributes:
        physics: Time step, gravity, solver and the like; settable in the middle of a run.
        parameters: Masses, friction and the like, which each world can have of its own.
        ports: Of the plugins of the world; those of models are on their ``Robot``.
        events: Tell who must follow what is spawned, deleted and reset.

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
        on_fault: str = "raise",
        fault_dump: str | Path | None = None,
    ) -> None:
        loaded = world if isinstance(world, World) else formats.load(world)
        self.engine = make_engine(engine, loaded, nworld, time_step=time_step, threads=threads)
        self.engine_name = engine
        self.seed = seed_of(seed)
        self.clock = Clock(self.engine.time_step)
        self.requests = RequestQueue()
        self.plugins: list[ScheduledPlugin] = []
        self.paused = False
        self.physics, self.parameters = PhysicsProperties(self), WorldParameters(self)
        self.loads = Loads(self.engine, self.clock)
        self.ports, self.events = Ports(), Events()
        self._robots: dict[str, Robot] = {}
        self._sensors: list[SensorUnit] = []
        self._closed = False
        self._eye = Eye()
        self._faults = FaultLog(on_fault, fault_dump)
        for plugin in loaded.plugins:
            load_world_plugin(self, plugin)
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
            SimulationError: The simulation is closed, or ``count`` is no number of steps.
            DivergenceError: The state of some worlds became infinite; see ``on_fault``.
        """
        self._walk(inputs.steps(count), lambda: False)

    def run(self, seconds: float, *, rate: float | None = None) -> None:
        """Advance by simulated time, or until somebody pauses the simulation.

        Args:
            seconds: How long [s]; rounded to whole physics steps.
            rate: Real-time factor to keep to; None means as fast as possible.

        Raises:
            SimulationError: The simulation is paused or closed, or the time cannot be.
            DivergenceError: As ``step``.
        """
        if self.paused:
            raise SimulationError("the simulation is paused", hint="call unpause(), or step()")
        pacing.run_paced(
            lambda piece: self._walk(self.clock.steps_in(piece), lambda: self.paused),
            inputs.duration(seconds),
            rate,
        )

    def pause(self) -> None:
        """Let ``run`` refuse to run."""
        self.requests.call(lambda: setattr(self, "paused", True))

    def unpause(self) -> None:
        """Let ``run`` run again."""
        self.requests.call(lambda: setattr(self, "paused", False))

    def _walk(self, count: int, stop: Callable[[], bool]) -> None:
        """Make steps, and what others ask for between two of them."""
        if self._closed:
            raise SimulationError("the simulation is closed")
        with self.requests.lock:
            remaining = count
            try:
                while remaining > 0:
                    self.requests.drain()
                    if stop():
                        return
                    remaining -= self._advance(remaining)
                self.requests.drain()
            finally:
                self.events.rested.tell()

    def _advance(self, most: int) -> int:
        """Do what is due, then step to the next thing that will be; returns the steps made."""
        clock = self.clock
        update_plugins(self.plugins, clock.now_ns, clock.now)
        if self.loads.any:
            self.loads.update(clock.now_ns)
        steps = steps_to_next(self.plugins, self._sensors, clock, most)
        if self.loads.any:
            steps = min(steps, self.loads.steps_until(clock) or steps)
        fault: DivergenceError | None = None
        try:
            self.engine.step(steps)
        except DivergenceError as error:
            fault = error
        before = clock.now_ns
        clock.advance(steps)
        if fault is not None:
            self._give_up(fault, before)
        update_sensors(self._sensors, clock.now_ns)
        return steps

    def _give_up(self, error: DivergenceError, before_ns: int) -> None:
        """Start worlds over that broke down, as ``on_fault`` says."""
        text = self._faults.note(self, error, before_ns)
        self._reset(error.worlds)
        if self._faults.policy == "raise":
            raise DivergenceError(text, error.worlds, error.before, error.steps) from error
        warnings.warn(SimulationWarning(text), stacklevel=5)

    # -- change ------------------------------------------------------------------------

    def spawn(
        self,
        model: Model | str | Path,
        name: str | None = None,
        pose: Pose | None = None,
        namespace: str = "",
    ) -> Robot:
        """Add a model to every world.

        A plugin that cannot be loaded is left out with a ``PluginWarning``.

        Args:
            model: A description, or a file, directory, URI or bundled name to load one from.
            name: Its name in the world; the model's own if None.
            pose: Where; composed with the pose the model's file gives.
            namespace: Put before its topics.

        Raises:
            SimulationError: The name is taken, or it or the pose cannot be; nothing is changed.
            FormatError: The file cannot be read.
            EngineError: The model cannot be simulated.
        """
        loaded = model if isinstance(model, Model) else formats.load_model(model)
        placed = replace(loaded, name=name or loaded.name, pose=(pose or Pose()) * loaded.pose)
        whole = inputs.placeable(placed)
        return self.requests.call(lambda: self._spawn(whole, namespace))

    def load_plugin(self, filename: str) -> None:
        """Start a plugin that no file names, with empty parameters, for the whole simulation.

        One that cannot be loaded is left out with a warning.

        Args:
            filename: As files name plugins: ``package.module:Class``, or a library's name.
        """
        self.requests.call(lambda: load_world_plugin(self, Plugin(filename, filename)))

    def delete(self, name: str) -> None:
        """Take a model out of every world, with its plugins.

        Raises:
            SimulationError: There is no such model.
        """
        self.requests.call(lambda: self._delete(name))

    def reset(
        self, worlds: ArrayLike | None = None, *, seed: int | None = None, time: bool = True
    ) -> None:
        """Put everything back to its initial state.

        That is poses, velocities, forces, attachments, commands, plugins, sensors and noise.
        What ``physics`` and ``parameters`` hold stays.

        Args:
            worlds: Indices or a mask of worlds; all if None, and then time goes back to
                zero and noise starts over. The clock of some worlds cannot: it is common.
            seed: Draw all random numbers from this seed from now on; as before if None.
            time: Whether the clock goes back to zero when all worlds are reset.
        """
        chosen = indices_of(worlds, self.nworld)
        given = None if seed is None else seed_of(seed)
        self.requests.call(lambda: self._reset(chosen, seed=given, time=time))

    def attach(self, parent: LinkHandle, child: LinkHandle, worlds: Worlds | None = None) -> None:
        """Hold two links together as they are to each other now, until ``detach`` or a reset.

        Raises:
            EngineError: Neither link moves, or they are the same.
        """
        some = inputs.chosen(worlds, self.nworld)
        self.requests.call(lambda: self.engine.attach(parent.name, child.name, some))

    def detach(self, parent: LinkHandle, child: LinkHandle, worlds: Worlds | None = None) -> None:
        """Let go two links that ``attach`` holds together.

        Raises:
            EngineError: They never were.
        """
        some = inputs.chosen(worlds, self.nworld)
        self.requests.call(lambda: self.engine.detach(parent.name, child.name, some))

    def set_light(self, name: str, **changes: Any) -> None:
        """Change a light of the world; the next picture shows it.

        Args:
            name: Of the light.
            changes: Fields of ``description.Light``, such as ``diffuse=(1, 0, 0, 1)``.

        Raises:
            SimulationError: There is no such light, or no such field.
        """
        self.requests.call(lambda: self.engine.update_world(with_light(self.world, name, changes)))

    def _spawn(self, model: Model, namespace: str) -> Robot:
        if model.name in self._robots:
            raise SimulationError(
                f"there is a model '{model.name}' already",
                source=model.source,
                hint="give the new one another name, or delete the old one",
            )
        self.engine.spawn(model)
        try:
            robot = self._adopt(model, namespace)
        except Exception:
            self._delete(model.name)
            raise
        self.events.spawned.tell(robot)
        return robot

    def _delete(self, name: str) -> None:
        if name not in {model.name for model in self.engine.world.models}:
            raise SimulationError(
                f"there is no model '{name}'", hint=did_you_mean(name, self._robots)
            )
        self.plugins = [entry for entry in self.plugins if entry.owner != name]
        gone = self._robots.pop(name, None)
        self._sensors = [unit for unit in self._sensors if unit.robot is not gone]
        self.loads.forget(name)
        self.parameters.pose.forget(name)
        self.engine.delete(name)
        if gone is not None:
            self.events.deleted.tell(gone)

    def _reset(self, worlds: Worlds | None, *, seed: int | None = None, time: bool = True) -> None:
        self.engine.reset(worlds)
        self.loads.reset(worlds)
        if seed is not None:
            self._reseed(seed, worlds)
        self.parameters.pose.apply(worlds)
        rewind = worlds is None and time
        if rewind:
            self.clock.now_ns = 0
        for ports in (self.ports, *self._robots.values()):
            for port in ports.inputs.values():
                port.clear(worlds)
            for output in ports.outputs.values():
                output.forget()
        for unit in self._sensors:
            unit.reset(worlds)
        for entry in self.plugins:
            entry.reset(worlds)
            if rewind and entry.schedule is not None:
                entry.schedule.restart()
        self.events.reset.tell(worlds, rewind)

    def _reseed(self, seed: int, worlds: Worlds | None) -> None:
        if worlds is None:
            self.seed = seed
        self.parameters.reseed(seed, worlds)
        for unit in self._sensors:
            unit.reseed(seed, worlds)
        for entry in self.plugins:
            entry.reseed(seed, worlds)

    def _adopt(self, model: Model, namespace: str) -> Robot:
        """Make the handle of a model that the engine has, and start its plugins."""
        robot = Robot(self, model, namespace)
        self._robots[model.name] = robot
        self._sensors.extend(robot.sensors.values())
        adopt(self, model, robot)
        return robot

    # -- seeing ------------------------------------------------------------------------

    def render(self, view: View, world: int = 0) -> NDArray[np.uint8]:
        """A picture of one world, shape (height, width, 3), made without a graphics card.

        Args:
            view: From where and how; ``gazelle.sensors.look_at`` helps.
            world: Which world.
        """
        return self._eye.see(self, view, world)

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

    def state_hash(self, worlds: ArrayLike | None = None) -> str:
        """A hash of the physical state, to the bit: the same run gives the same after every step.

        Args:
            worlds: Which worlds; all if None. That of one world does not depend on the others.
        """
        rows = slice(None) if worlds is None else indices_of(worlds, self.nworld)
        return self.requests.call(lambda: state_hash(self.engine.peek()[rows]))

    def record(self, path: str | Path) -> Recorder:
        """Write the run down from now on, until the recorder is closed; see ``Replay``.

        Use it with ``with``: ``with sim.record("run.jsonl"): sim.run(seconds=10.0)``.
        """
        return self.requests.call(lambda: Recorder(self, path))

    @property
    def faults(self) -> Sequence[Fault]:
        """All worlds that broke down so far."""
        return tuple(self._faults.faults)

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
