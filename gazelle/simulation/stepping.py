"""Step the physics from one scheduled thing to the next."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from gazelle.simulation.clock import Schedule
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
    """Run all plugins that are due, in the order they were loaded."""
    for entry in tuple(plugins):
        if entry.schedule is not None and entry.plugin.active and entry.schedule.is_due(now_ns):
            entry.plugin.on_update(now)
            entry.schedule.done(now_ns)


def update_sensors(sensors: Iterable[SensorUnit], now_ns: int) -> None:
    """Measure with all sensors that are awake and due."""
    for sensor in tuple(sensors):
        if sensor.awake and sensor.schedule.is_due(now_ns):
            sensor.update(now_ns)
