"""Plugins of one kind of many robots, updated together."""

from __future__ import annotations

from collections.abc import Sequence

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
    """Plugins of one kind that are due together, updated by one system without Python.

    Args:
        entries: The plugins, in the order they were loaded; they share one schedule.
        acts: What is updated in their place.
        nworld: Number of worlds.
    """

    def __init__(
        self, entries: Sequence[ScheduledPlugin], acts: System | BasePlugin, nworld: int
    ) -> None:
        self._entries, self._acts, self._nworld = entries, acts, nworld
        self.schedule = share_schedule(entries)

    def system(self) -> System | None:
        """What is updated in the plugins' place, if that is a system."""
        return self._acts if isinstance(self._acts, System) else None

    def release(self) -> None:
        """Give each plugin a schedule of its own."""
        part_schedule(self._entries, self.schedule)

    def from_python(self) -> ScheduledPlugin:
        """What is updated in the plugins' place where Python has a say in it."""
        first, acts = self._entries[0], self._acts
        if isinstance(acts, System):
            acts = _Brought(acts, self._nworld)
        plugin = _ActingGroup(self._entries, acts)
        return ScheduledPlugin(
            plugin, first.name, first.owner, self.schedule, group=tuple(self._entries)
        )

    @property
    def is_heard(self) -> bool:
        """Whether somebody listens to one of the plugins."""
        return any(entry.is_heard() for entry in self._entries)


class _Brought(BasePlugin):
    """A system that Python brings to the time."""

    def __init__(self, system: System, nworld: int) -> None:
        self._system, self._rows = system, nworld * system.rows

    def on_update(self, time: float) -> None:
        """Update all rows."""
        self._system.bring(0, self._rows, round(time * NANOSECONDS))


class _ActingGroup(BasePlugin):
    """Updates plugins at once, measures at once what is heard of them, and publishes it.

    Args:
        entries: The plugins.
        acts: Does the work of all.
    """

    def __init__(self, entries: Sequence[ScheduledPlugin], acts: BasePlugin) -> None:
        self._entries, self._acts = entries, acts
        self._heard = [entry for entry in entries if entry.is_heard()]
        self._failed = False

    @property
    def active(self) -> bool:
        """Whether there is something to do or to publish."""
        return bool(self._heard) or self._failed or self._acts.active

    def on_update(self, time: float) -> None:
        """Act and publish."""
        if not self._failed:
            try:
                self._acts.on_update(time)
            except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
                self._part(error)
        if self._failed:
            # Each by itself, so that it is seen whose fault it is.
            for entry in self._entries:
                entry.update(time)
        elif self._heard:
            publish_together(self._heard)

    def _part(self, error: Exception) -> None:
        """Let each be updated by itself from now on."""
        _warn(self._entries, "when updated with others, and all are updated alone", error)
        self._failed = True
        for entry in self._entries:
            entry.alone = True
            if entry.requests is not None:
                entry.requests.changes += 1


def with_groups(
    entries: Sequence[ScheduledPlugin], nworld: int, *, native: bool
) -> tuple[list[ScheduledPlugin | PluginGroup], list[PluginGroup]]:
    """Plugins, those of one kind in the place of the first of them, and all groups.

    Args:
        entries: Plugins, in the order they were loaded.
        nworld: Number of worlds.
        native: Whether the engine updates systems.
    """
    groups = list[PluginGroup]()
    places: list[tuple[list[ScheduledPlugin], ScheduledPlugin | PluginGroup]] = []
    for some in of_one_kind([each for each in entries if not each.plugin.only_publishes], due_with):
        acts = _together(some)
        if acts is not None:
            group = PluginGroup(some, acts, nworld)
            groups.append(group)
            python = not native or group.system() is None or group.is_heard
            places.append((some, group.from_python() if python else group))
    return with_replacements(entries, places), groups


def _together(entries: Sequence[ScheduledPlugin]) -> System | BasePlugin | None:
    """What acts for plugins of one kind; None, with a warning, if they cannot make it."""
    try:
        return type(entries[0].plugin).together([entry.plugin for entry in entries])
    except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
        _warn(entries, "in together(), and is updated alone", error)
        return None


def _warn(entries: Sequence[ScheduledPlugin], when: str, error: Exception) -> None:
    name = title(entries[0].name, entries[0].owner)
    warn_of_fault(entries[0].plugin, name, when, error)
