"""A plugin that is loaded: when it is due, and what becomes of its faults."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.clock import Clock, Schedule
from gazelle.simulation.plugin_errors import warn_of_fault
from gazelle.simulation.plugin_system import PluginSystem
from gazelle.simulation.state_lock import StateLock

T = TypeVar("T")


@dataclass(slots=True)
class ScheduledPlugin:
    """A loaded plugin, its owner, and its schedule; without one it is never updated.

    One that raises is detached with a warning: it is never called again, and all else continues.
    """

    plugin: BasePlugin
    name: str
    owner: str
    schedule: Schedule | None
    lock: StateLock | None = None
    detached: bool = False
    alone: bool = False
    """True for a system by itself, whatever its kind, as it failed together with others."""

    def members(self) -> list[int]:
        """Return its identity, as a system returns those of its plugins."""
        return [id(self)]

    def detach(self, error: Exception, when: str) -> None:
        """Disable the plugin after an error."""
        self.schedule, self.detached = None, True
        if self.lock is not None:
            self.lock.changes += 1
        warn_of_fault(self.plugin, title(self.name, self.owner), f"{when} and is detached", error)

    def part(self) -> None:
        """Run as a system of its own from now on."""
        self.alone = True
        if self.lock is not None:
            self.lock.changes += 1

    def is_active(self, clock: Clock) -> bool:
        """Return whether an update has anything to do."""
        return self._guarded(lambda: self.plugin.active, f"at {clock.now:g} s") is True

    def update(self, clock: Clock) -> None:
        """Update the plugin, if it is due and active."""
        schedule = self.schedule
        if schedule is None or clock.now_ns < schedule.due_ns:
            return
        try:
            if not self.plugin.active:
                return
            self.plugin.on_update(clock.now)
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self.detach(error, f"at {clock.now:g} s")
            return
        schedule.done(clock.now_ns)

    @property
    def is_subscribed(self) -> bool:
        """True while anything that its system publishes has subscribers."""
        return self._guarded(self._has_subscribers, "when checking its subscribers") is True

    @property
    def needs_system(self) -> bool:
        """True while its system has anything to do for it."""
        kind = self.plugin.system
        return kind is not None and (kind.acts or self.is_subscribed)

    def _has_subscribers(self) -> bool:
        return any(output.has_subscribers for output in self.plugin.published)

    def publish(self, system: PluginSystem[Any], measured: Any) -> None:
        """Publish its measured values."""
        self._guarded(lambda: system.publish(self.plugin, measured), "when publishing")

    def measure(self, system: PluginSystem[Any]) -> None:
        """Measure for one system, and publish the result."""
        self._guarded(
            lambda: system.publish(self.plugin, system.measure([self.plugin])[0]), "when publishing"
        )

    def reset(self, worlds: NDArray[np.intp] | None) -> None:
        """Reset the plugin."""
        self._guarded(lambda: self.plugin.reset(worlds), "at a reset")

    def reseed(self, seed: int, worlds: NDArray[np.intp] | None) -> None:
        """Set the seed of the plugin's random numbers."""
        self._guarded(lambda: self.plugin.reseed(seed, worlds), "at a reset with a seed")

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state of the plugin."""
        return self._guarded(self.plugin.state, "at a snapshot") or {}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._guarded(lambda: self.plugin.restore(state), "while restoring a snapshot")

    def _guarded(self, work: Callable[[], T], when: str) -> T | None:
        if self.detached:
            return None
        try:
            return work()
        except Exception as error:  # noqa: BLE001  a plugin's fault is not the simulation's
            self.detach(error, when)
            return None


def title(name: str, owner: str) -> str:
    """Return the title of a plugin: its name in the file, and its model."""
    return f"plugin '{name}' of '{owner}'" if owner else f"plugin '{name}'"


def make_scheduled(
    plugin: BasePlugin, name: str, owner: str, lock: StateLock | None = None
) -> ScheduledPlugin:
    """Return a plugin with its schedule, once it is loaded."""
    schedule = None if plugin.update_rate is None else Schedule(plugin.update_rate)
    return ScheduledPlugin(plugin, name, owner, schedule, lock)
