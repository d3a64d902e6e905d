"""Step the physics from one scheduled thing to the next."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.native.system import System
from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.inputs import chosen
from gazelle.simulation.plugin import Plugin
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.sensors import SensorUnit

T = TypeVar("T")


@dataclass(slots=True)
class ScheduledPlugin:
    """A loaded plugin, what it is on, and when it is due; no schedule means never.

    One that raises is detached with a warning: it is never asked again, and all else goes on.
    """

    plugin: Plugin
    name: str
    owner: str
    schedule: Schedule | None
    detached: bool = False

    def detach(self, error: Exception, when: str) -> None:
        """Go on without it."""
        self.schedule, self.detached = None, True
        warn_of_fault(self.plugin, title(self.name, self.owner), f"{when} and is detached", error)

    def system(self) -> System | None:
        """What is updated in its place now."""
        return self._ask(self.plugin.system, "when asked for its system")

    def reset(self, worlds: NDArray[np.intp] | None) -> None:
        """Let it begin anew."""
        self._ask(lambda: self.plugin.reset(worlds), "at a reset")

    def reseed(self, seed: int, worlds: NDArray[np.intp] | None) -> None:
        """Let it use other random numbers."""
        self._ask(lambda: self.plugin.reseed(seed, worlds), "at a reset with a seed")

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Everything that changes in it."""
        return self._ask(self.plugin.state, "at a snapshot") or {}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._ask(lambda: self.plugin.restore(state), "while restoring a snapshot")

    def _ask(self, work: Callable[[], T], when: str) -> T | None:
        if self.detached:
            return None
        try:
            return work()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self.detach(error, when)
            return None


def title(name: str, owner: str) -> str:
    """A plugin by the name that its file gives it, and the model that it is on."""
    return f"plugin '{name}' of '{owner}'" if owner else f"plugin '{name}'"


def make_scheduled(plugin: Plugin, name: str, owner: str) -> ScheduledPlugin:
    """A plugin with the schedule it asks for, once it is loaded."""
    schedule = None if plugin.update_rate is None else Schedule(plugin.update_rate)
    return ScheduledPlugin(plugin, name, owner, schedule)


def with_systems(
    plugins: Iterable[ScheduledPlugin],
) -> tuple[list[System], list[Schedule], list[ScheduledPlugin]]:
    """The systems that are updated in place of plugins, their schedules, and the other plugins."""
    systems: list[System] = []
    schedules: list[Schedule] = []
    others: list[ScheduledPlugin] = []
    for entry in plugins:
        schedule = entry.schedule
        system = None if schedule is None else entry.system()
        if schedule is None or system is None:
            others.append(entry)
            continue
        system.rate, system.due = schedule.rate, schedule.due_ns
        systems.append(system)
        schedules.append(schedule)
    return systems, schedules, others


def update_plugins(plugins: Iterable[ScheduledPlugin], clock: Clock) -> None:
    """Run all plugins that are due, in the order they were loaded."""
    now_ns = clock.now_ns
    for entry in tuple(plugins):
        schedule = entry.schedule
        if schedule is None or now_ns < schedule.due_ns:
            continue
        try:
            if not entry.plugin.active:
                continue
            entry.plugin.on_update(clock.now)
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            entry.detach(error, f"at {clock.now:g} s")
            continue
        schedule.done(now_ns)


def update_sensors(sensors: Iterable[SensorUnit], now_ns: int) -> None:
    """Measure with all sensors that are awake and due."""
    for sensor in tuple(sensors):
        if now_ns >= sensor.schedule.due_ns and sensor.awake:
            sensor.update(now_ns)


def steps_to_next(
    plugins: Iterable[ScheduledPlugin], sensors: Iterable[SensorUnit], clock: Clock, most: int
) -> int:
    """Physics steps until something is due, ``most`` at most."""
    soonest = clock.now_ns + most * clock.step_ns
    for entry in plugins:
        schedule = entry.schedule
        if schedule is None or schedule.due_ns >= soonest:
            continue
        try:
            if entry.plugin.active:
                soonest = schedule.due_ns
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            entry.detach(error, f"at {clock.now:g} s")
    for sensor in sensors:
        if sensor.schedule.due_ns < soonest and sensor.awake:
            soonest = sensor.schedule.due_ns
    return clock.steps_to(soonest)


def indices_of(worlds: ArrayLike | None, nworld: int) -> NDArray[np.intp] | None:
    """Indices or a mask of worlds as sorted, unique indices; None stays None.

    Raises:
        SimulationError: There is no such world.
    """
    if worlds is None:
        return None
    return np.unique(np.asarray(chosen(worlds, nworld)))
