"""Time of a node: wall time, or simulated time from ``/clock``.

All times are integer nanoseconds. Sleeping and rates behave as rospy's do when simulated
time stands still or jumps (http://wiki.ros.org/Clock).
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import Protocol

from gazelle_ros.errors import TimeMovedBackwardsError

SECOND = 1_000_000_000
_CHECK_S = 0.3
"""Interval at which a sleeper checks whether to give up, in seconds of wall time."""
_LONGEST_NS = 10**18
"""Nanoseconds that the system can sleep at once."""
_SLOWEST = 1e-9
"""Cycles per second: three decades each."""
_SILENCE_S = 2.0
"""Time that a sleeper waits for a first ``/clock`` before it warns."""

Cancelled = Callable[[], bool]


class TimeSource(Protocol):
    """A source of time."""

    simulated: bool

    def now(self) -> int:
        """Return the time in nanoseconds; 0 while simulated time did not begin."""

    def sleep(self, nanoseconds: int, cancelled: Cancelled | None = None) -> bool:
        """Wait for that long on this clock.

        Args:
            nanoseconds: Duration; none if it is not positive.
            cancelled: Looked at now and then; when true, the sleep ends.

        Returns:
            False if it was cancelled.

        Raises:
            TimeMovedBackwardsError: The clock jumped to before the sleep began.
        """


class WallClock:
    """The time of the machine."""

    simulated = False

    def now(self) -> int:
        """Return nanoseconds since 1970."""
        return time.time_ns()

    def sleep(self, nanoseconds: int, cancelled: Cancelled | None = None) -> bool:
        """Wait; see `TimeSource.sleep`."""
        deadline = time.monotonic_ns() + nanoseconds
        most = _LONGEST_NS if cancelled is None else int(_CHECK_S * SECOND)
        while (left := deadline - time.monotonic_ns()) > 0:
            if cancelled is not None and cancelled():
                return False
            time.sleep(min(left, most) / SECOND)
        return cancelled is None or not cancelled()


class _Sleeper:
    """A thread that waits for simulated time."""

    __slots__ = ("event", "jump", "start", "target")

    def __init__(self, start: int, target: int) -> None:
        self.start = start
        self.target = target
        self.jump = 0
        self.event = threading.Event()


class SimulatedClock:
    """A time that others set, such as a simulation through ``/clock``.

    Args:
        topic: Topic of the time, for the message that it does not come.
    """

    simulated = True

    def __init__(self, topic: str = "/clock") -> None:
        self._topic = topic
        self._now = 0
        self._lock = threading.Lock()
        self._sleepers: set[_Sleeper] = set()
        self._started = threading.Event()

    def now(self) -> int:
        """Return nanoseconds of simulated time; 0 before the first."""
        return self._now

    def set(self, nanoseconds: int) -> None:
        """Set the time, forward or back; sleepers whose time came wake up."""
        nanoseconds = int(nanoseconds)  # numpy's has 64 bits only
        with self._lock:
            self._now = nanoseconds
            for sleeper in self._sleepers:
                if nanoseconds < sleeper.start:
                    sleeper.jump = nanoseconds - sleeper.start
                    sleeper.event.set()
                elif nanoseconds >= sleeper.target:
                    sleeper.event.set()
        if nanoseconds and not self._started.is_set():
            self._started.set()

    def sleep(self, nanoseconds: int, cancelled: Cancelled | None = None) -> bool:
        """Wait; see `TimeSource.sleep`. Before the first time there is, it waits for that."""
        if not self._wait_for_start(cancelled):
            return False
        with self._lock:
            start = self._now
            if nanoseconds <= 0:
                return True
            sleeper = _Sleeper(start, start + nanoseconds)
            self._sleepers.add(sleeper)
        try:
            while not sleeper.event.wait(_CHECK_S):
                if cancelled is not None and cancelled():
                    return False
        finally:
            with self._lock:
                self._sleepers.discard(sleeper)
        if sleeper.jump:
            raise TimeMovedBackwardsError(sleeper.jump / SECOND)
        return cancelled is None or not cancelled()

    def _wait_for_start(self, cancelled: Cancelled | None) -> bool:
        if self._started.is_set():
            return True
        begin, said = time.monotonic(), False
        while not self._started.wait(_CHECK_S):
            if cancelled is not None and cancelled():
                return False
            if not said and time.monotonic() - begin >= _SILENCE_S:
                said = True
                logging.getLogger("gazelle.ros").warning(
                    "waiting for simulated time: /use_sim_time is set, but nothing came on %s",
                    self._topic,
                )
        return True


class Rate:
    """Keeps a loop at a rate on a clock.

    Args:
        clock: Clock of the durations.
        hertz: Cycles per second.
        reset: Start again after a jump back instead of raising.

    Raises:
        ValueError: The rate is not positive, or less than 1e-9.
    """

    def __init__(self, clock: TimeSource, hertz: float, *, reset: bool = False) -> None:
        if not hertz >= _SLOWEST:
            raise ValueError(f"a rate must be positive, at least {_SLOWEST:g}, not {hertz}")
        self.period = round(SECOND / hertz)
        """Nanoseconds of a cycle."""
        self._clock = clock
        self._reset = reset
        self._last = clock.now()

    def remaining(self) -> int:
        """Return nanoseconds left of this cycle; negative if it is late."""
        return self._left(self._clock.now())

    def sleep(self, cancelled: Cancelled | None = None) -> bool:
        """Wait for the end of the cycle; False if it was cancelled.

        Raises:
            TimeMovedBackwardsError: The clock jumped back, and `reset` is false.
        """
        now = self._clock.now()
        try:
            awake = self._clock.sleep(self._left(now), cancelled)
        except TimeMovedBackwardsError:
            if not self._reset:
                raise
            self._last = self._clock.now()
            return True
        self._last += self.period
        # A loop that is too slow, or a jump ahead, starts a new count instead of hurrying.
        if now - self._last > self.period * 2:
            self._last = now
        return awake

    def _left(self, now: int) -> int:
        self._last = min(self._last, now)  # time may have jumped back
        return self.period - (now - self._last)
