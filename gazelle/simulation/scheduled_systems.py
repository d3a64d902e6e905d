"""Systems of plugins that are due together: when they are updated, and what becomes of faults."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any

from gazelle.native.system import System
from gazelle.simulation.clock import Clock
from gazelle.simulation.grouping import of_one_kind, with_replacements
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.plugin_system import InStepWork, PluginSystem
from gazelle.simulation.scheduled_plugin import ScheduledPlugin, title


class ScheduledSystem:
    """A system, the plugins that are its rows, and when it is due.

    Where it fails with several rows, each row becomes a system of its own, to find the one at
    fault it is. A plugin that fails alone is detached.

    Args:
        entries: The plugins, in the order in which they were loaded; they share one schedule.
        system: Of them.
        nworld: Number of worlds.
    """

    def __init__(
        self, entries: Sequence[ScheduledPlugin], system: PluginSystem[Any], nworld: int
    ) -> None:
        self._entries, self._system, self._nworld = entries, system, nworld
        self.schedule = entries[0].schedule
        if self.schedule is not None and len(entries) > 1:
            self.schedule = self.schedule.copy()
            for entry in entries:
                entry.schedule = self.schedule
        self._subscribed = [entry for entry in entries if entry.is_subscribed]
        self._parted = False
        self._only = entries[0] if len(entries) == 1 else None

    @property
    def kernel(self) -> System | None:
        """Kernel that engines update in its place; None while Python has a part in it."""
        return None if self._subscribed or self._parted else self._system.kernel

    @property
    def may_act_in_step(self) -> bool:
        """True where it is worth calling ``in_step``."""
        return type(self._system).in_step is not PluginSystem.in_step

    def in_step(self) -> InStepWork | None:
        """Return what engines do in its place, and until when."""
        if self._subscribed or self._parted or self._gone:
            return None
        try:
            return self._system.in_step()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self._fail(error, "when getting its kernel")
            return None

    def sync(self) -> None:
        """Read the results of native steps."""
        try:
            self._system.sync()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self._fail(error, "after steps")

    @property
    def plugins(self) -> Sequence[object]:
        """The rows."""
        return self._system.plugins

    @property
    def _gone(self) -> bool:
        return self._only is not None and self._only.detached

    def members(self) -> list[int]:
        """Return the identities of its plugins."""
        return [id(each) for each in self._entries]

    def release(self) -> None:
        """Return each plugin to a schedule of its own."""
        for entry in self._entries:
            if entry.schedule is self.schedule and self.schedule is not None:
                entry.schedule = self.schedule.copy()

    def is_active(self, clock: Clock) -> bool:
        """Return whether an update has anything to do."""
        if self._gone:
            return False
        if self._subscribed or self._parted:
            return True
        if self._system.kernel is not None:
            return True
        try:
            return self._system.active
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self._fail(error, f"at {clock.now:g} s")
            return self._parted

    def update(self, clock: Clock) -> None:
        """Update and publish, if it is due."""
        schedule = self.schedule
        if schedule is None or clock.now_ns < schedule.due_ns or not self.is_active(clock):
            return
        if not self._parted:
            self._act(clock)
        if self._parted:
            self._update_alone(clock)
        elif self._subscribed:
            self._publish(clock)
        schedule.done(clock.now_ns)

    def _act(self, clock: Clock) -> None:
        system = self._system
        try:
            if system.kernel is not None:
                system.kernel.update_from_python(0, self._nworld * system.kernel.rows, clock.now_ns)
            elif not self._subscribed or system.active:  # else it was queried already
                system.update(clock.now)
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self._fail(error, f"at {clock.now:g} s")

    def _publish(self, clock: Clock) -> None:
        some = [each for each in self._subscribed if not each.detached]
        try:
            measured = self._system.measure([each.plugin for each in some]) if some else ()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            if len(some) == 1:
                some[0].detach(error, f"at {clock.now:g} s")
            else:
                self._publish_alone(some)
            return
        for entry, value in zip(some, measured, strict=True):
            entry.publish(self._system, value)

    def _publish_alone(self, entries: Sequence[ScheduledPlugin]) -> None:
        """Measure for each row by itself, to find the one at fault."""
        for entry in entries:
            entry.measure(self._system)

    def _update_alone(self, clock: Clock) -> None:
        """Update each row by itself, to find the one at fault."""
        for entry in self._entries:
            own = make_system([entry], self._nworld)
            if own is not None and own.is_active(clock):
                own._act(clock)  # noqa: SLF001  its own class
                own._publish(clock)  # noqa: SLF001

    def _fail(self, error: Exception, when: str) -> None:
        if len(self._entries) == 1:
            self._entries[0].detach(error, when)
            return
        _warn(self._entries, "when updated with others, and all are updated alone", error)
        self._parted = True
        for entry in self._entries:
            entry.part()


def make_systems(
    entries: Sequence[ScheduledPlugin], nworld: int
) -> list[ScheduledPlugin | ScheduledSystem]:
    """Return the update order, with systems in the place of the first of their plugins.

    Args:
        entries: Plugins, in the order in which they were loaded.
        nworld: Number of worlds.
    """
    awake = [each for each in entries if each.plugin.system is None or each.needs_system]
    places: list[tuple[Sequence[ScheduledPlugin], ScheduledSystem | None]] = []
    for some in of_one_kind(awake, _due_with):
        made = make_system(some, nworld)
        if made is None and len(some) > 1:
            places += [([entry], make_system([entry], nworld)) for entry in some]
        else:
            places.append((some, made))
    return with_replacements(awake, places)


def make_system(entries: Sequence[ScheduledPlugin], nworld: int) -> ScheduledSystem | None:
    """Return the system of some plugins; None, with a warning, if it cannot be made."""
    kind = entries[0].plugin.system
    try:
        if kind is not None:
            system = kind([entry.plugin for entry in entries])
            return ScheduledSystem(entries, system, nworld)
    except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
        if len(entries) == 1:
            entries[0].detach(error, "when its system was made")
        else:
            _warn(entries, "when their system was made, and is updated alone", error)
            for entry in entries:
                entry.alone = True
    return None


def _due_with(entry: ScheduledPlugin) -> Hashable | None:
    """Return a key that is equal for the rows of one system; None for a plugin without a system."""
    kind = entry.plugin.system
    if kind is None or entry.schedule is None or entry.detached:
        return None
    if entry.alone or kind.single:
        return id(entry)
    return type(entry.plugin), kind, entry.schedule.rate, entry.schedule.due_ns


def _warn(entries: Sequence[ScheduledPlugin], when: str, error: Exception) -> None:
    name = title(entries[0].name, entries[0].owner)
    warn_of_fault(entries[0].plugin, name, when, error)
