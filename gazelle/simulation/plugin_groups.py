"""Plugins of one kind of many robots, updated together."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from gazelle.engines import SystemEngine
from gazelle.native.system import System
from gazelle.simulation.base_plugin import Plugin
from gazelle.simulation.clock import NANOSECONDS, Schedule
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.scheduled_plugin import ScheduledPlugin, title


class PluginGroup:
    """Plugins of one kind that are due together, updated by one system.

    Where somebody listens to one of them, ``publishing`` stands in their place.

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

    def publishing(self, nworld: int) -> ScheduledPlugin | None:
        """What updates the system and then publishes, from Python; None if nobody listens."""
        if not any(entry.is_heard() for entry in self._entries):
            return None
        first = self._entries[0]
        plugin = _PublishingGroup(self._entries, self._system, nworld)
        return ScheduledPlugin(plugin, first.name, first.owner, self.schedule)


class _PublishingGroup(Plugin):
    """Updates plugins by one system, measures at once what is heard of them, and publishes it.

    Args:
        entries: The plugins.
        system: Has a row for each of them in each world.
        nworld: Number of worlds.
    """

    def __init__(self, entries: Sequence[ScheduledPlugin], system: System, nworld: int) -> None:
        self._entries, self._system, self._nworld = entries, system, nworld

    def on_update(self, time: float) -> None:
        """Act and publish."""
        self._system.bring(0, self._nworld * self._system.rows, round(time * NANOSECONDS))
        heard = [entry for entry in self._entries if entry.is_heard()]
        if not heard:
            return
        plugins = [entry.plugin for entry in heard]
        try:
            measured = type(plugins[0]).measure_together(plugins)
        except Exception:  # noqa: BLE001  each measures by itself, so that it is seen whose fault it is
            measured = [None] * len(plugins)
        for entry, value in zip(heard, measured, strict=True):
            entry.publish_measured(value)


def with_groups(
    entries: Sequence[ScheduledPlugin], engine: SystemEngine
) -> tuple[list[ScheduledPlugin | PluginGroup], list[PluginGroup]]:
    """Plugins, those of one kind in the place of the first of them, and all groups."""
    kinds: dict[Hashable, list[ScheduledPlugin]] = {}
    for entry in entries:
        kind = entry.kind()
        if kind is not None and entry.schedule is not None:
            kinds.setdefault((type(entry.plugin), kind, *_due(entry.schedule)), []).append(entry)
    first: dict[int, ScheduledPlugin | PluginGroup] = {}
    others, groups = set[int](), list[PluginGroup]()
    for some in kinds.values():
        system = _together(some)
        if system is not None:
            group = PluginGroup(some, system)
            groups.append(group)
            first[id(some[0])] = group.publishing(engine.nworld) or group
            others.update(id(entry) for entry in some[1:])
    return [first.get(id(entry), entry) for entry in entries if id(entry) not in others], groups


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
