"""Topic statistics: what subscribers measure and publish on ``/statistics``.

On when the parameter ``/enable_statistics`` is true as a node starts. Meaning of the figures
and of the window parameters: http://wiki.ros.org/Topics#Topic_statistics.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence
from typing import Any

from gazelle_ros.clock import SECOND
from gazelle_ros.messages import Message
from gazelle_ros.msgs import rosgraph_msgs
from gazelle_ros.node_base import NodeBase
from gazelle_ros.publishing import Publisher

TOPIC = "/statistics"
_UNMEASURED = frozenset({TOPIC, "/clock", "/rosout", "/rosout_agg"})


class _Window:
    """Measurements of one connection since the last report."""

    def __init__(self, now: int) -> None:
        self.start = now
        self.arrivals: list[int] = []
        self.ages: list[int] = []
        self.bytes = 0
        self.dropped = 0
        self.last_sequence: int | None = None

    def add(self, now: int, message: Any, size: int) -> None:
        """Add a message."""
        self.arrivals.append(now)
        self.bytes += size
        if not getattr(type(message), "_has_header", False):
            return
        stamp, sequence = message.header.stamp, message.header.seq
        self.ages.append(now - (stamp.secs * SECOND + stamp.nsecs))
        if self.last_sequence is not None and sequence > self.last_sequence + 1:
            self.dropped += sequence - self.last_sequence - 1
        self.last_sequence = sequence

    def reset(self, now: int) -> None:
        """Start a new window."""
        self.start = now
        self.arrivals.clear()
        self.ages.clear()
        self.bytes = self.dropped = 0


class Statistics:
    """Measures the subscriptions of one node.

    Args:
        node: The owner.
        publisher: Of what was measured, a `message_class`.
    """

    def __init__(self, node: NodeBase, publisher: Publisher) -> None:
        self._node = node
        self._lock = threading.Lock()
        self._windows: dict[tuple[str, str], _Window] = {}
        self._lengths: dict[tuple[str, str], int] = {}
        self._fewest, self._most = self._setting("elements", 10, 100)
        shortest, longest = self._setting("size", 4.0, 64.0)
        self._shortest, self._longest = round(shortest * SECOND), round(longest * SECOND)
        self._class = publisher.message_class
        self._publisher = publisher

    def _setting(self, name: str, least: float, most: float) -> tuple[float, float]:
        get = self._node.parameters.get
        lower = float(get(f"/statistics_window_min_{name}", least))
        upper = float(get(f"/statistics_window_max_{name}", most))
        return lower, upper

    def measures(self, topic: str) -> bool:
        """Return False for topics that would only measure themselves."""
        return topic not in _UNMEASURED

    def take(self, topic: str, link: Any, message: Message, size: int) -> None:
        """Count a message of a link; report when the window is full."""
        now = self._node.clock.now()
        key = topic, str(link.peer)
        with self._lock:
            window = self._windows.get(key)
            if window is None:
                window = self._windows[key] = _Window(now)
                self._lengths[key] = self._shortest
            window.add(now, message, size)
            if now - window.start < self._lengths[key]:
                return
            report = self._report(key, window, now)
            self._adapt(key, len(window.arrivals))
            window.reset(now)
        if not self._node.closed:
            self._publisher.publish(report)

    def _adapt(self, key: tuple[str, str], count: int) -> None:
        """Set longer windows for rare messages, shorter ones for frequent ones."""
        length = self._lengths[key]
        if count > self._most and length // 2 >= self._shortest:
            self._lengths[key] = length // 2
        elif count < self._fewest and length * 2 <= self._longest:
            self._lengths[key] = length * 2

    def _report(self, key: tuple[str, str], window: _Window, now: int) -> Any:
        message = self._class()
        message.topic, message.node_pub = key
        message.node_sub = self._node.name
        _set(message.window_start, window.start)
        _set(message.window_stop, now)
        message.delivered_msgs = len(window.arrivals)
        message.dropped_msgs = window.dropped
        message.traffic = min(window.bytes, 2**31 - 1)
        pairs = zip(window.arrivals, window.arrivals[1:], strict=False)
        _fill(message, "period", [late - early for early, late in pairs])
        _fill(message, "stamp_age", window.ages)
        return message


def _fill(message: rosgraph_msgs.msg.TopicStatistics, name: str, values: Sequence[int]) -> None:
    """Set mean, standard deviation and maximum, as durations."""
    if not values:
        return
    mean = sum(values) / len(values)
    spread = math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))
    _set(getattr(message, f"{name}_mean"), round(mean))
    _set(getattr(message, f"{name}_stddev"), round(spread))
    _set(getattr(message, f"{name}_max"), max(values))


def _set(value: Any, nanoseconds: int) -> None:
    seconds, rest = divmod(nanoseconds, SECOND)
    value.set(seconds, rest)


def message_class() -> Any:
    """Return the class of the messages on `TOPIC`."""
    return rosgraph_msgs.msg.TopicStatistics
