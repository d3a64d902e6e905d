"""Subscription of one node to one topic: links to publishers, callbacks, queues."""

from __future__ import annotations

import functools
import threading
import time
from collections.abc import Callable
from typing import Any, Protocol

from gazelle_ros.errors import Md5MismatchError, report
from gazelle_ros.limits import NetworkLimits
from gazelle_ros.loop import EventLoop
from gazelle_ros.messages.base import Message
from gazelle_ros.node_base import NodeBase
from gazelle_ros.peer_reports import PEER_REPORTS
from gazelle_ros.publishing import LocalLink, Publication
from gazelle_ros.raw import RawMessage
from gazelle_ros.serial_queue import SerialQueue
from gazelle_ros.statistics import Statistics
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.frames import frame
from gazelle_ros.tcpros.inbound import InboundLink

Callback = Callable[[Any], None]
Item = tuple[Any, bytes | None, Any]
"""A link, and what came over it: bytes, or a message of this process."""
_LOCAL_BACKLOG = 1000
"""Messages a subscriber in the same process may be behind before the oldest are dropped; over
a network the buffers of the system would hold about as many."""
_LOCAL_PATIENCE_S = 5.0


class Neighbour(Protocol):
    """Another node of this process."""

    def publication(self, topic: str) -> Publication | None:
        """Return its publication on a topic, if any."""


