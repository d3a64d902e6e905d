"""Order of updates between physics steps, and the number of steps to the next one."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.native.system import System
from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.inputs import chosen, is_ascending
from gazelle.simulation.scheduled_plugin import ScheduledPlugin
from gazelle.simulation.scheduled_systems import ScheduledSystem, make_systems
from gazelle.simulation.sensor_groups import SensorGroup, group_sensors
from gazelle.simulation.sensors import SampledSensor


class StepPlan:
    """Update order between steps; rebuilt when subscriptions or models change.

    Args:
        plugins: All, in the order they were loaded.
        sensors: All.
        nworld: Number of worlds.
        followed: Whether Python measures sensors all the same.

    Attributes:
        plugins: Plugins to update in order, groups in the place of their first plugin; inactive
            rest are left out.
        sensors: Active sensors measured from Python, groups in the place of their first.
        groups: Of sensors that systems measure.
        settled: The systems and schedules of all plugins where Python has a say in none; else None.
        late: Plugins that may run within steps: they come after the others in any case.
        early: The others.
    """

    def __init__(
        self,
        plugins: Iterable[ScheduledPlugin],
        sensors: Iterable[SampledSensor],
        nworld: int,
        *,
        followed: bool = False,
    ) -> None:
        awake = [unit for unit in sensors if unit.awake]
        # Sensors first: grouping them may change the engine.
        self.sensors, self.groups = group_sensors(awake, native=not followed)
        due = [each for each in plugins if each.schedule is not None]
        self.plugins = make_systems(due, nworld)
        made = [each for each in self.plugins if isinstance(each, ScheduledSystem)]
        self.late = [each for each in made if each.may_act_in_step]
        late = set(map(id, self.late))
        self.early = [each for each in self.plugins if id(each) not in late]
        self.settled: tuple[list[System], list[Schedule]] | None = None
        systems, schedules, others = with_kernels(self.plugins)
        self.settled = None if others else (systems, schedules)

    def release(self) -> None:
        """Update everything individually again."""
        for each in self.plugins:
            if isinstance(each, ScheduledSystem):
                each.release()
        for group in self.groups:
            group.release()
        for unit in self.sensors:
            if isinstance(unit, SensorGroup):
                unit.release()


Scheduled = ScheduledPlugin | ScheduledSystem


def with_kernels(
    plugins: Iterable[Scheduled],
) -> tuple[list[System], list[Schedule], list[Scheduled]]:
    """Return the kernels that engines update in place of systems, their schedules, and all else."""
    kernels: list[System] = []
    schedules: list[Schedule] = []
    others: list[Scheduled] = []
    for each in plugins:
        kernel = each.kernel if isinstance(each, ScheduledSystem) else None
        if kernel is None or each.schedule is None:
            others.append(each)
            continue
        kernels.append(kernel)
        schedules.append(each.schedule)
    set_due(kernels, schedules)
    return kernels, schedules, others


def set_due(systems: Iterable[System], schedules: Iterable[Schedule]) -> None:
    """Set the due times of systems to those of their schedules."""
    for system, schedule in zip(systems, schedules, strict=True):
        system.rate, system.due = schedule.rate, schedule.due_ns


def update_plugins(plugins: Iterable[Scheduled], clock: Clock) -> None:
    """Run all plugins and systems that are due, in the order in which they were loaded."""
    for each in tuple(plugins):
        each.update(clock)


def update_sensors(sensors: Iterable[SampledSensor | SensorGroup], now_ns: int) -> None:
    """Measure with all sensors that are awake and due."""
    for sensor in tuple(sensors):
        if now_ns >= sensor.schedule.due_ns and sensor.awake:
            sensor.update(now_ns)


def steps_to_next(
    plugins: Iterable[Scheduled],
    sensors: Iterable[SampledSensor | SensorGroup],
    clock: Clock,
    most: int,
) -> int:
    """Return the physics steps until something is due, ``most`` at most."""
    soonest = clock.now_ns + most * clock.step_ns
    for each in plugins:
        schedule = each.schedule
        if schedule is None or schedule.due_ns >= soonest:
            continue
        if each.is_active(clock):
            soonest = schedule.due_ns
    for sensor in sensors:
        if sensor.schedule.due_ns < soonest and sensor.awake:
            soonest = sensor.schedule.due_ns
    return clock.steps_to(soonest)


def indices_of(worlds: ArrayLike | None, nworld: int) -> NDArray[np.intp] | None:
    """Return sorted, unique indices of worlds, given as indices or a mask; None stays None.

    Raises:
        SimulationError: There is no such world.
    """
    if worlds is None:
        return None
    some = chosen(worlds, nworld)
    if some is None or is_ascending(some):
        return some
    return np.unique(some)
