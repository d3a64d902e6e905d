"""Tasks on the frequency and the age of messages."""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.drop_in.diagnostic_updater.status import ERROR, OK, WARN, DiagnosticStatusWrapper
from gazelle_ros.drop_in.diagnostic_updater.updater import CompositeDiagnosticTask, DiagnosticTask


@dataclass
class FrequencyStatusParam:
    """Limits of a frequency.

    Attributes:
        freq_bound: ``min`` and perhaps ``max`` [Hz].
        tolerance: Share by which they may be missed.
        window_size: So many reports ago the count begins.
    """

    freq_bound: Any
    tolerance: float = 0.1
    window_size: int = 5


class FrequencyStatus(DiagnosticTask):
    """Task that compares the frequency of an event, noted by ``tick``, with limits."""

    def __init__(self, params: FrequencyStatusParam, name: str = "FrequencyStatus") -> None:
        super().__init__(name)
        self.params, self.lock = params, threading.RLock()
        self.clear()

    def clear(self) -> None:
        """Clear the events."""
        with self.lock:
            self.count = 0
            first = (rospy.get_rostime(), 0)
            size = self.params.window_size
            self._window: deque[Any] = deque([first] * size, maxlen=size)

    def tick(self) -> None:
        """Count an event."""
        with self.lock:
            self.count += 1

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Compare the frequency with its limits."""
        with self.lock:
            begun, before = self._window[0]
            now, events = rospy.get_rostime(), self.count - before
            self._window.append((now, self.count))
            total = self.count
        window = (now - begun).to_sec()
        frequency = events / window if window > 0.0 else 0.0
        bound, slack = self.params.freq_bound, self.params.tolerance
        least = bound["min"] * (1.0 - slack)
        most = bound["max"] * (1.0 + slack) if "max" in bound else None
        if not events:
            stat.summary(ERROR, "No events recorded.")
        elif frequency < least:
            stat.summary(WARN, "Frequency too low.")
        elif most is not None and frequency > most:
            stat.summary(WARN, "Frequency too high.")
        else:
            stat.summary(OK, "Desired frequency met")
        stat.add("Events in window", events)
        stat.add("Events since startup", total)
        stat.add("Duration of window (s)", f"{window:f}")
        stat.add("Actual frequency (Hz)", f"{frequency:f}")
        if bound.get("max") == bound["min"]:
            stat.add("Target frequency (Hz)", f"{bound['min']:f}")
        if bound["min"] > 0:
            stat.add("Minimum acceptable frequency (Hz)", f"{least:f}")
        if most is not None:
            stat.add("Maximum acceptable frequency (Hz)", f"{most:f}")
        return stat


@dataclass
class TimeStampStatusParam:
    """Limits of the age of messages [s].

    Attributes:
        min_acceptable: Below zero it is in the future.
        max_acceptable: The oldest.
    """

    min_acceptable: float = -1.0
    max_acceptable: float = 5.0


class TimeStampStatus(DiagnosticTask):
    """Task that compares the age of stamps, taken by ``tick``, with limits."""

    def __init__(
        self, params: TimeStampStatusParam | None = None, name: str = "Timestamp Status"
    ) -> None:
        super().__init__(name)
        self.params, self.lock = params or TimeStampStatusParam(), threading.Lock()
        self.early_count = self.late_count = self.zero_count = 0
        self._ages: list[float] = []
        self._zero = False

    def tick(self, stamp: Any) -> None:
        """Add a stamp: a time, or seconds."""
        seconds = stamp if isinstance(stamp, float) else stamp.to_sec()
        with self.lock:
            if seconds:
                self._ages.append(rospy.get_time() - seconds)
            else:
                self._zero = True

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Compare the ages since the last report with their limits."""
        with self.lock:
            ages, zero = self._ages, self._zero
            self._ages, self._zero = [], False
        least, most = (min(ages), max(ages)) if ages else (0.0, 0.0)
        stat.summary(OK, "Timestamps are reasonable.")
        if not ages:
            stat.summary(WARN, "No data since last update.")
        if ages and least < self.params.min_acceptable:
            stat.summary(ERROR, "Timestamps too far in future seen.")
            self.early_count += 1
        if ages and most > self.params.max_acceptable:
            stat.summary(ERROR, "Timestamps too far in past seen.")
            self.late_count += 1
        if ages and zero:
            stat.summary(ERROR, "Zero timestamp seen.")
            self.zero_count += 1
        stat.add("Earliest timestamp delay:", f"{least:f}")
        stat.add("Latest timestamp delay:", f"{most:f}")
        stat.add("Earliest acceptable timestamp delay:", f"{self.params.min_acceptable:f}")
        stat.add("Latest acceptable timestamp delay:", f"{self.params.max_acceptable:f}")
        stat.add("Late diagnostic update count:", self.late_count)
        stat.add("Early diagnostic update count:", self.early_count)
        stat.add("Zero seen diagnostic update count:", self.zero_count)
        return stat


class Heartbeat(DiagnosticTask):
    """The node is there."""

    def __init__(self) -> None:
        super().__init__("Heartbeat")

    def run(self, stat: DiagnosticStatusWrapper) -> Any:
        """Report that the node is alive."""
        stat.summary(OK, "Alive")
        return stat


class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    """Task on the frequency of a topic's messages.

    Args:
        name: Of the topic.
        diag: The updater that publishes it.
        freq: Limits of the frequency.
    """

    def __init__(self, name: str, diag: Any, freq: FrequencyStatusParam) -> None:
        super().__init__(f"{name} topic status")
        self.diag, self.freq = diag, FrequencyStatus(freq)
        self.addTask(self.freq)
        diag.add(self)

    def tick(self, *_: Any) -> None:
        """Count a message."""
        self.freq.tick()

    def clear_window(self) -> None:
        """Clear the counted messages."""
        self.freq.clear()


class TopicDiagnostic(HeaderlessTopicDiagnostic):
    """Task on the frequency and the age of a topic's messages.

    Args:
        name: Of the topic.
        diag: The updater that publishes it.
        freq: Limits of the frequency.
        stamp: Limits of the age.
    """

    def __init__(
        self, name: str, diag: Any, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(name, diag, freq)
        self.stamp = TimeStampStatus(stamp)
        self.addTask(self.stamp)

    def tick(self, stamp: Any) -> None:
        """Count a message with this stamp."""
        self.stamp.tick(stamp)
        super().tick()


class DiagnosedPublisher(TopicDiagnostic):
    """Publisher that is diagnosed; see `TopicDiagnostic`."""

    def __init__(
        self, pub: Any, diag: Any, freq: FrequencyStatusParam, stamp: TimeStampStatusParam
    ) -> None:
        super().__init__(pub.name, diag, freq, stamp)
        self.publisher = pub

    def publish(self, message: Any) -> None:
        """Publish a message with a header."""
        self.tick(message.header.stamp)
        self.publisher.publish(message)
