"""Step the physics from one scheduled thing to the next."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.native.system import System
from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.inputs import chosen
from gazelle.simulation.plugin_groups import with_groups
from gazelle.simulation.publisher_groups import group_publishers
from gazelle.simulation.scheduled_plugin import ScheduledPlugin
from gazelle.simulation.sensor_groups import PythonGroup, group_sensors
from gazelle.simulation.sensors import SampledSensor


class StepPlan:
    """Who is asked and updated between steps, until somebody subscribes or models come or go.

    Args:
        plugins: All, in the order they were loaded.
        sensors: All.
        nworld: Number of worlds.
        native: Whether the engine updates systems.
        followed: Whether Python measures sensors all the same.

    Attributes:
        plugins: What is updated in turn, groups in the place of their first plugin; those that
            rest are left out.
        sensors: What is measured from Python: those awake, groups in the place of their first.
        groups: Of sensors that systems measure.
        settled: The systems and schedules of all plugins where Python has a say in none; else None.
        late: Plugins that steps may carry: they come after the others, carried or not.
        early: The others.
    """

    def __init__(
        self,
        plugins: Iterable[ScheduledPlugin],
        sensors: Iterable[SampledSensor],
        nworld: int,
        *,
        native: bool = False,
        followed: bool = False,
    ) -> None:
        awake = [unit for unit in sensors if unit.awake]
        # Sensors first: asking for their kind may change the engine.
        self.sensors, self.groups = group_sensors(awake, native=native and not followed)
        entries, self._publishers = group_publishers([each for each in plugins if not each.rests])
        grouped, self._plugin_groups = with_groups(entries, nworld, native=native)
        self.plugins = grouped
        alone = [each for each in grouped if isinstance(each, ScheduledPlugin)]
        self.late = [entry for entry in alone if entry.may_be_carried]
        self.early = [entry for entry in alone if not entry.may_be_carried]
        self.settled: tuple[list[System], list[Schedule]] | None = None
        if native and not alone:
            self.settled = with_systems(self.plugins)[:2]

    def release(self) -> None:
        """Let everything be updated by itself again."""
        for each in self._plugin_groups:
            each.release()
        for publisher in self._publishers:
            publisher.release()
        for group in self.groups:
            group.release()
        for unit in self.sensors:
            if isinstance(unit, PythonGroup):
                unit.release()


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


def update_sensors(sensors: Iterable[SampledSensor | PythonGroup], now_ns: int) -> None:
    """Measure with all sensors that are awake and due."""
    for sensor in tuple(sensors):
        if now_ns >= sensor.schedule.due_ns and sensor.awake:
            sensor.update(now_ns)


def steps_to_next(
    plugins: Iterable[ScheduledPlugin],
    sensors: Iterable[SampledSensor | PythonGroup],
    clock: Clock,
    most: int,
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
