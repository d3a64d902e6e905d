"""Status of a display: what keeps it from being shown, or how it comes in."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

SILENT_S = 5.0
"""A topic that came regularly and has not for so long is reported."""
_WINDOW = 20
_REGULAR = 3  # messages, from which on a topic should go on


@dataclass(frozen=True, slots=True)
class DisplayStatus:
    """Status of one display.

    Attributes:
        text: For people.
        fault: Whether it keeps the display from being shown, or up to date.
    """

    text: str
    fault: bool


class Arrivals:
    """Times at which messages arrived; for any threads.

    Args:
        clock: Seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.count = 0
        self._clock, self._lock = clock, threading.Lock()
        self._times: deque[float] = deque(maxlen=_WINDOW)

    def add(self) -> None:
        """Record the arrival of a message, now."""
        with self._lock:
            self.count += 1
            self._times.append(self._clock())

    @property
    def age(self) -> float:
        """Time since the last one [s], infinite before the first."""
        with self._lock:
            return self._clock() - self._times[-1] if self._times else float("inf")

    @property
    def rate(self) -> float:
        """Messages a second, of the last ones until now; 0 before the second."""
        with self._lock:
            if len(self._times) < 2:
                return 0.0
            span = self._times[-1] - self._times[0]
            mean = span / (len(self._times) - 1)
            return 1.0 / max(mean, self._clock() - self._times[-1], 1e-9)


def status_of(
    arrivals: Arrivals, *, kind: str, offered: str, publishers: int, unplaced: str, error: str
) -> DisplayStatus:
    """Return the status of a display: its first fault, or its rate.

    Args:
        arrivals: Of its messages.
        kind: Type that it shows.
        offered: Type that the master knows for the topic.
        publishers: Number of nodes that publish on it.
        unplaced: Reason why its frame has no transform; empty if it has.
        error: Reason why its last message was not drawn; empty if it was.
    """
    age = arrivals.age
    fault = ""
    if offered and offered != kind:
        fault = f"type differs: {offered} is published, {kind} was shown"
    elif error:
        fault = error
    elif unplaced and arrivals.count:
        fault = f"{unplaced}, so it is not shown"
    elif not publishers:
        fault = "it has no publisher"
    elif not arrivals.count:
        return DisplayStatus("no message yet", fault=False)
    elif age >= SILENT_S and arrivals.count >= _REGULAR:
        fault = f"no message for {age:.0f} s"
    if fault:
        return DisplayStatus(fault, fault=True)
    messages = f"{arrivals.count} message{'s' * (arrivals.count > 1)}"
    rate = arrivals.rate
    return DisplayStatus(f"{messages}, {rate:.3g} Hz" if rate > 0.05 else messages, fault=False)
