"""Rates, sizes and delays of messages."""

from __future__ import annotations

import functools
import math
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any, TextIO

from gazelle_ros.raw import RawMessage
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.watching import PeriodicReport, tool_node, wait_for_topic
from gazelle_ros.typed import decode

_MOST = 50_000
_NOTHING = "no new messages"
_COLUMNS = ("topic", "rate", "min_delta", "max_delta", "std_dev", "window")


def statistics(values: Sequence[float]) -> tuple[float, float, float, float]:
    """Return mean, smallest, largest and standard deviation of values; there is at least one."""
    mean = sum(values) / len(values)
    spread = math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))
    return mean, min(values), max(values), spread


def _last(window: int) -> deque[float]:
    """Return a queue for the gaps between the last events, or between nearly all."""
    return deque(maxlen=_MOST if window < 0 else min(max(1, window - 1), sys.maxsize))


class RateMeter:
    """Measures the time between events.

    Args:
        window: Number of latest events; below 0 for nearly all.
    """

    def __init__(self, window: int = -1) -> None:
        self._gaps: deque[float] = _last(window)
        self._last: float | None = None
        self._shown: float | None = None
        self._lock = threading.Lock()

    def add(self, now: float) -> bool:
        """Add an event at a time [s]; false if time went back, and everything starts again."""
        with self._lock:
            steady = self._last is None or now >= self._last
            if self._last is None or not steady:
                self._gaps.clear()
            else:
                self._gaps.append(now - self._last)
            self._last = now
            return steady

    def read(self) -> tuple[float, float, float, float, int] | None:
        """Return rate [Hz], smallest, largest and spread of gaps [s], and the number of events.

        None if there was no event since the last time.
        """
        with self._lock:
            if not self._gaps or self._last == self._shown:
                return None
            self._shown = self._last
            mean, least, most, spread = statistics(self._gaps)
            return 1.0 / mean if mean > 0.0 else 0.0, least, most, spread, len(self._gaps) + 1


def measure_rates(
    graph: GraphInspector,
    topics: Sequence[str],
    out: TextIO,
    stop: threading.Event,
    *,
    window: int = -1,
    keep: Callable[[Any], bool] | None = None,
    wall_time: bool = False,
    tcp_nodelay: bool = False,
) -> None:
    """Write the rates of topics every second until `stop` is set.

    Args:
        graph: The graph.
        topics: Their names.
        out: Gets the text.
        stop: Ends it.
        window: Number of messages.
        keep: Condition of the counted messages; all if None.
        wall_time: Measure wall time even where time is simulated.
        tcp_nodelay: Request it.
    """
    meters: dict[str, RateMeter] = {}
    with tool_node(graph) as node:

        def count(meter: RateMeter, raw: RawMessage) -> None:
            if keep is not None and not keep(decode(raw)):
                return
            now = time.time() if wall_time else node.clock.now() / 1e9
            if now and not meter.add(now):
                out.write("time has reset, resetting counters\n")

        for name in topics:
            found = wait_for_topic(graph, name, stop)
            if found is None:
                return
            meter = meters[name] = RateMeter(window)
            node.subscribe(
                found[0], RawMessage, functools.partial(count, meter), tcp_nodelay=tcp_nodelay
            )
            _begin(out, found[0])
        if node.clock.simulated and not wall_time:
            sys.stderr.write("WARNING: may be using simulated time\n")
        PeriodicReport(stop).run(lambda: _show_rates(meters, out))


def _begin(out: TextIO, topic: str) -> None:
    out.write(f"subscribed to [{topic}]\n")
    out.flush()


def _show_rates(meters: dict[str, RateMeter], out: TextIO) -> None:
    read = {topic: found for topic, meter in meters.items() if (found := meter.read())}
    if not read:
        out.write(f"{_NOTHING}\n")
    elif len(meters) == 1:
        rate, least, most, spread, count = next(iter(read.values()))
        out.write(f"average rate: {rate:.3f}\n{_spread(least, most, spread, count)}\n")
    else:
        rows = [
            [topic, *(f"{value:.4}" for value in found[:4]), str(found[4])]
            for topic, found in read.items()
        ]
        out.write(_table(rows))
    out.flush()


