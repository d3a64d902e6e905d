"""Sleeping, loops at a rate, and callbacks at a rate, in the time of the node."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from gazelle_ros import time as values
from gazelle_ros.clock import SECOND, WallClock
from gazelle_ros.compat.rospy.exceptions import (
    ROSInterruptException,
    ROSTimeMovedBackwardsException,
)
from gazelle_ros.compat.rospy.rostime import Duration, Time, get_rostime, is_rostime_initialized
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.errors import TimeMovedBackwardsError

# So much longer than it should a hook's sleep may last on simulated time [s].
_PATIENCE_S = 5.0


def sleep(duration: values.Duration | float) -> None:
    """Sleep in the time of the node.

    Args:
        duration: A duration, or seconds [s]; negative ones do not sleep.

    Raises:
        ROSInterruptException: The node was shut down meanwhile.
        ROSTimeMovedBackwardsException: Simulated time jumped back.
    """
    length = duration if isinstance(duration, values.Duration) else Duration.from_sec(duration)
    clock = process.clock if is_rostime_initialized() else WallClock()
    try:
        awake = clock.sleep(length.to_nsec(), _given_up(length))
    except TimeMovedBackwardsError as error:
        raise ROSTimeMovedBackwardsException(error.jump) from None
    if not awake or process.over:
        process.wait_ended()
        raise ROSInterruptException("ROS shutdown request")


def _given_up(length: values.Duration) -> Callable[[], bool]:
    """Return the condition that ends a sleep early: the shutdown.

    A hook of the shutdown may sleep, but not for ever where simulated time stands still.
    """
    if not process.hooking:
        return process.shutdown.is_set
    latest = time.monotonic() + max(0.0, length.to_sec()) + _PATIENCE_S
    return lambda: time.monotonic() > latest


class Rate:
    """Keeps a loop at a rate.

    Args:
        hz: Cycles per second.
        reset: Start again after a jump back of simulated time, instead of raising.
    """

    def __init__(self, hz: float, reset: bool = False) -> None:  # noqa: FBT001, FBT002  # rospy's interface
        self.last_time: values.Time = get_rostime()
        self.sleep_dur = Duration(0, int(SECOND / hz))
        self._reset = reset

    def _remaining(self, curr_time: values.Time) -> values.Duration:
        # Simulated time may have jumped back.
        self.last_time = min(self.last_time, curr_time)
        return self.sleep_dur - (curr_time - self.last_time)

    def remaining(self) -> values.Duration:
        """Return the rest of this cycle."""
        return self._remaining(get_rostime())

    def sleep(self) -> None:
        """Sleep for the rest of this cycle.

        Raises:
            ROSInterruptException: The node was shut down meanwhile.
            ROSTimeMovedBackwardsException: Simulated time jumped back.
        """
        begin = get_rostime()
        try:
            sleep(self._remaining(begin))
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self.last_time = get_rostime()
            return
        self.last_time = self.last_time + self.sleep_dur
        # A loop that is too slow, or a jump ahead, starts a new count instead of hurrying.
        if begin - self.last_time > self.sleep_dur * 2:
            self.last_time = begin


@dataclass
class TimerEvent:
    """Timing information for a timer's callback.

    Attributes:
        last_expected: Expected start of the callback before; None for the first.
        last_real: Its actual start.
        current_expected: Expected start of this one.
        current_real: Its actual start.
        last_duration: Duration of the one before [s of wall time].
    """

    last_expected: values.Time | None
    last_real: values.Time | None
    current_expected: values.Time
    current_real: values.Time
    last_duration: float | None


class Timer(threading.Thread):
    """Calls back at a rate, until `shutdown` or the end of the node.

    Args:
        period: Between calls.
        callback: Called with a `TimerEvent`, on this thread.
        oneshot: Call once.
        reset: Start again after a jump back of simulated time; otherwise the thread ends.
    """

    def __init__(
        self,
        period: values.Duration,
        callback: Callable[[TimerEvent], Any],
        oneshot: bool = False,  # noqa: FBT001, FBT002  # rospy's interface
        reset: bool = False,  # noqa: FBT001, FBT002
    ) -> None:
        super().__init__(daemon=True)
        self._period = period
        self._callback = callback
        self._oneshot = oneshot
        self._reset = reset
        self._shutdown = False
        self.start()

    def shutdown(self) -> None:
        """Call no more."""
        self._shutdown = True

    def _stopped(self) -> bool:
        return self._shutdown or process.shutdown.is_set()

    def run(self) -> None:
        """Run the timer's thread."""
        rate = Rate(1.0 / self._period.to_sec(), reset=self._reset)
        expected: values.Time = get_rostime() + self._period
        last: tuple[values.Time | None, values.Time | None, float | None] = (None, None, None)
        while not self._stopped():
            try:
                rate.sleep()
            except ROSTimeMovedBackwardsException:
                raise
            except ROSInterruptException:
                return
            if self._stopped():
                return
            real: Time = get_rostime()
            begin = time.monotonic()
            self._callback(TimerEvent(last[0], last[1], expected, real, last[2]))
            if self._oneshot:
                return
            last = (expected, real, time.monotonic() - begin)
            expected = expected + self._period
