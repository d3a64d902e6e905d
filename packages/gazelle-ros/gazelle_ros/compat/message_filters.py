"""Matches messages of several topics by their times."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros.compat.rospy.logs import logwarn_throttle
from gazelle_ros.compat.rospy.rostime import get_rostime, is_wallclock
from gazelle_ros.compat.rospy.topics import Subscriber as TopicSubscriber
from gazelle_ros.messages import Message
from gazelle_ros.time import Duration, Time

Callback = Callable[..., Any]
Queue = dict[Time, Any]


class SimpleFilter:
    """Passes messages on to callbacks."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callback, tuple[Any, ...]]] = {}
        self._count = itertools.count()

    def registerCallback(self, cb: Callback, *args: Any) -> int:  # noqa: N802  # message_filters' names
        """Call a function with each message, and `args` after it; returns its number."""
        number = next(self._count)
        self.callbacks[number] = (cb, args)
        return number

    def signalMessage(self, *msg: Any) -> None:  # noqa: N802
        """Send messages to the callbacks."""
        for callback, arguments in list(self.callbacks.values()):
            callback(*(msg + arguments))


class Subscriber(SimpleFilter):
    """Passes on the messages of a topic; arguments as those of ``rospy.Subscriber``."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.topic = args[0] if args else kwargs["name"]
        kwargs["callback"] = self.callback
        self.sub = TopicSubscriber(*args, **kwargs)

    def callback(self, msg: Message) -> None:
        """Forward a message."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802
        """Return the name of the topic."""
        return str(self.topic)

    def unregister(self) -> None:
        """Unsubscribe."""
        self.sub.unregister()

    def __getattr__(self, key: str) -> Any:
        """Return the name, type and so on of the subscriber."""
        if key == "sub":
            raise AttributeError(key)
        return getattr(self.sub, key)


def _stamp(message: Any, *, headerless: bool) -> Time | None:
    """Return the time of a message: its header's, or if that is allowed, now."""
    if hasattr(message, "header") and hasattr(message.header, "stamp"):
        stamp: Time = message.header.stamp
        return stamp
    if headerless:
        return get_rostime()
    logwarn_throttle(10.0, "Cannot use message filters with non-stamped messages.")
    return None


class Cache(SimpleFilter):
    """Keeps the last messages of a filter.

    Args:
        f: The filter.
        cache_size: Size of the cache.
        allow_headerless: Stamp messages without a header when they come.
    """

    def __init__(
        self,
        f: SimpleFilter,
        cache_size: int = 1,
        allow_headerless: bool = False,  # noqa: FBT001, FBT002  # message_filters' interface
    ) -> None:
        super().__init__()
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Time] = []
        self.connectInput(f)

    def connectInput(self, f: SimpleFilter) -> None:  # noqa: N802
        """Add a filter and keep its messages."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Message) -> None:
        """Store a message, and forward it."""
        stamp = _stamp(msg, headerless=self.allow_headerless)
        if stamp is None:
            return
        place = len(self.cache_times)
        while place and self.cache_times[place - 1] > stamp:
            place -= 1
        self.cache_msgs.insert(place, msg)
        self.cache_times.insert(place, stamp)
        if len(self.cache_msgs) > self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]:  # noqa: N802
        """Return the messages from one time to another, both included."""
        return [m for t, m in self._pairs() if from_stamp <= t <= to_stamp]

    def getElemAfterTime(self, stamp: Time) -> Any:  # noqa: N802
        """Return the oldest message not older than a time; None if there is none."""
        return next((m for t, m in self._pairs() if t >= stamp), None)

    def getElemBeforeTime(self, stamp: Time) -> Any:  # noqa: N802
        """Return the latest message not later than a time; None if there is none."""
        return next((m for t, m in reversed(self._pairs()) if t <= stamp), None)

    def getLastestTime(self) -> Time | None:  # noqa: N802
        """Return the time of the latest message; None if there is none."""
        return self.cache_times[-1] if self.cache_times else None

    getLatestTime = getLastestTime  # noqa: N815

    def getOldestTime(self) -> Time | None:  # noqa: N802
        """Return the time of the oldest message; None if there is none."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:  # noqa: N802
        """Return the latest message; None if there is none."""
        return self.cache_msgs[-1] if self.cache_msgs else None

    def _pairs(self) -> list[tuple[Time, Any]]:
        return list(zip(self.cache_times, self.cache_msgs, strict=True))


