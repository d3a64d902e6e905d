"""Play bags: publish recorded messages at their times."""

from __future__ import annotations

import heapq
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

from gazelle_ros import names
from gazelle_ros.bags.bag import Bag
from gazelle_ros.bags.reader import RawBagMessage, messages_of
from gazelle_ros.bags.records import Connection
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import rosgraph_msgs
from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher
from gazelle_ros.raw import RawMessage
from gazelle_ros.time import Time

_SLICE_S = 0.05
"""Interval at which it checks whether to pause or end."""
_SETTLE_S = 0.2
"""Time for new subscribers before the first message."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlayOptions:
    """Options for playing bags."""

    rate: float = 1.0
    """Times faster than it was recorded."""
    start: float = 0.0
    """Seconds after the beginning of the bags."""
    duration: float | None = None
    """Seconds of the bags; None for all."""
    loop: bool = False
    immediate: bool = False
    """As fast as possible."""
    paused: bool = False
    """Wait for `Player.toggle` before the first message."""
    delay: float = 0.2
    """Seconds between advertising and publishing, for subscribers to connect."""
    clock: bool = False
    """Publish ``/clock``."""
    clock_hertz: float = 100.0
    queue_size: int = 100
    topics: Sequence[str] = ()
    """Only these; all if empty."""
    pause_topics: Sequence[str] = ()
    """Pause before each message of these."""
    prefix: str = ""
    """Goes before the names of topics."""
    skip_empty: float | None = None
    """Jump over gaps of more than a given number of seconds."""
    wait_for_subscribers: bool = False
    keep_alive: bool = False
    """Stay after the end, for latched messages."""


class Player:
    """Plays bags.

    Args:
        node: Publishes; it must not run on simulated time.
        paths: The bags.
        options: Options of playing.
        show: Called with the state at times: ``RUNNING``, ``PAUSED`` or ``DELAYED``, the bags' time
            and what passed of it, both in seconds.
    """

    def __init__(
        self,
        node: Node,
        paths: Sequence[str],
        options: PlayOptions,
        show: Callable[[str, float, float], None] | None = None,
    ) -> None:
        self._node = node
        self._options = options
        self._show = show
        self._files = ExitStack()
        self._bags = [self._files.enter_context(Bag(path)) for path in paths]
        topics = {topic.lstrip("/") for topic in options.topics}
        self._pausing = {topic.lstrip("/") for topic in options.pause_topics}
        self._wanted = [
            {
                each.id
                for each in bag.index.connections.values()
                if not topics or each.topic.lstrip("/") in topics
            }
            for bag in self._bags
        ]
        self._publishers: dict[tuple[str, str], Publisher] = {}
        self._clock: Publisher | None = None
        self._clock_class: Any = None
        self._ticked = 0.0
        self._running = threading.Event()
        self._step = threading.Event()
        if not options.paused:
            self._running.set()

    def close(self) -> None:
        """Close the bags."""
        self._files.close()

    def toggle(self) -> None:
        """Pause or resume."""
        if self._running.is_set():
            self._running.clear()
        else:
            self._running.set()

    def step(self) -> None:
        """Publish one message while paused."""
        self._step.set()

    def play(self, stop: threading.Event) -> None:
        """Play until the end or until `stop` is set."""
        if not any(bag.get_message_count() for bag in self._bags):
            return
        self._advertise()
        stop.wait(self._options.delay)
        if self._options.wait_for_subscribers:
            self._wait_for_subscribers(stop)
        start = self._first_ns() + round(self._options.start * SECOND)
        while not stop.is_set():
            self._play_once(start, stop)
            if not self._options.loop:
                break
        if self._options.keep_alive:
            stop.wait()

    def _first_ns(self) -> int:
        """Return the time of the first message of all bags; seconds as a float would round it."""
        return min(
            chunk.start for bag in self._bags if bag.get_message_count() for chunk in bag.chunks()
        )

    # Before ------------------------------------------------------------------------------

    def _advertise(self) -> None:
        for bag, selected in zip(self._bags, self._wanted, strict=True):
            for connection in bag.index.connections.values():
                key = (connection.topic, connection.md5sum)
                if connection.id in selected and key not in self._publishers:
                    self._publishers[key] = self._publisher(connection)
        if self._options.clock:
            self._clock_class = rosgraph_msgs.msg.Clock
            self._clock = self._node.advertise("/clock", self._clock_class, queue_size=1)

    def _publisher(self, connection: Connection) -> Publisher:
        header = connection.header
        made = type(
            "Recorded",
            (RawMessage,),
            {
                "__slots__": (),
                "_type": connection.type,
                "_md5sum": connection.md5sum,
                "_full_text": header.get("message_definition", ""),
            },
        )
        prefix = self._options.prefix
        name = names.canonical(f"{prefix}/{connection.topic}") if prefix else connection.topic
        return self._node.advertise(
            name,
            made,
            queue_size=None if self._options.immediate else self._options.queue_size,
            latch=header.get("latching") == "1",
        )

    def _wait_for_subscribers(self, stop: threading.Event) -> None:
        while not stop.is_set():
            if all(each.num_connections for each in self._publishers.values()):
                # A rospy subscriber drops what comes before it has noted its callback.
                stop.wait(_SETTLE_S)
                return
            stop.wait(_SLICE_S)

    # Playing -----------------------------------------------------------------------------

    def _entries(self, start: int) -> Iterator[RawBagMessage]:
        duration = self._options.duration
        end = None if duration is None else start + round(duration * SECOND)
        streams = [
            messages_of(bag.stored(), bag.index, selected, start, end)
            for bag, selected in zip(self._bags, self._wanted, strict=True)
        ]
        return heapq.merge(*streams, key=lambda entry: entry.time)

    def _play_once(self, start: int, stop: threading.Event) -> None:
        pace = _Pace(start, self._options.rate)
        previous = start
        for entry in self._entries(start):
            self._skip_gap(pace, entry.time - previous)
            previous = entry.time
            if entry.connection.topic.lstrip("/") in self._pausing:
                self._running.clear()
            if not self._wait_until(entry.time, pace, stop):
                return
            key = (entry.connection.topic, entry.connection.md5sum)
            publisher = self._publishers[key]
            publisher.publish(publisher.message_class(entry.data))
            if self._options.immediate:
                self._tick(entry.time)

    def _skip_gap(self, pace: _Pace, gap: int) -> None:
        limit = self._options.skip_empty
        if limit is not None and gap > limit * SECOND:
            pace.skip(gap)

    def _wait_until(self, target: int, pace: _Pace, stop: threading.Event) -> bool:
        """Wait for a time of the bags; false if it is to end."""
        while not stop.is_set():
            if not self._running.is_set():
                if not self._hold(pace, target, stop):
                    return not stop.is_set()
                continue
            if self._options.immediate:
                return True
            left = pace.left(target)
            now = min(pace.now(), target)
            self._tick(now)
            if left <= 0.0:
                self._report("RUNNING", now, pace)
                return True
            step = 1.0 / self._options.clock_hertz if self._clock is not None else _SLICE_S
            stop.wait(min(left, step, _SLICE_S))
        return False

    def _hold(self, pace: _Pace, target: int, stop: threading.Event) -> bool:
        """Wait while paused; false if one message is to go out, or it is to end."""
        paused = time.monotonic()
        while not self._running.wait(_SLICE_S):
            self._report("PAUSED", min(pace.now(), target), pace)
            if self._step.is_set():
                self._step.clear()
                pace.jump_to(target)
                return False
            if stop.is_set():
                return False
            pace.hold(time.monotonic() - paused)
            paused = time.monotonic()
        pace.hold(time.monotonic() - paused)
        return True

    def _tick(self, now: int) -> None:
        """Publish the time, as often as asked for."""
        wall = time.monotonic()
        if self._clock is None or wall - self._ticked < 1.0 / self._options.clock_hertz:
            return
        self._ticked = wall
        seconds, nanoseconds = divmod(now, SECOND)
        self._clock.publish(self._clock_class(clock=Time(seconds, nanoseconds)))

    def _report(self, state: str, now: int, pace: _Pace) -> None:
        if self._show is not None:
            self._show(state, now / SECOND, (now - pace.start) / SECOND)


class _Pace:
    """From wall time to the bags' time.

    Args:
        start: The bags' time now [ns].
        rate: Seconds of the bags in a second.
    """

    def __init__(self, start: int, rate: float) -> None:
        self.start = start
        self._rate = rate
        self._wall = time.monotonic()

    def now(self) -> int:
        """Return the bags' time [ns]."""
        passed = (time.monotonic() - self._wall) * self._rate
        return self.start + round(passed * SECOND)

    def left(self, target: int) -> float:
        """Return seconds of wall time until a time of the bags [ns]."""
        due = self._wall + (target - self.start) / SECOND / self._rate
        return due - time.monotonic()

    def hold(self, seconds: float) -> None:
        """Shift the time by a pause of so long."""
        self._wall += seconds

    def skip(self, nanoseconds: int) -> None:
        """Advance the bags' time by a jump."""
        self._wall -= nanoseconds / SECOND / self._rate

    def jump_to(self, target: int) -> None:
        """Set the bags' time [ns]."""
        self._wall = time.monotonic() - (target - self.start) / SECOND / self._rate