def _spread(least: float, most: float, spread: float, count: int) -> str:
    return f"\tmin: {least:.3f}s max: {most:.3f}s std dev: {spread:.5f}s window: {count}"


def _table(rows: list[list[str]]) -> str:
    widths = [
        max(len(title), *(len(row[number]) for row in rows))
        for number, title in enumerate(_COLUMNS)
    ]
    head = "   ".join(title.center(width) for title, width in zip(_COLUMNS, widths, strict=True))
    lines = [
        "   ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        for row in rows
    ]
    return "\n".join([head, "=" * len(head), *lines]) + "\n\n"


class SizeMeter:
    """Measures bytes per second.

    Args:
        window: Number of messages.
    """

    def __init__(self, window: int = 100) -> None:
        self._events: deque[tuple[float, int]] = deque(
            maxlen=min(window, sys.maxsize) if window > 0 else 100
        )
        self._lock = threading.Lock()

    def add(self, now: float, size: int) -> None:
        """Add a message of `size` bytes at a time [s]."""
        with self._lock:
            self._events.append((now, size))

    def text(self, now: float) -> str:
        """Describe the measurements; empty before the second message."""
        with self._lock:
            events = list(self._events)
        if len(events) < 2:
            return ""
        sizes = [size for _, size in events]
        speed = sum(sizes) / max(now - events[0][0], 1e-9)
        unit, scale = ("B", 1.0) if speed < 1e3 else ("KB", 1e3) if speed < 1e6 else ("MB", 1e6)
        mean = sum(sizes) / len(sizes)
        shown = [f"{value / scale:.2f}{unit}" for value in (speed, mean, min(sizes), max(sizes))]
        return (
            f"average: {shown[0]}/s\n"
            f"\tmean: {shown[1]} min: {shown[2]} max: {shown[3]} window: {len(sizes)}\n"
        )


def measure_size(
    graph: GraphInspector, name: str, out: TextIO, stop: threading.Event, *, window: int = 100
) -> None:
    """Write the bytes per second of a topic every second until `stop` is set."""
    found = wait_for_topic(graph, name, stop)
    if found is None:
        return
    meter = SizeMeter(window)
    with tool_node(graph) as node:
        node.subscribe(
            found[0],
            RawMessage,
            lambda raw: meter.add(time.monotonic(), len(raw._buff)),  # rospy's name
        )
        _begin(out, found[0])

        def show() -> None:
            out.write(meter.text(time.monotonic()))
            out.flush()

        PeriodicReport(stop).run(show)


def measure_delay(
    graph: GraphInspector,
    name: str,
    out: TextIO,
    stop: threading.Event,
    *,
    window: int = -1,
    tcp_nodelay: bool = False,
) -> None:
    """Write how old the stamps of messages are, every second until `stop` is set.

    Raises:
        ToolError: The messages have no header.
    """
    found = wait_for_topic(graph, name, stop)
    if found is None:
        return
    delays: deque[float] = _last(window)
    fresh = threading.Event()
    failed: list[ToolError] = []
    with tool_node(graph) as node:

        def count(raw: RawMessage) -> None:
            message = decode(raw)
            if not message._has_header:
                failed.append(ToolError(f"messages of {found[0]} have no header"))
                stop.set()
                return
            delays.append((node.clock.now() - message.header.stamp.to_nsec()) / 1e9)
            fresh.set()

        node.subscribe(found[0], RawMessage, count, tcp_nodelay=tcp_nodelay)
        _begin(out, found[0])
        PeriodicReport(stop).run(lambda: _show_delay(delays, fresh, out))
    if failed:
        raise failed[0]


def _show_delay(delays: deque[float], fresh: threading.Event, out: TextIO) -> None:
    known = list(delays)
    if not known:
        return
    if fresh.is_set():
        fresh.clear()
        mean, least, most, spread = statistics(known)
        text = _spread(least, most, spread, len(known) + 1)
        out.write(f"average delay: {mean:.3f}\n{text}\n")
    else:
        out.write(f"{_NOTHING}\n")
    out.flush()
