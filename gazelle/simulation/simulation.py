"""The class `Simulation`: running worlds, their robots and time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle import formats
from gazelle.array_types import Worlds
from gazelle.description import Model, Plugin, Pose, World
from gazelle.engines import Engine, make_engine
from gazelle.engines.limits import NANOSECONDS, check_model
from gazelle.errors import SimulationError
from gazelle.rendering import LiveScene
from gazelle.sensors import View
from gazelle.simulation import inputs, pacing, saving
from gazelle.simulation.applied_wrenches import AppliedWrenches
from gazelle.simulation.clock import Clock
from gazelle.simulation.divergence import Fault, FaultLog
from gazelle.simulation.entities import EntityManager
from gazelle.simulation.events import Events
from gazelle.simulation.lights import with_light
from gazelle.simulation.links import LinkHandle
from gazelle.simulation.loading import load_world_plugin
from gazelle.simulation.mappings import Named
from gazelle.simulation.parameters import WorldParameters
from gazelle.simulation.physics import PhysicsProperties
from gazelle.simulation.ports import Ports
from gazelle.simulation.recording import Recorder, state_hash
from gazelle.simulation.robot import Robot
from gazelle.simulation.scene_renderer import SceneRenderer
from gazelle.simulation.scheduled_plugin import ScheduledPlugin
from gazelle.simulation.state_lock import StateLock
from gazelle.simulation.step_loop import CLOSED, StepLoop
from gazelle.simulation.step_plan import indices_of
from gazelle.streams import seed_of
from gazelle_ros.base.closing import Closeable

T = TypeVar("T")


class Simulation(Closeable):
    """A world that runs, or many copies of it in step.

    One thread at a time holds ``lock``: the one that steps, or that reads or changes something.
    Everything that is read or changed through this object, its robots and their links, joints,
    sensors and ports is read or changed between two steps, from whichever thread, and is true
    when the call returns. What else there is (``engine``, ``applied_wrenches``, models of sensors) is used
    with ``with sim.lock:``. A callback must not wait for another thread that uses the simulation.

    Args:
        world: A description, or a file or bundled name to load one from.
        engine: ``mujoco``.
        ground: Whether a robot or model gets ground and sun, see ``formats.open_world``.
        nworld: Number of copies.
        seed: Decides all random numbers; world i's do not depend on ``nworld``.
        threads: Native threads; all processors if None. Results do not depend on it.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.
        on_fault: Action when the state of a world becomes infinite: ``raise`` an error, or
            ``reset`` the world with a warning and continue. The other worlds make their steps
            either way, and the steps that broke it are written down for ``Replay``.
        fault_dump: File for that; a temporary one if None.
        namespace: Prefix of the topics in files, like the namespace of a ``gzserver`` node.

    Attributes:
        physics: Time step, gravity, solver and the like; settable in the middle of a run.
        parameters: Masses, friction and the like, which each world can have of its own.
        ports: Of the plugins of the world; those of models are on their ``Robot``.
        controls_in_step: Whether controllers act within the engine's steps, where it can.
        events: Emitted when models are spawned or deleted, and worlds reset.
        lock: On all of the state; hold it with ``with`` to do several things at one moment.
        entities, loop: Make and end models, and make the steps; for the thread that holds it.

    Raises:
        FormatError: The file cannot be read.
        EngineError: The world cannot be simulated.
    """

    def __init__(
        self,
        world: World | Model | str | Path,
        engine: str = "mujoco",
        *,
        ground: bool = True,
        nworld: int = 1,
        seed: int = 0,
        threads: int | None = None,
        time_step: float | None = None,
        on_fault: str = "raise",
        fault_dump: str | Path | None = None,
        namespace: str = "",
    ) -> None:
        loaded = formats.open_world(world, ground=ground)
        self._engine = make_engine(
            engine, loaded, nworld, time_step=time_step, threads=threads, late=True
        )
        self.lock = StateLock(self._engine.nworld)
        self.engine_name = engine
        self.controls_in_step = True
        self.seed, self.clock, self.paused = seed_of(seed), Clock(self._engine.time_step), False
        self.physics, self.parameters = PhysicsProperties(self), WorldParameters(self)
        self._applied_wrenches = AppliedWrenches(self._engine, self.clock)
        self.ports, self.events = Ports(self.lock, namespace), Events()
        self.entities = EntityManager(self)
        self._renderer, self.live_scene = SceneRenderer(), LiveScene(self._engine)
        self._faults = FaultLog(on_fault, fault_dump)
        self.loop = StepLoop(
            self, self._engine, self._applied_wrenches, self.entities, self._faults
        )
        with self.lock:
            for plugin in loaded.plugins:
                load_world_plugin(self, plugin)
            self.entities.make_handles(loaded.models)
        self._engine.prepare()

    @property
    def engine(self) -> Engine:
        """Engine of the world; for threads that hold ``lock``."""
        return self._engine

    @property
    def applied_wrenches(self) -> AppliedWrenches:
        """Forces that act for a time; likewise."""
        return self._applied_wrenches

    @property
    def world(self) -> World:
        """The simulated world, with spawned and without deleted models."""
        return self._engine.world

    @property
    def nworld(self) -> int:
        """Number of copies."""
        return self._engine.nworld

    @property
    def robots(self) -> Mapping[str, Robot]:
        """All models by name, immovable ones too."""
        return Named("model", self.entities.robots)

    @property
    def plugins(self) -> list[ScheduledPlugin]:
        """Plugins of the world and of all models."""
        return self.entities.plugins

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.clock.now

    def extension(self, kind: type[T]) -> T | None:
        """Return what a kind of world adds to a simulation; None if this one has no such thing.

        A world of Stage in the planar engine has a ``StageFleet``: all its robots as arrays.

        Args:
            kind: The class of the extension.
        """
        return self.entities.extension(kind)

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance by physics steps, also while paused.

        Raises:
            SimulationError: The simulation is closed, or ``count`` is not a number of steps.
            DivergenceError: The state of some worlds became infinite; see ``on_fault``.
        """
        self.loop.advance(inputs.steps(count), lambda: False)

    def run(self, seconds: float, *, rate: float | None = None) -> None:
        """Advance by simulated time, or until a pause.

        Args:
            seconds: Duration [s]; rounded to whole physics steps.
            rate: Real-time factor to keep to; None means as fast as possible.

        Raises:
            SimulationError: The simulation is paused or closed, or the duration is invalid.
            DivergenceError: As ``step``.
        """
        if self.paused:
            raise SimulationError("the simulation is paused", hint="call unpause(), or step()")
        count = self.clock.steps_in(inputs.duration(seconds))
        if rate is None:
            self.loop.advance(count, self._is_paused)
            return
        pacing.run_paced(
            lambda some: self.loop.advance(some, self._is_paused),
            count,
            self.clock.step_ns / NANOSECONDS,
            rate,
        )

    def _is_paused(self) -> bool:
        return self.paused

    def subscribe(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Call a function after every step, between two steps; returns what ends it."""
        with self.lock:
            return self.loop.listen(listener)

    def pause(self) -> None:
        """Make ``run`` fail until ``unpause``."""
        with self.lock:
            self.paused = True

    def unpause(self) -> None:
        """Allow ``run`` again."""
        with self.lock:
            self.paused = False

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
            pose: Initial pose; composed with the pose the model's file gives.
            namespace: Put before its topics.

        Raises:
            SimulationError: The name is taken, or it or the pose is invalid; nothing is changed.
            FormatError: The file cannot be read.
            EngineError: The model cannot be simulated.
        """
        if not isinstance(pose, Pose | None):
            raise SimulationError(
                f"a pose is a Pose, not {pose!r:.60}", hint="give Pose(x, y, z, roll, pitch, yaw)"
            )
        loaded = model if isinstance(model, Model) else formats.load_model(model)
        placed = replace(loaded, name=name or loaded.name, pose=(pose or Pose()) * loaded.pose)
        check_model(placed, SimulationError)
        with self.lock:
            return self.entities.spawn(placed, namespace)

    def load_plugin(self, filename: str) -> None:
        """Start a plugin that no file names, with empty parameters, for the whole simulation.

        One that cannot be loaded is left out with a warning.

        Args:
            filename: As files name plugins: ``package.module:Class``, or a library's name.
        """
        with self.lock:
            load_world_plugin(self, Plugin(filename, filename))

    def delete(self, name: str) -> None:
        """Delete a model from every world, with its plugins.

        Raises:
            SimulationError: There is no such model.
        """
        with self.lock:
            self.entities.delete(name)

    def reset(
        self, worlds: ArrayLike | None = None, *, seed: int | None = None, time: bool = True
    ) -> None:
        """Reset everything to its initial state.

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
        with self.lock:
            self.entities.reset(chosen, seed=given, time=time)

    def attach(
        self,
        parent: LinkHandle,
        child: LinkHandle,
        worlds: Worlds | None = None,
        *,
        settling: float | None = None,
    ) -> None:
        """Attach two links at their present relative pose, until ``detach`` or a reset.

        Args:
            parent: Link to attach to. If its model is only placed, it leads the other.
            child: Link to hold.
            worlds: Worlds; all if None.
            settling: Time constant with which they come together again [s], critically damped, as
                a soft weld of MuJoCo's; None for as stiff as can be.

        Raises:
            EngineError: Neither link moves, they are the same, or the time constant is invalid.
        """
        some = inputs.chosen(worlds, self.nworld)
        # A call without time constant is recorded as before, so that older recordings stay equal.
        softly = () if settling is None else (settling,)
        with self.lock:
            self.engine.attach(parent.name, child.name, some, *softly)

    def detach(self, parent: LinkHandle, child: LinkHandle, worlds: Worlds | None = None) -> None:
        """Detach two links that ``attach`` holds together.

        Raises:
            EngineError: They never were.
        """
        some = inputs.chosen(worlds, self.nworld)
        with self.lock:
            self.engine.detach(parent.name, child.name, some)

    def set_light(self, name: str, **changes: Any) -> None:
        """Set properties of a light of the world; the next picture shows it.

        Args:
            name: Of the light.
            changes: Fields of ``description.Light``, such as ``diffuse=(1, 0, 0, 1)``.

        Raises:
            SimulationError: There is no such light, or no such field.
        """
        with self.lock:
            self.engine.update_world(with_light(self.world, name, changes))

    # -- cameras -----------------------------------------------------------------------

    def render(self, view: View, world: int = 0) -> NDArray[np.uint8]:
        """Render one world without a graphics card, shape (height, width, 3).

        Args:
            view: From where and how; ``gazelle.sensors.look_at`` helps.
            world: World.
        """
        one = inputs.one_world(world, self.nworld)
        with self.lock:
            return self._renderer.picture(self, view, one)

    # -- saving and ending -------------------------------------------------------------

    def snapshot(self) -> bytes:
        """Return the whole state of all worlds."""
        with self.lock:
            return saving.snapshot(self)

    def restore(self, data: bytes) -> None:
        """Restore what ``snapshot`` returned; the models must be the same.

        Raises:
            SimulationError: The bytes are no snapshot of this simulation.
        """
        with self.lock:
            saving.restore(self, data)

    def state_hash(self, worlds: ArrayLike | None = None) -> str:
        """Return a hash of the physical state.

        It compares to the bit: the same run gives the same after every step.

        Args:
            worlds: Worlds; all if None. That of one world does not depend on the others.
        """
        rows = slice(None) if worlds is None else indices_of(worlds, self.nworld)
        with self.lock:
            return state_hash(self.engine.peek()[rows])

    def record(self, path: str | Path) -> Recorder:
        """Write the run down from now on, until the recorder is closed; see ``Replay``.

        Use it with ``with``: ``with sim.record("run.jsonl"): sim.run(seconds=10.0)``.
        """
        with self.lock:
            return Recorder(self, path)

    @property
    def faults(self) -> Sequence[Fault]:
        """Reports of all worlds that diverged so far."""
        return tuple(self._faults.faults)

    def close(self) -> None:
        """Free the engine, between two steps if another thread steps; a second call does nothing.

        That thread, and all that wait for an answer, get a ``SimulationError``, and so does what
        is requested from now on.
        """
        if self.lock.closed:
            return
        try:
            with self.lock:
                self._close()
        except SimulationError:
            if not self.lock.closed:  # another thread may have closed it
                raise

    def _close(self) -> None:
        if not self.lock.closed:
            self.lock.close(CLOSED)
            self._engine.close()
