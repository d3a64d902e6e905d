"""Delays of ``tf_monitor``: the age of transforms on arrival, and their rates."""

from __future__ import annotations

import threading
import time
from collections import defaultdict, deque
from collections.abc import Sequence
from typing import Any

from gazelle_ros.compat import rospy
from gazelle_ros.compat.tf2_ros import TransformException
from gazelle_ros.msgs import tf2_msgs

_KEPT = 1000


class Delays:
    """Listens to ``/tf`` and ``/tf_static``.

    Args:
        buffer: Knows the tree.
        ends: Two frames, to watch those on the way between them; empty for all.
    """

    def __init__(self, buffer: Any, ends: Sequence[str]) -> None:
        self._buffer = buffer
        self._ends = list(ends)
        self._lock = threading.Lock()
        self._frames: dict[str, deque[float]] = defaultdict(lambda: deque(maxlen=_KEPT))
        self._nodes: dict[str, deque[float]] = defaultdict(lambda: deque(maxlen=_KEPT))
        self._times: dict[str, deque[float]] = defaultdict(lambda: deque(maxlen=_KEPT))
        self._senders: dict[str, str] = {}
        self._net: deque[float] = deque(maxlen=_KEPT)
        kind = tf2_msgs.msg.TFMessage
        self._subscribers = [
            rospy.Subscriber("/tf", kind, self._take, False),  # rospy's interface
            rospy.Subscriber("/tf_static", kind, self._take, True),
        ]

    def close(self) -> None:
        """Unsubscribe."""
        for each in self._subscribers:
            each.unregister()

    def report(self) -> str:
        """Return a report of the measurements so far."""
        chain = self._chain()
        with self._lock:
            lines = ["", f"RESULTS: for {' to '.join(self._ends) or 'all Frames'}"]
            if chain:
                lines += [f"Chain is: {' -> '.join(chain)}", f"Net delay     {_both(self._net)}"]
            lines += ["", "Frames:"]
            lines += [
                f"Frame: {frame} published by {self._senders[frame]} {_words(delays)}"
                for frame, delays in sorted(self._frames.items())
                if not self._ends or frame in chain
            ]
            lines += ["", "All Broadcasters:"]
            lines += [
                f"Node: {node} {_rate(self._times[node]):g} Hz, {_words(delays)}"
                for node, delays in sorted(self._nodes.items())
            ]
        return "\n".join(lines)

    def _take(self, message: tf2_msgs.msg.TFMessage, static: bool) -> None:  # noqa: FBT001  # rospy's interface
        sender = message._connection_header.get("callerid", "?")
        node = f"{sender}(static)" if static else sender
        now = rospy.get_time()
        ages = {
            each.child_frame_id.lstrip("/"): 0.0 if static else now - each.header.stamp.to_sec()
            for each in message.transforms
        }
        if not ages:
            return
        net = self._age_of_all(now)
        with self._lock:
            for frame, age in ages.items():
                self._frames[frame].append(age)
                self._senders[frame] = node
            self._nodes[node].append(sum(ages.values()) / len(ages))
            self._times[node].append(time.monotonic())
            if net is not None:
                self._net.append(net)

    def _age_of_all(self, now: float) -> float | None:
        """Return the age of the latest transform over the whole chain; None if unknown."""
        if not self._ends:
            return None
        try:
            latest: Any = self._buffer.get_latest_common_time(*self._ends)
        except TransformException:
            return None
        return now - float(latest.to_sec()) if latest else 0.0

    def _chain(self) -> list[str]:
        if not self._ends:
            return []
        first, last = self._ends
        try:
            return list(reversed(self._buffer.tree.chain(first, 0, last, 0, first)))
        except TransformException:
            return []


def _both(values: deque[float]) -> str:
    mean = sum(values) / len(values) if values else 0.0
    return f"avg = {mean:g}: max = {max(values, default=0.0):g}"


def _words(values: deque[float]) -> str:
    return f"Average Delay: {sum(values) / len(values):g} Max Delay: {max(*values, 0.0):g}"


def _rate(times: deque[float]) -> float:
    """Return the rate in wall time [Hz]; 0 for a single event."""
    length = times[-1] - times[0]
    return (len(times) - 1) / length if length > 0.0 else 0.0
