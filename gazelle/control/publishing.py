"""When controllers publish."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.limits import NANOSECONDS


class PublishingSchedule:
    """At a rate, from the first update on; what was missed is caught up, one at an update.

    Args:
        rate: [Hz]; never if it is 0 or less.
    """

    def __init__(self, rate: float) -> None:
        self.set_rate(rate)
        self._last_ns: int | None = None

    def set_rate(self, rate: float) -> None:
        """Set the rate [Hz]."""
        self.rate = rate
        self._period_ns = 0
        if rate > 0.0:  # a nanosecond at least, and some thirty years at most
            self._period_ns = max(1, round(min(NANOSECONDS / rate, NANOSECONDS**2)))

    def start(self, now_ns: int, *, at_once: bool = True) -> None:
        """Start at a time: it is due at the next update, or a period later."""
        self._last_ns = None if at_once else now_ns

    def is_due(self, now_ns: int) -> bool:
        """Return whether publishing is due now; if so, it counts as done."""
        if not self._period_ns:
            return False
        if self._last_ns is None:
            self._last_ns = now_ns
            return True
        if self._last_ns + self._period_ns >= now_ns:
            return False
        self._last_ns += self._period_ns
        return True

    @property
    def next_ns(self) -> float:
        """Next due time [ns]; at once if it never was due."""
        if not self._period_ns:
            return math.inf
        return 0.0 if self._last_ns is None else self._last_ns + self._period_ns + 1

    def skip(self, now_ns: int, updates: int) -> None:
        """Count as done what was due meanwhile.

        Args:
            now_ns: Time of the last update [ns].
            updates: Number of updates.
        """
        if self._period_ns and self._last_ns is not None:
            missed = (now_ns - 1 - self._last_ns) // self._period_ns
            self._last_ns += max(0, min(missed, updates)) * self._period_ns

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the state that changes."""
        return {"published": np.array(-1 if self._last_ns is None else self._last_ns)}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        last = int(state["published"])
        self._last_ns = None if last == -1 else last
