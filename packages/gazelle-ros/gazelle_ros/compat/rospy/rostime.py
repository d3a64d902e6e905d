"""The time of the node: of the machine, or simulated."""

from __future__ import annotations

import threading
import time
from typing import Self

from gazelle_ros import time as values
from gazelle_ros.clock import SECOND, SimulatedClock, TimeSource, WallClock
from gazelle_ros.compat.rospy.state import process


class Duration(values.Duration):
    """A span of time; see `gazelle_ros.time.Duration`."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"rospy.Duration[{self.to_nsec()}]"


class Time(values.Time):
    """A point in time; see `gazelle_ros.time.Time`."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"rospy.Time[{self.to_nsec()}]"

    @staticmethod
    def now() -> Time:
        """Return the node's time.

        Raises:
            ROSInitException: There is no node yet.
        """
        return get_rostime()

    @classmethod
    def from_seconds(cls, float_secs: float) -> Self:
        """Return the time at a number of seconds [s]; `from_sec` does the same."""
        return cls.from_sec(float_secs)


def get_rostime() -> Time:
    """Return the node's time; 0 while simulated time did not begin.

    Raises:
        ROSInitException: There is no node yet.
    """
    now = process.clock.now()
    return Time(now // SECOND, now % SECOND)


def get_time() -> float:
    """Return the node's time [s].

    Raises:
        ROSInitException: There is no node yet.
    """
    return process.clock.now() / SECOND


def is_wallclock() -> bool:
    """Return whether the node uses wall time."""
    if process.node is None and process.own_clock is None:
        return True
    return not process.clock.simulated


def is_rostime_initialized() -> bool:
    """Return whether a time source is available."""
    return process.node is not None or process.own_clock is not None


def set_rostime_initialized(val: bool) -> None:  # noqa: FBT001  # rospy's interface
    """Set whether there is a time without a node; if so, it is the machine's."""
    process.own_clock = WallClock() if val else None


def switch_to_wallclock() -> None:
    """Switch to the time of the machine."""
    _set_clock(WallClock())


def wallsleep(duration: float) -> None:
    """Sleep for some time of the machine [s]."""
    time.sleep(max(0.0, duration))


def _set_rostime(moment: values.Time) -> None:
    """Set simulated time by hand."""
    known = process.own_clock if process.node is None else process.node.clock
    clock = known if isinstance(known, SimulatedClock) else SimulatedClock()
    clock.set(moment.to_nsec())
    _set_clock(clock)


def _set_clock(clock: TimeSource) -> None:
    if process.node is None:
        process.own_clock = clock
    else:
        process.node.clock = clock


def get_rostime_cond() -> threading.Condition:
    """Return an unused condition, kept for scripts that only take its lock."""
    return _condition


_condition = threading.Condition()
