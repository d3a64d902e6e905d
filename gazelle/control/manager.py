"""Loads, starts, stops and updates the controllers of a robot."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import world_indices
from gazelle.array_types import Worlds
from gazelle.control import registry
from gazelle.control.control_law import ControlLaw
from gazelle.control.controller import Controller, ControllerSetup
from gazelle.control.hardware import RobotHardware
from gazelle.control.loaded_controllers import LoadedControllers
from gazelle.control.parameters import ControllerParameters
from gazelle.control.ports import Serializer
from gazelle.control.switching import LoadedController, Switch, planned
from gazelle.description import Model
from gazelle.errors import ControlError, ControlWarning, did_you_mean
from gazelle_ros.base.argument_types import MOST_INT

R = TypeVar("R")

BASE_CLASS: Final = "controller_interface::ControllerBase"
"""Of all types, as list_controller_types says."""


class Strictness(IntEnum):
    """Treatment of requests that a switch cannot meet (controller_manager_msgs)."""

    BEST_EFFORT = 1
    STRICT = 2


class ControllerManager:
    """The controllers of one robot, as ros_control's controller_manager keeps them.

    Its methods may be called from any thread; what they do is done between two updates. A switch is
    made before the call returns, unless the robot itself needs time for it (``Switch``), also while
    nothing steps.

    Args:
        hardware: The robot.
        parameters: Of controllers by name, as YAML gives them; each has a ``type``.
        model: The robot as its URDF describes it; None if unknown.
        call: Does work between two updates; a lock of its own if None.
        namespace: Of the robot; before all topics that are relative.
        measure: Called before controllers start: reads the robot once more, and returns the time now
            [ns]. None for one that is read all the time; what was read last is true enough then.
        sync: Called before the time is looked at, where native code updates controllers: calls
            ``catch_up`` if anything is new.

    Attributes:
        hardware: The robot.
        namespace: Of the robot.
        parameters: As given. A bridge may set ``find_parameters`` instead.
        find_parameters: Returns the parameters of a controller that is loaded by name alone;
            None for one that has none.
    """

    def __init__(
        self,
        hardware: RobotHardware,
        parameters: Mapping[str, Any] | None = None,
        *,
        model: Model | None = None,
        call: Serializer | None = None,
        namespace: str = "",
        measure: Callable[[], int] | None = None,
        sync: Callable[[], None] = lambda: None,
    ) -> None:
        self.hardware, self.model, self.namespace = hardware, model, namespace
        self.parameters: dict[str, Any] = dict(parameters or {})
        self.find_parameters: Callable[[str], Mapping[str, Any] | None] = self.parameters.get
        self._lock = threading.RLock()
        self.call: Serializer = call or self._locked
        self._loaded = LoadedControllers()
        self._watchers: list[tuple[Callable[[Controller], None], Callable[[Controller], None]]] = []
        self._switch: Switch | None = None
        self._measure, self._sync = measure, sync
        self._now_ns = 0

    def _locked(self, work: Callable[[], R]) -> R:
        with self._lock:
            return work()

    # -- what services offer -----------------------------------------------------------

    def load(self, name: str, parameters: Mapping[str, Any] | None = None) -> Controller:
        """Load a controller; it does not run yet.

        Args:
            name: Its name.
            parameters: With its ``type``; what ``find_parameters`` knows if None.

        Raises:
            ControlError: The name is taken, there is no type or none of that name, the robot lacks
                an interface or a joint, or the parameters is invalid. Nothing stays behind.
        """
        return self.call(lambda: self._load(name, parameters))

    def unload(self, name: str) -> None:
        """Unload a controller.

        Raises:
            ControlError: There is none of that name, or it is running.
        """
        self.call(lambda: self._unload(name))

    def switch(
        self,
        start: Sequence[str] = (),
        stop: Sequence[str] = (),
        strictness: int = Strictness.STRICT,
        *,
        start_asap: bool = False,
        timeout: float = 0.0,
    ) -> Switch:
        """Stop controllers and start others, at one moment.

        Args:
            start: Names.
            stop: Names.
            strictness: ``STRICT``: all or nothing; ``BEST_EFFORT``: names that are unknown, running
                or stopped already are passed over. 0 is ``BEST_EFFORT`` with a warning.
            start_asap: Start each controller as soon as its joints have switched.
            timeout: Longest time for that, on the updates' clock [s]; 0 for no limit.

        Returns:
            The switch: done already, unless the robot needs time.

        Raises:
            ControlError: It is invalid; nothing is changed.
        """
        return self.call(
            lambda: self._begin_switch(
                tuple(start), tuple(stop), strictness, timeout, asap=start_asap
            )
        )

    def start(self, *names: str) -> None:
        """Start controllers; ``STRICT``."""
        self.switch(start=names)

    def stop(self, *names: str) -> None:
        """Stop controllers; ``STRICT``."""
        self.switch(stop=names)

    @property
    def loaded(self) -> list[LoadedController]:
        """All that are loaded, in that order."""
        return self.call(lambda: [*self._loaded.values()])

    def types(self) -> list[str]:
        """Return the types that can be loaded; the base class of each is ``BASE_CLASS``."""
        return registry.types()

    def reload(self, *, force_kill: bool = False) -> bool:
        """Read libraries of controllers again: none is left loaded.

        Args:
            force_kill: Stop and unload what is loaded.

        Returns:
            Whether it was done: not while something is loaded, unless forced.
        """
        return self.call(lambda: self._reload(force_kill=force_kill))

    @property
    def busy(self) -> bool:
        """True if a controller runs, or is to be started; for the thread that updates."""
        return self._switch is not None or bool(self._loaded.running)

    def __getitem__(self, name: str) -> Controller:
        """Return a loaded controller.

        Raises:
            ControlError: There is none of that name.
        """
        return self._loaded[name].controller

    def __contains__(self, name: object) -> bool:
        return name in self._loaded

    def state_of(self, name: str) -> str:
        """Return ``initialized``, ``running``, ``stopped``, ``waiting`` or ``aborted``.

        Raises:
            ControlError: There is none of that name.
        """
        return self._loaded[name].state

    def watch(
        self, loaded: Callable[[Controller], None], unloaded: Callable[[Controller], None]
    ) -> Callable[[], None]:
        """Call functions for loaded controllers, at once for present ones, and for unloaded ones.

        Functions are called by the thread that loads. Returns what ends it.
        """
        entry = (loaded, unloaded)

        def begin() -> None:
            self._watchers.append(entry)
            for each in self._loaded.values():
                loaded(each.controller)

        self.call(begin)
        return lambda: self._watchers.remove(entry)

    # -- the loop ----------------------------------------------------------------------

    @property
    def now_ns(self) -> int:
        """Time of the last update [ns]."""
        self._sync()
        return self._now_ns

    @now_ns.setter
    def now_ns(self, time: int) -> None:
        if not 0 <= time <= MOST_INT:
            raise ControlError(f"a time must be from 0 to 2^63 - 1 ns, not {time!r:.60}")
        self._now_ns = time

    def update(self, now_ns: int, period: float, *, restart: Worlds | None = None) -> None:
        """Update all running controllers; for the thread that owns the robot.

        Args:
            now_ns: Time [ns].
            period: Since the last update [s].
            restart: Worlds in which what runs starts again first, as after an emergency stop.
        """
        self.now_ns = now_ns
        if restart is not None:
            restart = world_indices(restart, self.hardware.nworld, ControlError)
        self._loaded.control(now_ns, period, restart)
        if self._switch is not None:
            self._go_on(self._switch)

    def laws(self) -> list[ControlLaw] | None:
        """Return the native laws of running controllers, in order; None if Python has to update one."""
        return None if self._switch is not None else self._loaded.laws()

    def wake_ns(self) -> float:
        """Return the time [ns] at which ``update`` must be called although all is native code."""
        return self._loaded.wake_ns()

    @property
    def deferrable(self) -> bool:
        """True if ``catch_up`` may be delayed until something is read; see ``Controller.deferrable``."""
        return self._loaded.deferrable

    def catch_up(self, now_ns: int, updates: int, period: float) -> None:
        """Update the state after native updates.

        Args:
            now_ns: The last time [ns].
            updates: Number of updates.
            period: Of an update [s].
        """
        self.now_ns = now_ns
        self._loaded.catch_up(now_ns, updates, period)

    def reset(self, worlds: Worlds | None) -> None:
        """Reset the controllers in these worlds; all if None."""
        self._loaded.reset(self.now_ns, worlds)

    def states(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state of controllers, for a snapshot."""
        return self._loaded.states()

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``states`` returned; controllers loaded since stay as they are."""
        self._loaded.restore(self.now_ns, state)

    # -- one thing at a time -----------------------------------------------------------

    def _load(self, name: str, given: Mapping[str, Any] | None) -> Controller:
        if name in self._loaded:
            raise ControlError(
                f"a controller named '{name}' was already loaded inside the controller manager"
            )
        found = self.find_parameters(name) if given is None else given
        parameters = ControllerParameters(found or {}, name)
        if not isinstance(parameters.get("type"), str):
            raise ControlError(
                f"could not load controller '{name}' because the type was not specified",
                hint="load its configuration first: a namespace of its name with a 'type'",
            )
        controller = registry.make(
            ControllerSetup(
                name, parameters.text("type"), self.hardware, self.model, self.call, self._sync
            )
        )
        for interface in controller.interfaces:
            self.hardware.interface(interface)
        try:
            controller.init(parameters)
        except ControlError as error:
            raise ControlError(
                f"initializing controller '{name}' failed: {error.message}", hint=error.hint
            ) from error
        except Exception as error:
            raise ControlError(f"initializing controller '{name}' failed: {error}") from error
        controller.now_ns = self.now_ns
        self._loaded[name] = LoadedController(controller)
        for loaded, _ in tuple(self._watchers):
            loaded(controller)
        return controller

    def _unload(self, name: str) -> None:
        entry = self._loaded.get(name)
        if entry is None:
            raise ControlError(
                f"could not unload controller with name '{name}' because no controller with this "
                "name exists",
                hint=did_you_mean(name, self._loaded),
            )
        if entry.controller.running or entry.state == "waiting":
            raise ControlError(
                f"could not unload controller with name '{name}' because it is still running"
            )
        del self._loaded[name]
        for _, unloaded in tuple(self._watchers):
            unloaded(entry.controller)

    def _reload(self, *, force_kill: bool) -> bool:
        if self._loaded and not force_kill:
            return False
        running = [name for name, each in self._loaded.items() if each.controller.running]
        if running:
            self._begin_switch((), tuple(running), Strictness.BEST_EFFORT)
        for name in [*self._loaded]:
            self._unload(name)
        return True

    # -- switching ---------------------------------------------------------------------

    def _begin_switch(
        self,
        start: tuple[str, ...],
        stop: tuple[str, ...],
        strictness: int,
        timeout: float = 0.0,
        *,
        asap: bool = False,
    ) -> Switch:
        if self._switch is not None:
            raise ControlError("another controller switch is in progress")
        if strictness not in (Strictness.BEST_EFFORT, Strictness.STRICT):
            text = f"strictness {strictness} is not known; it is taken as BEST_EFFORT (1)"
            warnings.warn(ControlWarning(text), stacklevel=4)
            strictness = Strictness.BEST_EFFORT
        starting, stopping = planned(
            self._loaded, start, stop, strict=strictness == Strictness.STRICT
        )
        infos = (
            [self._loaded[name].info for name in starting],
            [self._loaded[name].info for name in stopping],
        )
        if not self.hardware.prepare_switch(*infos):
            raise ControlError(
                "could not switch controllers: the hardware interface combination for the requested "
                "controllers is unfeasible"
            )
        if starting and self._measure is not None:
            self.now_ns = self._measure()
        switch = Switch(tuple(starting), tuple(stopping), asap, timeout, self.now_ns)
        if starting or stopping:
            self.hardware.do_switch(*infos)
            for name in stopping:
                self._stop(self._loaded[name])
        self._go_on(switch)
        return switch

    def _go_on(self, switch: Switch) -> None:
        """Start the controllers that are ready."""
        self._switch = switch
        entries = [self._loaded[name] for name in switch.start]
        switch.advance(self.hardware, entries, self.now_ns, self._start)
        if switch.done:
            self._switch = None

    def _start(self, entry: LoadedController) -> None:
        controller = entry.controller
        controller.now_ns = self.now_ns
        controller.starting(self.now_ns * 1e-9)
        controller.running, entry.state = True, "running"

    def _stop(self, entry: LoadedController) -> None:
        controller = entry.controller
        controller.running, entry.state = False, "stopped"
        controller.stopping(self.now_ns * 1e-9)
