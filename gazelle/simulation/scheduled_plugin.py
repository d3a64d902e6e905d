"""A plugin that is loaded: when it is due, and what becomes of its faults."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.native.system import System
from gazelle.simulation.base_plugin import BasePlugin, Carried
from gazelle.simulation.clock import Schedule
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.requests import RequestQueue

T = TypeVar("T")


@dataclass(slots=True)
class ScheduledPlugin:
    """A loaded plugin, what it is on, and when it is due; no schedule means never.

    One that raises is detached with a warning: it is never asked again, and all else goes on.
    """

    plugin: BasePlugin
    name: str
    owner: str
    schedule: Schedule | None
    requests: RequestQueue | None = None
    detached: bool = False
    group: tuple[ScheduledPlugin, ...] = ()
    """In whose place it is."""
    alone: bool = False
    """Whether it is updated by itself, whatever its kind, as it failed together with others."""

    def members(self) -> list[int]:
        """What tells it, or those in whose place it is, from others."""
        return [id(each) for each in self.group or (self,)]

    def detach(self, error: Exception, when: str) -> None:
        """Go on without it."""
        self.schedule, self.detached = None, True
        if self.requests is not None:
            self.requests.changes += 1
        warn_of_fault(self.plugin, title(self.name, self.owner), f"{when} and is detached", error)

    def update(self, time: float) -> None:
        """Let it act, if it needs to [s]."""
        if self._ask(lambda: self.plugin.active, "when asked"):
            self._ask(lambda: self.plugin.on_update(time), f"at {time:g} s")

    def system(self) -> System | None:
        """What is updated in its place now."""
        return self._ask(self.plugin.system, "when asked for its system")

    @property
    def rests(self) -> bool:
        """Whether it has no update until somebody subscribes, or models come or go."""
        plugin = self.plugin
        if self.schedule is None:
            return True
        return plugin.only_publishes and self._ask(lambda: not plugin.active, "when asked") is True

    def carried(self) -> Carried | None:
        """What does its work within steps, and until when [ns]."""
        return self._ask(self.plugin.carried, "when asked for its system")

    def catch_up(self) -> None:
        """Steps were made with it."""
        self._ask(self.plugin.catch_up, "after steps")

    @property
    def may_be_carried(self) -> bool:
        """Whether it is worth asking."""
        return type(self.plugin).carried is not BasePlugin.carried

    def kind(self) -> Hashable | None:
        """What it has in common with those that are updated together with it."""
        return self._ask(self.plugin.kind, "when asked for its kind")

    def is_heard(self) -> bool:
        """Whether somebody listens to what it publishes."""
        return self._ask(lambda: self.plugin.is_heard, "when asked") is True

    def publish_measured(self, measured: Any) -> None:
        """Publish what was measured for it."""
        self._ask(lambda: self.plugin.publish_measured(measured), "when publishing")

    def reset(self, worlds: NDArray[np.intp] | None) -> None:
        """Let it begin anew."""
        self._ask(lambda: self.plugin.reset(worlds), "at a reset")

    def reseed(self, seed: int, worlds: NDArray[np.intp] | None) -> None:
        """Let it use other random numbers."""
        self._ask(lambda: self.plugin.reseed(seed, worlds), "at a reset with a seed")

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Everything that changes in it."""
        return self._ask(self.plugin.state, "at a snapshot") or {}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        self._ask(lambda: self.plugin.restore(state), "while restoring a snapshot")

    def _ask(self, work: Callable[[], T], when: str) -> T | None:
        if self.detached:
            return None
        try:
            return work()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self.detach(error, when)
            return None


def due_with(entry: ScheduledPlugin) -> Hashable | None:
    """Equal for plugins of one kind that are due together; None for those updated alone."""
    kind = None if entry.alone else entry.kind()
    if kind is None or entry.schedule is None:
        return None
    return type(entry.plugin), kind, entry.schedule.rate, entry.schedule.due_ns


def share_schedule(entries: Sequence[ScheduledPlugin]) -> Schedule:
    """One schedule for all, that of the first."""
    schedule = (entries[0].schedule or Schedule(0.0)).copy()
    for entry in entries:
        entry.schedule = schedule
    return schedule


def part_schedule(entries: Iterable[ScheduledPlugin], shared: Schedule) -> None:
    """Give each that still has a shared schedule one of its own."""
    for entry in entries:
        if entry.schedule is shared:
            entry.schedule = shared.copy()


def publish_together(entries: Sequence[ScheduledPlugin]) -> None:
    """Measure for all at once, and let each publish; they are of one class."""
    plugins = [entry.plugin for entry in entries]
    try:
        measured = type(plugins[0]).measure_together(plugins)
    except Exception:  # noqa: BLE001  each measures by itself, so that it is seen whose fault it is
        measured = [None] * len(plugins)
    for entry, value in zip(entries, measured, strict=True):
        entry.publish_measured(value)


def title(name: str, owner: str) -> str:
    """A plugin by the name that its file gives it, and the model that it is on."""
    return f"plugin '{name}' of '{owner}'" if owner else f"plugin '{name}'"


def make_scheduled(
    plugin: BasePlugin, name: str, owner: str, requests: RequestQueue | None = None
) -> ScheduledPlugin:
    """A plugin with the schedule it asks for, once it is loaded."""
    schedule = None if plugin.update_rate is None else Schedule(plugin.update_rate)
    return ScheduledPlugin(plugin, name, owner, schedule, requests)
