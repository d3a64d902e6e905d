"""Step the physics from one scheduled thing to the next."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.native.joint_system import JointSystem
from gazelle.native.system import System
from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.inputs import chosen
from gazelle.simulation.plugin import Plugin
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.requests import RequestQueue
from gazelle.simulation.sensors import SensorGroup, SensorUnit

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
    requests: RequestQueue | None = None
    detached: bool = False

    def detach(self, error: Exception, when: str) -> None:
        """Go on without it."""
        self.schedule, self.detached = None, True
        if self.requests is not None:
            self.requests.changes += 1
        warn_of_fault(self.plugin, title(self.name, self.owner), f"{when} and is detached", error)

    def system(self) -> System | None:
        """What is updated in its place now."""
        return self._ask(self.plugin.system, "when asked for its system")

    @property
    def rests(self) -> bool:
        """Whether it has no update until somebody subscribes, or models come or go."""
        plugin = self.plugin
        if self.schedule is None:
            return True
        return plugin.only_publishes and self._ask(lambda: not plugin.active, "when asked") is True

    def carried(self) -> tuple[JointSystem, float] | None:
        """What does its work within steps, and until when [ns]."""
        return self._ask(self.plugin.carried, "when asked for its system")

    def catch_up(self) -> None:
        """Steps were made with it."""
        self._ask(self.plugin.catch_up, "after steps")

    @property
    def may_be_carried(self) -> bool:
        """Whether it is worth asking."""
        return type(self.plugin).carried is not Plugin.carried

    def kind(self) -> Hashable | None:
        """What it has in common with those that are updated together with it."""
        return self._ask(self.plugin.kind, "when asked for its kind")

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


def make_scheduled(
    plugin: Plugin, name: str, owner: str, requests: RequestQueue | None = None
) -> ScheduledPlugin:
    """A plugin with the schedule it asks for, once it is loaded."""
    schedule = None if plugin.update_rate is None else Schedule(plugin.update_rate)
    return ScheduledPlugin(plugin, name, owner, schedule, requests)


class PluginGroup:
    """Plugins of one kind that are due together, updated by one system.

    Args:
        entries: The plugins, in the order they were loaded; they share one schedule.
        system: What is updated in their place.
    """

    def __init__(self, entries: Sequence[ScheduledPlugin], system: System) -> None:
        self._entries, self._system = entries, system
        self.schedule: Schedule | None = (entries[0].schedule or Schedule(0.0)).copy()
        for entry in entries:
            entry.schedule = self.schedule

    def system(self) -> System:
        """What is updated in the plugins' place."""
        return self._system

    def release(self) -> None:
        """Give each plugin a schedule of its own."""
        for entry in self._entries:
            if entry.schedule is self.schedule and self.schedule is not None:
                entry.schedule = self.schedule.copy()


class StepPlan:
    """Who is asked and updated between steps, until somebody subscribes or models come or go.

    Args:
        plugins: All, in the order they were loaded.
        sensors: All.
        native: Whether the engine updates systems.
        alone: Whether sensors are measured from Python all the same.

    Attributes:
        plugins: What is updated in turn, groups in the place of their first plugin; those that
            rest are left out.
        sensors: What is measured from Python: those awake that are in no group.
        groups: Of sensors.
        settled: The systems and schedules of all plugins where Python has a say in none; else None.
        late: Plugins that steps may carry: they come after the others, carried or not.
        early: The others.
    """

    def __init__(
        self,
        plugins: Iterable[ScheduledPlugin],
        sensors: Iterable[SensorUnit],
        *,
        native: bool,
        alone: bool = False,
    ) -> None:
        self.sensors = [unit for unit in sensors if unit.awake]
        self.groups: list[SensorGroup] = []
        if native and not alone:  # sensors first: asking for their kind may change the engine
            self._group_sensors()
        entries = [each for each in plugins if not each.rests]
        self.late = [entry for entry in entries if entry.may_be_carried]
        self.early = [entry for entry in entries if not entry.may_be_carried]
        self.plugins: list[ScheduledPlugin | PluginGroup] = [*entries]
        if native:
            self.plugins = _with_groups(entries)
        self.settled: tuple[list[System], list[Schedule]] | None = None
        if native and all(isinstance(each, PluginGroup) for each in self.plugins):
            self.settled = with_systems(self.plugins)[:2]

    def release(self) -> None:
        """Let everything be updated by itself again."""
        for each in self.plugins:
            if isinstance(each, PluginGroup):
                each.release()
        for group in self.groups:
            group.release()

    def _group_sensors(self) -> None:
        kinds: dict[Hashable, list[SensorUnit]] = {}
        for unit in self.sensors:
            kind = unit.kind()
            if kind is not None:
                kinds.setdefault(kind, []).append(unit)
        self.groups = [SensorGroup(units) for units in kinds.values()]
        grouped = {id(unit) for group in self.groups for unit in group.units}
        self.sensors = [unit for unit in self.sensors if id(unit) not in grouped]


def _with_groups(entries: Sequence[ScheduledPlugin]) -> list[ScheduledPlugin | PluginGroup]:
    """Plugins, those of one kind as a group in the place of the first of them."""
    kinds: dict[Hashable, list[ScheduledPlugin]] = {}
    for entry in entries:
        kind = entry.kind()
        if kind is not None and entry.schedule is not None:
            kinds.setdefault((type(entry.plugin), kind, *_due(entry.schedule)), []).append(entry)
    first: dict[int, PluginGroup] = {}
    others: set[int] = set()
    for some in kinds.values():
        system = _together(some)
        if system is not None:
            first[id(some[0])] = PluginGroup(some, system)
            others.update(id(entry) for entry in some[1:])
    return [first.get(id(entry), entry) for entry in entries if id(entry) not in others]


def _together(entries: Sequence[ScheduledPlugin]) -> System | None:
    """One system for plugins; None, with a warning, if they cannot make it."""
    plugin = entries[0].plugin
    try:
        return type(plugin).together([entry.plugin for entry in entries])
    except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
        name = title(entries[0].name, entries[0].owner)
        warn_of_fault(plugin, name, "in together(), and is updated alone", error)
        return None


def _due(schedule: Schedule) -> tuple[float, int]:
    return schedule.rate, schedule.due_ns


class Updated(Protocol):
    """What may be updated by a system."""

    @property
    def schedule(self) -> Schedule | None:
        """When it is due; None for never."""

    def system(self) -> System | None:
        """What is updated in its place now."""


E = TypeVar("E", bound=Updated)


def with_systems(
    plugins: Iterable[E],
) -> tuple[list[System], list[Schedule], list[E]]:
    """The systems that are updated in place of plugins, their schedules, and the other plugins."""
    systems: list[System] = []
    schedules: list[Schedule] = []
    others: list[E] = []
    for entry in plugins:
        schedule = entry.schedule
        system = None if schedule is None else entry.system()
        if schedule is None or system is None:
            others.append(entry)
            continue
        systems.append(system)
        schedules.append(schedule)
    set_due(systems, schedules)
    return systems, schedules, others


def set_due(systems: Iterable[System], schedules: Iterable[Schedule]) -> None:
    """Let systems be due when their schedules say."""
    for system, schedule in zip(systems, schedules, strict=True):
        system.rate, system.due = schedule.rate, schedule.due_ns


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
    some = chosen(worlds, nworld)
    if some is None or len(some) < 2 or (some[1:] > some[:-1]).all():
        return some
    return np.unique(some)
