"""Systems that act within the physics' steps for some time, queried together."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from collections.abc import Set as AbstractSet

import numpy as np

from gazelle.native.system import System
from gazelle.simulation.base_plugin import BasePlugin
from gazelle.simulation.plugin_system import InStepWork
from gazelle.simulation.scheduled_systems import ScheduledSystem

_OUTDATED = -1.0


class SystemsInStep:
    """Systems that may act within steps, in the order in which they act.

    An answer that lasts (``InStepWork``) is kept until its time has come, until it is invalidated, or until
    the cache key changes. So between two steps only those are queried that may have
    changed, however many there are.

    Attributes:
        kernels: Systems that engines update in steps.
        soonest_ns: Time of Python's next update of these systems [ns].
    """

    def __init__(self) -> None:
        self.kernels: list[System] = []
        self.soonest_ns = math.inf
        self._holds: Hashable = None
        self.plan(())

    def plan(self, entries: Sequence[ScheduledSystem]) -> None:
        """Plan these again, and query all of them."""
        self._entries = tuple(entries)
        self._places = {
            id(plugin): place for place, entry in enumerate(entries) for plugin in entry.plugins
        }
        self._found: list[InStepWork | None] = [None] * len(entries)
        self._until = np.full(len(entries), _OUTDATED)  # when each is queried again [ns]
        self._query_ns = _OUTDATED
        self._brief: list[ScheduledSystem] = []
        self._invalid = False  # whether an answer that was given does not hold any more
        self._count(changed=True)

    def invalidate(self, plugin: BasePlugin) -> None:
        """Invalidate the answer of a plugin's system: it is queried again before the next step."""
        place = self._places.get(id(plugin))
        if place is not None:
            self._until[place] = self._query_ns = _OUTDATED
            self._invalid = self._invalid or self._found[place] is not None

    def is_current(self, holds: Hashable) -> bool:
        """Return whether the answers are those to what holds now, and none is invalidated."""
        return not self._entries or (self._holds == holds and not self._invalid)

    def query(
        self, now_ns: int, holds: Hashable, updated: AbstractSet[int] = frozenset()
    ) -> list[ScheduledSystem]:
        """Return the systems that Python updates now; ``kernels`` are of the others.

        Args:
            now_ns: Simulated time [ns].
            holds: Cache key of all answers; a new one queries all of them.
            updated: Identities of plugins that Python updated at this time already.
        """
        if self._holds != holds:
            self._until[:] = self._query_ns = _OUTDATED
            self._holds = holds
        if now_ns < self._query_ns:
            return []
        self._invalid = False
        changed, others = False, []
        for place in np.flatnonzero(self._until <= now_ns).tolist():
            entry, before = self._entries[place], self._found[place]
            self._found[place] = None
            done = entry.schedule is None or not updated.isdisjoint(entry.members())
            found = None if done else entry.in_step()
            if found is None or found.until_ns <= now_ns:
                others.append(entry)
                found = None
            self._found[place] = found
            self._until[place] = found.until_ns if found and found.lasting else _OUTDATED
            changed = changed or found != before
        self._count(changed=changed)
        return others

    def _count(self, *, changed: bool) -> None:
        self._query_ns = float(self._until.min(initial=math.inf))
        if not changed:
            return
        pairs = zip(self._entries, self._found, strict=True)
        known = [(entry, found) for entry, found in pairs if found is not None]
        self.kernels = [kernel for _, found in known for kernel in found.kernels]
        self.soonest_ns = min((found.until_ns for _, found in known), default=math.inf)
        self._brief = [entry for entry, found in known if not found.lasting]

    def sync(self) -> None:
        """Take over what systems with transient answers computed in steps."""
        for entry in self._brief:
            entry.sync()
