"""Plugins whose work the physics' steps do, all asked at once instead of one by one at every step."""

from __future__ import annotations

import math
from collections.abc import Container, Hashable, Sequence

import numpy as np

from gazelle.native.joint_system import JointSystem
from gazelle.simulation.base_plugin import BasePlugin, Carried
from gazelle.simulation.scheduled_plugin import ScheduledPlugin

_ASK = -1.0


class CarriedPlugins:
    """Plugins that steps may carry, in the order in which they act.

    An answer that lasts (``Carried``) is kept until its time has come, until the plugin is stirred, or
    until what all answers go by is another. So between two steps nobody is asked who has nothing to
    say, however many there are.

    Attributes:
        systems: What steps bring, in the plugins' order.
        soonest_ns: When Python has to update the first of these plugins [ns].
    """

    def __init__(self) -> None:
        self.systems: list[JointSystem] = []
        self.soonest_ns = math.inf
        self._holds: Hashable = None
        self.plan(())

    def plan(self, entries: Sequence[ScheduledPlugin]) -> None:
        """Carry these, and ask all of them anew."""
        self._entries = tuple(entries)
        self._places = {id(entry.plugin): place for place, entry in enumerate(entries)}
        self._found: list[Carried | None] = [None] * len(entries)
        self._until = np.full(len(entries), _ASK)  # when each is asked again [ns]
        self._ask_ns = _ASK
        self._brief: list[ScheduledPlugin] = []
        self._loose = False  # whether an answer that was given does not hold any more
        self._count(changed=True)

    def stir(self, plugin: BasePlugin) -> None:
        """Ask a plugin anew before the next step: something was done to it."""
        place = self._places.get(id(plugin))
        if place is not None:
            self._until[place] = self._ask_ns = _ASK
            self._loose = self._loose or self._found[place] is not None

    def is_current(self, holds: Hashable) -> bool:
        """Whether the answers go by what holds now, and nothing was done to who gave them."""
        return not self._entries or (self._holds == holds and not self._loose)

    def ask(
        self, now_ns: int, holds: Hashable, updated: Container[int] = ()
    ) -> list[ScheduledPlugin]:
        """The plugins that Python updates now; ``systems`` are of the others.

        Args:
            now_ns: Simulated time [ns].
            holds: What all answers go by; where it is another than before all are asked.
            updated: Identities of entries that Python updated at this time already.
        """
        if self._holds != holds:
            self._until[:] = self._ask_ns = _ASK
            self._holds = holds
        if now_ns < self._ask_ns:
            return []
        self._loose = False
        changed, others = False, []
        for place in np.flatnonzero(self._until <= now_ns).tolist():
            entry, before = self._entries[place], self._found[place]
            self._found[place] = None
            found = None if id(entry) in updated or entry.schedule is None else entry.carried()
            if found is None or found.until_ns <= now_ns:
                others.append(entry)
                found = None
            self._found[place] = found
            self._until[place] = found.until_ns if found and found.lasting else _ASK
            changed = changed or found != before
        self._count(changed=changed)
        return others

    def _count(self, *, changed: bool) -> None:
        self._ask_ns = float(self._until.min(initial=math.inf))
        if not changed:
            return
        pairs = zip(self._entries, self._found, strict=True)
        known = [(entry, found) for entry, found in pairs if found is not None]
        self.systems = [found.system for _, found in known if found.system is not None]
        self.soonest_ns = min((found.until_ns for _, found in known), default=math.inf)
        self._brief = [entry for entry, found in known if not found.lasting]

    def release(self) -> None:
        """Carry none: there is no engine that does."""
        if any(found is not None for found in self._found):
            self.plan(self._entries)

    def catch_up(self) -> None:
        """Steps were made: tell those whose answers do not last."""
        for entry in self._brief:
            entry.catch_up()
