"""Real-time factor of a simulation stepped elsewhere."""

from __future__ import annotations

import time
from collections import deque
from typing import NamedTuple

_WINDOW_S = 1.0


class _Mark(NamedTuple):
    """Sums since the beginning.

    Attributes:
        wall: Time [s].
        moving: Time in which the simulation advanced [s].
        simulated: Simulated time [s].
    """

    wall: float
    moving: float
    simulated: float


class PaceMeter:
    """Mean real-time factor over the last second in which the simulation advanced.

    A training stands while it learns, often for longer than it steps. So the mean reaches back
    beyond such times, and counts them.
    """

    def __init__(self) -> None:
        self._marks: deque[_Mark] = deque()
        self._last = 0.0

    def forget(self) -> None:
        """Start again, as after a pause."""
        self._marks.clear()

    def factor(self, simulated: float) -> float | None:
        """Note the simulated time [s], and return the factor; None while it is not known."""
        wall = time.monotonic()
        if not self._marks:
            self._last = simulated
            self._marks.append(_Mark(wall, 0.0, 0.0))
            return None
        # A reset begins at zero.
        gain = simulated - self._last if simulated >= self._last else simulated
        self._last, newest = simulated, self._marks[-1]
        passed = wall - newest.wall
        now = _Mark(wall, newest.moving + passed * (gain > 0.0), newest.simulated + gain)
        self._marks.append(now)
        while len(self._marks) > 2 and now.moving - self._marks[1].moving >= _WINDOW_S:
            self._marks.popleft()
        first = self._marks[0]
        if now.simulated == first.simulated or wall == first.wall:
            return None
        return (now.simulated - first.simulated) / (wall - first.wall)
