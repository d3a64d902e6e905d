"""Plugins of one kind of many robots, updated together."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.engines import SystemEngine
from gazelle.native.system import System
from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.clock import NANOSECONDS
from gazelle.simulation.grouping import of_one_kind, with_replacements
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.scheduled_plugin import (
    ScheduledPlugin,
    due_with,
    part_schedule,
    publish_together,
    share_schedule,
    title,
)


class PluginGroup:
    """Plugins of one kind that are due together, updated by one system.

    Where somebody listens to one of them, ``publishing`` stands in their place.

    Args:
        entries: The plugins, in the order they were loaded; they share one schedule.
        system: What is updated in their place.
    """

    def __init__(self, entries: Sequence[ScheduledPlugin], system: System) -> None:
        self._entries, self._system = entries, system
        self.schedule = share_schedule(entries)

    def system(self) -> System:
        """What is updated in the plugins' place."""
        return self._system

    def release(self) -> None:
        """Give each plugin a schedule of its own."""
        part_schedule(self._entries, self.schedule)

    def publishing(self, nworld: int) -> ScheduledPlugin | None:
        """What updates the system and then publishes, from Python; None if nobody listens."""
        if not any(entry.is_heard() for entry in self._entries):
            return None
        first = self._entries[0]
        plugin = _PublishingGroup(self._entries, self._system, nworld)
        return ScheduledPlugin(plugin, first.name, first.owner, self.schedule)


class _PublishingGroup(BasePlugin):
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
        if heard:
            publish_together(heard)


def with_groups(
    entries: Sequence[ScheduledPlugin], engine: SystemEngine
) -> tuple[list[ScheduledPlugin | PluginGroup], list[PluginGroup]]:
    """Plugins, those of one kind in the place of the first of them, and all groups."""
    groups = list[PluginGroup]()
    places: list[tuple[list[ScheduledPlugin], ScheduledPlugin | PluginGroup]] = []
    for some in of_one_kind(entries, due_with):
        system = _together(some)
        if system is not None:
            groups.append(PluginGroup(some, system))
            places.append((some, groups[-1].publishing(engine.nworld) or groups[-1]))
    return with_replacements(entries, places), groups


def _together(entries: Sequence[ScheduledPlugin]) -> System | None:
    """One system for plugins; None, with a warning, if they cannot make it."""
    plugin = entries[0].plugin
    try:
        return type(plugin).together([entry.plugin for entry in entries])
    except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
        name = title(entries[0].name, entries[0].owner)
        warn_of_fault(plugin, name, "in together(), and is updated alone", error)
        return None