class TimeSynchronizer(SimpleFilter):
    """Passes on messages of several filters that have the very same time.

    Args:
        fs: The filters.
        queue_size: Longest queue of each.
        reset: Forget those that wait when time jumps back.
    """

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        reset: bool = False,  # noqa: FBT001, FBT002  # message_filters' interface
    ) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.enable_reset = reset
        self._last_time = Time(0)
        self.lock = threading.Lock()
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[SimpleFilter]) -> None:  # noqa: N802
        """Match the messages of other filters."""
        self.queues: list[Queue] = [{} for _ in fs]
        self.input_connections = [
            f.registerCallback(self.add, queue, place)
            for place, (f, queue) in enumerate(zip(fs, self.queues, strict=True))
        ]

    def add(self, msg: Any, my_queue: Queue, my_queue_index: int | None = None) -> None:
        """Add a message of a filter."""
        del my_queue_index
        with self.lock:
            if self.enable_reset:
                self._forget_after_jump()
            self._keep(msg, msg.header.stamp, my_queue)
            common = set(self.queues[0]).intersection(*self.queues[1:])
            for stamp in sorted(common):
                self.signalMessage(*(queue.pop(stamp) for queue in self.queues))

    def _forget_after_jump(self) -> bool:
        """Discard waiting messages if simulated time jumped back; returns whether it did."""
        if is_wallclock():
            return False
        now = get_rostime()
        jumped = now < self._last_time
        self._last_time = now
        if jumped:
            for queue in self.queues:
                queue.clear()
        return jumped

    def _keep(self, msg: Message, stamp: Time, queue: Queue) -> None:
        queue[stamp] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on messages of several filters with close times.

    Args:
        fs: The filters.
        queue_size: Longest queue of each.
        slop: Largest difference of stamps [s].
        allow_headerless: Stamp messages without a header when they come.
        reset: Forget those that wait when time jumps back.
    """

    def __init__(
        self,
        fs: Sequence[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,  # noqa: FBT001, FBT002  # message_filters' interface
        reset: bool = False,  # noqa: FBT001, FBT002
    ) -> None:
        super().__init__(fs, queue_size, reset)
        self.slop = Duration.from_sec(slop)
        self.allow_headerless = allow_headerless

    def add(self, msg: Message, my_queue: Queue, my_queue_index: int | None = None) -> None:
        """Add a message of a filter; the first after time jumped back is left out."""
        del my_queue_index
        stamp = _stamp(msg, headerless=self.allow_headerless)
        if stamp is None:
            return
        with self.lock:
            if self._forget_after_jump():
                return
            self._keep(msg, stamp, my_queue)
            choices = []
            for queue in self.queues:
                near = [stamp] if queue is my_queue else self._near(queue, stamp)
                if not near:
                    return
                choices.append(near)
            for stamps in itertools.product(*choices):
                if max(stamps) - min(stamps) <= self.slop:
                    self._match(stamps)
                    return

    def _near(self, queue: Queue, stamp: Time) -> list[Time]:
        """Return the times in a queue that are close to another, the closest first."""
        gaps = ((abs(each - stamp), each) for each in queue)
        return [each for _, each in sorted(pair for pair in gaps if pair[0] <= self.slop)]

    def _match(self, stamps: tuple[Time, ...]) -> None:
        if all(stamp in queue for queue, stamp in zip(self.queues, stamps, strict=True)):
            pairs = zip(self.queues, stamps, strict=True)
            self.signalMessage(*[queue.pop(stamp) for queue, stamp in pairs])
