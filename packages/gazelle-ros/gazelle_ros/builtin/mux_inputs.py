"""Sources of commands as multiplexers know them: topic, timeout and priority."""

from __future__ import annotations

import logging
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.real_numbers import finite
from gazelle_ros.clock import SECOND

_KEYS = ("name", "topic", "timeout", "priority")
_LOG = logging.getLogger("gazelle.ros.mux")


@dataclass(slots=True)
class MuxInput:
    """A topic that is listened to, and its last message.

    Attributes:
        name: In diagnostics.
        topic: As the parameter has it.
        timeout: Age from which a message does not count [s]; 0 means at any age.
        priority: 0 to 255.
        stamp: Time of the last message [ns]; before the first one it is 0, so that a source with a
            timeout begins expired.
        locked: Value of the last message, of a lock.
    """

    name: str
    topic: str
    timeout: float
    priority: int
    stamp: int = 0
    locked: bool = False

    def expired(self, now: int) -> bool:
        """Return whether the last message is too old at a time [ns]."""
        return self.timeout > 0.0 and now - self.stamp > self.timeout * SECOND

    def is_locked(self, now: int) -> bool:
        """Return whether a lock holds: by its message, or because it is silent."""
        return self.locked or self.expired(now)

    def is_masked(self, now: int, lock_priority: int) -> bool:
        """Return whether commands are dropped: the last one is too old, or a lock is above."""
        return self.expired(now) or self.priority < lock_priority

    def described(self, state: str) -> str:
        """Return the text of diagnostics."""
        return f" {state} (listening to {self.topic} @ {self.timeout:f}s with priority #{self.priority})"


def mux_input(where: str, entry: Any, *, highest: int, ignored: Collection[str] = ()) -> MuxInput:
    """Return a source from its parameters.

    Args:
        where: Name of the parameter, for messages.
        entry: Mapping with name, topic, timeout [s] and priority.
        highest: Highest priority; greater ones are reduced to it.
        ignored: Other keys that are allowed.

    Raises:
        RosError: It is malformed.
    """
    if not isinstance(entry, Mapping):
        raise RosError(f"{where} has name, topic, timeout and priority; it is {entry!r:.60}")
    for key in entry.keys() - {*_KEYS, *ignored}:
        hint = did_you_mean(key, _KEYS)
        _LOG.warning("%s has an unknown '%s'%s", where, key, f"; {hint}" if hint else "")
    missing = [key for key in _KEYS if key not in entry]
    if missing:
        raise RosError(f"{where} has no '{missing[0]}'")
    name, topic = entry["name"], entry["topic"]
    for key in ("name", "topic"):
        if not (isinstance(entry[key], str) and entry[key]):
            raise RosError(f"the {key} of {where} must be a word, not {entry[key]!r:.60}")
    priority = _number(where, "priority", entry["priority"])
    timeout = _number(where, "timeout", entry["timeout"])
    clamped = round(min(max(priority, 0), highest))
    if clamped != priority:
        _LOG.warning("%s: priority %r is taken for %d", where, entry["priority"], clamped)
    return MuxInput(name, topic, timeout, clamped)


def _number(where: str, key: str, value: Any) -> float:
    number = finite(value)
    if number is None:
        raise RosError(f"the {key} of {where} must be a number, not {value!r:.60}")
    return number
