"""Plugins of one kind that only publish, of many robots: measured at once."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.grouping import of_one_kind, with_replacements
from gazelle.simulation.scheduled_plugin import (
    ScheduledPlugin,
    due_with,
    part_schedule,
    publish_together,
    share_schedule,
)


class PublisherGroup(BasePlugin):
    """Publishes in the place of plugins that are due together and that somebody listens to.

    Args:
        entries: The plugins, in the order they were loaded; they share one schedule.

    Attributes:
        entry: What is updated in their place.
    """

    def __init__(self, entries: Sequence[ScheduledPlugin]) -> None:
        first, self._shared = entries[0], share_schedule(entries)
        self._entries = entries
        self.entry = ScheduledPlugin(
            self, first.name, first.owner, self._shared, group=tuple(entries)
        )

    def on_update(self, time: float) -> None:  # noqa: ARG002  values carry their own stamps
        """Measure for all at once, and let each publish."""
        publish_together([each for each in self._entries if not each.detached])

    def release(self) -> None:
        """Give each plugin a schedule of its own."""
        part_schedule(self._entries, self._shared)


def group_publishers(
    entries: Sequence[ScheduledPlugin],
) -> tuple[list[ScheduledPlugin], list[PublisherGroup]]:
    """Plugins, publishers of one kind in the place of the first of them, and all groups."""
    publishing = [entry for entry in entries if entry.plugin.only_publishes]
    several = [some for some in of_one_kind(publishing, due_with) if len(some) > 1]
    groups = [PublisherGroup(some) for some in several]
    places = zip(several, [group.entry for group in groups], strict=True)
    return with_replacements(entries, places), groups
