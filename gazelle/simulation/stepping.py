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
        if entry.schedule is not None and entry.plugin.active and entry.schedule.is_due(now_ns):
            try:
                entry.plugin.on_update(now)
            except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
                _detach(entry, error, now)
                continue
            entry.schedule.done(now_ns)


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
        if sensor.awake and sensor.schedule.is_due(now_ns):
            sensor.update(now_ns)


def steps_to_next(
    plugins: Iterable[ScheduledPlugin], sensors: Iterable[SensorUnit], clock: Clock, most: int
) -> int:
    """Physics steps until something is due, ``most`` at most."""
    steps = most
    for entry in plugins:
        if entry.schedule is not None and entry.plugin.active:
            steps = min(steps, entry.schedule.steps_until(clock))
    for sensor in sensors:
        if sensor.awake:
            steps = min(steps, sensor.schedule.steps_until(clock))
    return steps


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