class Subscription:
    """A node's subscribers of one topic, which share connections and decoding.

    Args:
        node: Its node.
        topic: Its resolved name.
        message_class: Of the messages.
        neighbour: Finds a node of this process by its URI.
        statistics: Measures it, if the graph wants that.
    """

    def __init__(
        self,
        node: NodeBase,
        topic: str,
        message_class: Any,
        neighbour: Callable[[str], Neighbour | None],
        statistics: Statistics | None = None,
    ) -> None:
        self._neighbour = neighbour
        self.node = node
        self.topic = topic
        self.message_class = message_class
        self.limits: NetworkLimits = node.limits
        self._most_behind = node.limits.receive_backlog_bytes
        self.tcp_nodelay = False
        self.queue_size: int | None = None
        self.subscribers: tuple[Subscriber, ...] = ()
        self.links: dict[str, InboundLink] = {}
        self.local: dict[str, LocalLink] = {}
        measured = statistics is not None and statistics.measures(topic)
        self._statistics = statistics if measured else None
        self._loop: EventLoop = node.loop
        self._queue = SerialQueue(self._loop, self._deliver, f"callback of {topic}")
        self._drops = threading.Lock()
        self._adding = threading.Lock()
        self.updated = False
        """True when the publishers were notified for the first time."""
        self._closed = False
        self._raw = message_class is RawMessage
        self._marks = hasattr(message_class, "_connection_header")
        self._make = _maker(message_class)

    # Publishers come and go; only on the loop's thread --------------------------------------------

    def update(self, uris: list[str]) -> None:
        """Connect to these publishers, and to no others."""
        if self._closed:
            return
        self.updated = True
        for uri in [uri for uri in self.links if uri not in uris]:
            self.links.pop(uri).close()
        for uri in [uri for uri in self.local if uri not in uris]:
            self._detach(uri)
        for uri in uris:
            if uri not in self.links and uri not in self.local:
                self._link(uri)

    def _link(self, uri: str) -> None:
        neighbour = self._neighbour(uri)
        if neighbour is not None:
            publication = neighbour.publication(self.topic)
            if publication is not None:
                self._attach(uri, publication)
            return  # it is about to register, or gone: an update will come
        link = self.links[uri] = InboundLink(self._loop, self.node.calls, self, self.node.name, uri)
        link.number = self.node.next_number()
        link.open()

    def _attach(self, uri: str, publication: Publication) -> None:
        mine, theirs = self.message_class._md5sum, publication.message_class._md5sum
        if headers.ANY not in {mine, theirs} and mine != theirs:
            kind = publication.message_class._type
            expected = self.message_class._type
            text = f"{self.topic} carries {kind} ({theirs}), not {expected} ({mine})"
            report(f"subscriber of {self.topic}", Md5MismatchError(text))
            return
        # Known before its first message comes: a subscriber added in that message's callback gets it, too.
        link = self.local[uri] = LocalLink(publication, self)
        publication.attach(link)

    def _detach(self, uri: str) -> None:
        link = self.local.pop(uri)
        link.publication.detach(link)

    def lose_local(self, link: LocalLink) -> None:
        """Handle the end of a publisher in this process."""
        for uri in [uri for uri, other in self.local.items() if other is link]:
            del self.local[uri]

    def add(self, subscriber: Subscriber, *, tcp_nodelay: bool) -> None:
        """Add a callback."""
        self.tcp_nodelay |= tcp_nodelay
        with self._adding:
            self.subscribers = (*self.subscribers, subscriber)
            links: list[InboundLink | LocalLink] = [*self.links.values(), *self.local.values()]
            latched = [(link, link.latched) for link in links if link.latched is not None]
        self._measure_queue()
        for link, message in latched:
            self._loop.submit(functools.partial(self._call, subscriber, link, message))

    def remove(self, subscriber: Subscriber) -> None:
        """Remove a callback."""
        self.subscribers = tuple(s for s in self.subscribers if s is not subscriber)
        self._measure_queue()

    def _measure_queue(self) -> None:
        sizes = [subscriber.queue_size for subscriber in self.subscribers]
        self.queue_size = None if None in sizes else max((s for s in sizes if s), default=None)

    def close(self) -> None:
        """Disconnect."""
        self.update([])
        self._closed = True
        self._queue.items.clear()

    # What links need of it -----------------------------------------------------------------

    def request_header(self) -> dict[str, str]:
        """Return the header for a publisher."""
        kind = self.message_class
        return {
            "callerid": self.node.name,
            "md5sum": kind._md5sum,
            "message_definition": kind._full_text,
            "tcp_nodelay": str(int(self.tcp_nodelay)),
            "topic": self.topic,
            "type": kind._type,
        }

    def check_header(self, header: dict[str, str]) -> None:
        """Check the header of a publisher."""
        kind = self.message_class
        headers.check_publisher(header, self.topic, kind._md5sum, kind._type)

    def connected(self, link: InboundLink) -> None:
        """Do nothing: messages will come."""

    def disconnected(self, link: InboundLink) -> None:
        """Do nothing: the link reconnects by itself."""

    def receive(self, link: InboundLink, frames: list[bytes], *, now: bool) -> bool:
        """Queue whole messages for the callbacks; see `Receiver`."""
        queue, limit = self._queue, self.queue_size
        if len(frames) == 1:
            link.bytes += len(frames[0])
            items: list[Item] = [(link, frames[0], None)]
        else:
            link.bytes += sum(map(len, frames))
            items = [(link, data, None) for data in frames]
        if now:
            if limit and len(items) > limit:
                self._forget_oldest(link, items, limit)
            keeps_up = queue.handle_all(items)
        else:
            keeps_up = queue.post_all(items)
        if limit is None:
            if link.bytes - link.handled - link.lost > self._most_behind:
                self._pause(link)
        elif limit:
            while len(queue.items) > limit:
                link.dropped += self._drop_oldest()
        return keeps_up

    def receive_local(self, link: LocalLink, message: Any, data: bytes | None) -> None:
        """Queue a message of a publisher in this process; called by the publishing thread."""
        if self._closed:
            return
        self._queue.post((link, data, message if data is None else None))
        limit = self.queue_size or _LOCAL_BACKLOG
        if len(self._queue.items) > limit and link.waits and self.queue_size is None:
            self._wait_for_queue(limit)
        while len(self._queue.items) > limit:
            self._drop_oldest()

    def _wait_for_queue(self, limit: int) -> None:
        """Block a publisher without queue size, though not for ever: it may wait for itself."""
        deadline = time.monotonic() + _LOCAL_PATIENCE_S
        while len(self._queue.items) > limit // 2 and not self._closed:
            if self._queue.runs_here() or time.monotonic() > deadline:
                return
            time.sleep(0.001)

    def takes(self, message_class: Any) -> bool:
        """Return True if objects of that class can be delivered as they are."""
        return message_class is self.message_class

    def _forget_oldest(self, link: InboundLink, items: list[Item], limit: int) -> None:
        """Drop the oldest messages that waited while callbacks were busy."""
        old = items[:-limit]
        del items[:-limit]
        link.dropped += len(old)
        with self._drops:
            link.lost += sum(len(data) for _, data, _ in old if data is not None)

    def _drop_oldest(self) -> int:
        try:
            link, data, _ = self._queue.items.popleft()
        except IndexError:
            return 0
        if data is not None and not link.is_local:
            with self._drops:
                link.lost += len(data)
        return 1

    # Delivering, on a worker ---------------------------------------------------------------

    def _deliver(self, item: Item) -> None:
        link, data, message = item
        if data is not None:
            if not link.is_local:
                link.handled += len(data)
                if link.paused:
                    self._loop.call_soon(functools.partial(self._resume, link))
            if self._closed:
                return
            message = self._make()
            try:
                message.deserialize(data)
            except Exception as error:  # noqa: BLE001  # whatever the bytes lead to
                peer = link.header.get("callerid", "an unnamed node")
                PEER_REPORTS.complain(f"subscriber of {self.topic}", peer, error)
                return
        if self._marks:
            message._connection_header = link.header
        if self._statistics is not None:
            self._statistics.take(self.topic, link, message, 0 if data is None else len(data))
        subscribers = self.subscribers
        if link.latching:
            with self._adding:  # either now or as the latched message, and not twice
                link.latched = message
                subscribers = self.subscribers
        for subscriber in subscribers:
            self._call(subscriber, link, message)

    def _call(self, subscriber: Subscriber, link: Any, message: Any) -> None:
        try:
            kind = subscriber.message_class
            if kind is not self.message_class:
                message = _converted(message, kind, link)
            subscriber.callback(message)
        except Exception as error:  # noqa: BLE001  # a callback must not end its thread
            report(f"bad callback of {self.topic}", error)

    def _pause(self, link: InboundLink) -> None:
        link.pause()
        # The callbacks may have caught up before the link was paused.
        self._loop.call_soon(functools.partial(self._resume, link))

    def _resume(self, link: InboundLink) -> None:
        if link.bytes - link.handled - link.lost <= self._most_behind // 2:
            link.resume()

    @property
    def num_connections(self) -> int:
        """Publishers connected now."""
        return sum(link.up for link in list(self.links.values())) + len(self.local)


