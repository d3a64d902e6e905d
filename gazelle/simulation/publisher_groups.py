"""Plugins of one kind that only publish, of many robots: measured at once."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from gazelle.simulation.base_plugin import Plugin
from gazelle.simulation.clock import Schedule
from gazelle.simulation.scheduled_plugin import ScheduledPlugin


class PublisherGroup(Plugin):
    """Publishes in the place of plugins that are due together and that somebody listens to.

    Args:
        entries: The plugins, in the order they were loaded; they share one schedule.

    Attributes:
        entry: What is updated in their place.
    """

    def __init__(self, entries: Sequence[ScheduledPlugin]) -> None:
        first = entries[0]
        schedule = (first.schedule or Schedule(0.0)).copy()
        self._entries = entries
        self.entry = ScheduledPlugin(self, first.name, first.owner, schedule, group=tuple(entries))
        for each in entries:
            each.schedule = schedule

    def on_update(self, time: float) -> None:  # noqa: ARG002  values carry their own stamps
        """Measure for all at once, and let each publish."""
        entries = [each for each in self._entries if not each.detached]
        plugins = [each.plugin for each in entries]
        try:
            measured = type(plugins[0]).measure_together(plugins)
        except Exception:  # noqa: BLE001  each measures by itself, so that it is seen whose fault it is
            measured = [None] * len(plugins)
        for each, value in zip(entries, measured, strict=True):
            each.publish_measured(value)

    def release(self) -> None:
        """Give each plugin a schedule of its own."""
        for each in self._entries:
            if each.schedule is self.entry.schedule and each.schedule is not None:
                each.schedule = each.schedule.copy()


def group_publishers(
    entries: Sequence[ScheduledPlugin],
) -> tuple[list[ScheduledPlugin], list[PublisherGroup]]:
    """Plugins, publishers of one kind in the place of the first of them, and all groups."""
    kinds: dict[Hashable, list[ScheduledPlugin]] = {}
    for entry in entries:
        kind = entry.kind() if entry.plugin.only_publishes else None
        if kind is not None and entry.schedule is not None:
            due = entry.schedule.rate, entry.schedule.due_ns
            kinds.setdefault((type(entry.plugin), kind, due), []).append(entry)
    places: dict[int, ScheduledPlugin] = {}
    grouped, groups = set[int](), list[PublisherGroup]()
    for some in kinds.values():
        if len(some) > 1:
            groups.append(PublisherGroup(some))
            places[id(some[0])] = groups[-1].entry
            grouped.update(id(entry) for entry in some[1:])
    return [places.get(id(each), each) for each in entries if id(each) not in grouped], groups
