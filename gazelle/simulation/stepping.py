"""Step the physics from one scheduled thing to the next."""

from __future__ import annotations

import traceback
import warnings
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.errors import SimulationError, SimulationWarning
from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.plugin import Plugin
from gazelle.simulation.sensors import SensorUnit


@dataclass(slots=True)
class ScheduledPlugin:
    """A loaded plugin, what it is on, and when it is due; no schedule means never."""

    plugin: Plugin
    name: str
    owner: str
    schedule: Schedule | None


def make_scheduled(plugin: Plugin, name: str, owner: str) -> ScheduledPlugin:
    """A plugin with the schedule it asks for, once it is loaded."""
    schedule = None if plugin.update_rate is None else Schedule(plugin.update_rate)
    return ScheduledPlugin(plugin, name, owner, schedule)


def update_plugins(plugins: Iterable[ScheduledPlugin], now_ns: int, now: float) -> None:
    """Run all plugins that are due, in the order they were loaded.

    One that raises is detached with a warning: it is never updated again, and all else goes on.
    """
    for entry in tuple(plugins):
        schedule = entry.schedule
        if schedule is None or now_ns < schedule.due_ns or not entry.plugin.active:
            continue
        try:
            entry.plugin.on_update(now)
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            _detach(entry, error, now)
            continue
        schedule.done(now_ns)


def _detach(entry: ScheduledPlugin, error: Exception, now: float) -> None:
    entry.schedule = None
    warn_of_fault(f"plugin '{entry.name}'", entry.owner, f"at {now:g} s and is detached", error)


def warn_of_fault(what: str, owner: str, when: str, error: Exception) -> None:
    """Name a plugin that failed, and the line where it did."""
    last = traceback.extract_tb(error.__traceback__)[-1]
    whose = f" of '{owner}'" if owner else ""
    warnings.warn(
        SimulationWarning(
            f"{what}{whose} failed {when}: {type(error).__name__}: {error} "
            f"({last.filename}:{last.lineno})"
        ),
        stacklevel=6,
    )


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
        if schedule is not None and schedule.due_ns < soonest and entry.plugin.active:
            soonest = schedule.due_ns
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
    given = np.asarray(worlds)
    indices = np.flatnonzero(given) if given.dtype == np.bool_ else np.unique(given)
    if indices.size and (indices[0] < 0 or indices[-1] >= nworld):
        raise SimulationError(f"worlds must be in 0 to {nworld - 1}, not {worlds}")
    return indices.astype(np.intp)