def _maker(message_class: Any) -> Callable[[], Any]:
    """Return a function that makes a message to decode into: our decoders need no defaults."""
    if issubclass(message_class, Message) and "_spec" in vars(message_class):
        return functools.partial(object.__new__, message_class)
    return message_class  # type: ignore[no-any-return]


def _converted(message: Any, kind: Any, link: Any) -> Any:
    """Return a message as its subscriber requests it: decoded, or as bytes."""
    data = message._buff if isinstance(message, RawMessage) else frame(message)[4:]
    made = _maker(kind)()
    made.deserialize(data)
    if hasattr(kind, "_connection_header"):
        made._connection_header = link.header
    return made


class Subscriber:
    """Subscriber to a topic, as `Node.subscribe` returns it: a callback gets the messages.

    Args:
        subscription: Subscription of the messages.
        message_class: Class of the messages.
        callback: Called with each.
        queue_size: Messages kept while callbacks are slow; None for all.
        on_close: Called with itself when it is closed.

    Attributes:
        name: The topic's resolved name.
    """

    def __init__(
        self,
        subscription: Subscription,
        message_class: Any,
        callback: Callback,
        queue_size: int | None,
        on_close: Callable[[Subscriber], None],
    ) -> None:
        self._on_close = on_close
        self.subscription = subscription
        self.name = subscription.topic
        self.message_class = message_class
        self.callback = callback
        self.queue_size = queue_size
        self._closed = False

    @property
    def num_connections(self) -> int:
        """Publishers connected now."""
        return self.subscription.num_connections

    def close(self) -> None:
        """Call back no more; the last subscriber of a topic in a node unregisters it."""
        if not self._closed:
            self._closed = True
            self._on_close(self)
