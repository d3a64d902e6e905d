"""The topics of a node."""

from __future__ import annotations

import functools
import threading
import time
from collections.abc import Mapping
from typing import Any

from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.errors import Md5MismatchError, NodeClosedError, RosTimeoutError
from gazelle_ros.messages import Message
from gazelle_ros.node_base import NodeBase, node_here
from gazelle_ros.publishing import PeerHook, Publication, Publisher
from gazelle_ros.raw import raw_class
from gazelle_ros.statistics import Statistics
from gazelle_ros.subscribing import Callback, Subscriber, Subscription
from gazelle_ros.tcpros.headers import ANY


class TopicNode(NodeBase):
    """The part of a node that publishes and subscribes.

    Attributes:
        statistics: Measures subscriptions, if the graph wants that.
    """

    statistics: Statistics | None = None

    def __init__(self) -> None:
        super().__init__()
        self._publications: dict[str, Publication] = {}
        self._subscriptions: dict[str, Subscription] = {}

    def advertise(
        self,
        topic: str,
        message_class: Any,
        queue_size: int | None = 10,
        *,
        latch: bool = False,
        tcp_nodelay: bool = False,
        on_connect: PeerHook | None = None,
        on_disconnect: PeerHook | None = None,
        headers: Mapping[str, str] | None = None,
    ) -> Publisher:
        """Publish on a topic.

        Args:
            topic: Any name; it is resolved for the node.
            message_class: Of the messages.
            queue_size: Messages kept for a subscriber that is slow, the oldest dropped;
                None to wait for slow subscribers.
            latch: Send the last message to everybody who connects later.
            tcp_nodelay: Do not let the system collect small packets.
            on_connect: Called with the name of each subscriber that connects, or is connected to
                another publisher of this node on the topic.
            on_disconnect: Called with the name of each that goes.
            headers: More fields for the connection header that subscribers get.

        Raises:
            InvalidNameError: The name is not legal.
            Md5MismatchError: This node publishes another type there already.
        """
        name = self._name(topic)
        with self._lock:
            self._check_open()
            publication = self._publications.get(name)
            fresh = publication is None
            if publication is None:
                publication = Publication(self, name, message_class)
            _check_same(publication.message_class, message_class, name)
            publisher = Publisher(publication, self._unadvertise, on_connect, on_disconnect)
            publication.publishers.append(publisher)
            publication.queue_size = _wider(publication.queue_size, queue_size, fresh=fresh)
            publication.latching |= latch
            publication.tcp_nodelay |= tcp_nodelay
            publication.headers.update(headers or {})
            self._publications[name] = publication
        if fresh:
            publisher.introduced = True
            self._call_master("registerPublisher", name, message_class._type, self.uri)
        else:
            self.loop.call_soon(functools.partial(publication.notify_of_subscribers, publisher))
        return publisher

    def subscribe(
        self,
        topic: str,
        message_class: Any,
        callback: Callback,
        queue_size: int | None = None,
        *,
        tcp_nodelay: bool = False,
        raw: bool = False,
    ) -> Subscriber:
        """Subscribe to a topic; messages are handled one by one on a worker thread.

        Args:
            topic: Any name; it is resolved for the node.
            message_class: Of the messages; `gazelle_ros.raw.RawMessage` takes any.
            callback: Called with each message; what it raises is reported and changes nothing.
            queue_size: Messages kept while callbacks are slow, the oldest dropped; None to
                keep all and let the publisher wait.
            tcp_nodelay: Ask publishers not to let the system collect small packets.
            raw: Do not decode; the callback gets a `RawMessage`.

        Raises:
            InvalidNameError: The name is not legal.
            Md5MismatchError: This node subscribes to another type there already.
        """
        name = self._name(topic)
        kind = raw_class(message_class) if raw else message_class
        with self._lock:
            self._check_open()
            subscription = self._subscriptions.get(name)
            fresh = subscription is None
            if subscription is None:
                subscription = Subscription(self, name, kind, self.neighbour, self.statistics)
            _check_same(subscription.message_class, kind, name)
            subscriber = Subscriber(subscription, kind, callback, queue_size, self._unsubscribe)
            subscription.add(subscriber, tcp_nodelay=tcp_nodelay)
            self._subscriptions[name] = subscription
        if fresh:
            self._register_subscription(subscription)
        return subscriber

    def _register_subscription(self, subscription: Subscription) -> None:
        kind = subscription.message_class._type
        uris = self._call_master("registerSubscriber", subscription.topic, kind, self.uri)

        def begin() -> None:
            # An update from the master is newer than its answer, whichever came first.
            if not subscription.updated:
                subscription.update([uri for uri in uris if isinstance(uri, str)])

        if isinstance(uris, list):
            self.loop.call_soon(begin)

    def wait_for_message(self, topic: str, message_class: Any, timeout: float | None = None) -> Any:
        """Return the next message of a topic.

        Raises:
            RosTimeoutError: None came within `timeout` seconds of wall time.
            NodeClosedError: The node was closed meanwhile.
        """
        found: list[Any] = []
        event = threading.Event()

        def keep(message: Message) -> None:
            found.append(message)
            event.set()

        deadline = None if timeout is None else deadline_after(timeout)
        subscriber = self.subscribe(topic, message_class, keep)
        try:
            while not event.wait(0.5 if deadline is None else _left(deadline, 0.5)):
                if self._closed.is_set():
                    raise NodeClosedError("the node was closed while it waited for a message")
                if deadline is not None and time.monotonic() >= deadline:
                    raise RosTimeoutError(
                        f"timeout exceeded while waiting for message on topic {subscriber.name}"
                    )
        finally:
            subscriber.close()
        return found[0]

    @staticmethod
    def neighbour(uri: str) -> TopicNode | None:
        """Return the node of this process at that URI."""
        node = node_here(uri)
        return node if isinstance(node, TopicNode) else None

    # For the parts of the node -------------------------------------------------------------

    def publication(self, topic: str) -> Publication | None:
        """Return this node's publication on a topic, if any."""
        return self._publications.get(topic)

    def subscription(self, topic: str) -> Subscription | None:
        """Return this node's subscription to a topic, if any."""
        return self._subscriptions.get(topic)

    def publications(self) -> list[Publication]:
        """Return all of them."""
        return list(self._publications.values())

    def subscriptions(self) -> list[Subscription]:
        """Return all of them."""
        return list(self._subscriptions.values())

    def _unadvertise(self, publisher: Publisher) -> None:
        """Remove a closed publisher."""
        publication = publisher.publication
        with self._lock:
            if self._closing:
                return
            publication.publishers.remove(publisher)
            if publication.publishers:
                return
            self._publications.pop(publication.topic, None)
        self._call_master("unregisterPublisher", publication.topic, self.uri)
        self.loop.run(publication.close)

    def _unsubscribe(self, subscriber: Subscriber) -> None:
        """Remove a closed subscriber."""
        subscription = subscriber.subscription
        with self._lock:
            subscription.remove(subscriber)
            if subscription.subscribers or self._closing:
                return
            self._subscriptions.pop(subscription.topic, None)
        self._call_master("unregisterSubscriber", subscription.topic, self.uri)
        self.loop.run(subscription.close)


def _check_same(known: Any, requested: Any, topic: str) -> None:
    mine, theirs = known._md5sum, requested._md5sum
    if ANY not in {mine, theirs} and mine != theirs:
        raise Md5MismatchError(
            f"this node uses {topic} with the type {known._type} already, not {requested._type}"
        )


def _wider(known: int | None, requested: int | None, *, fresh: bool) -> int | None:
    """Return the larger of two queue sizes; None is without bound."""
    if fresh:
        return requested
    return None if known is None or requested is None else max(known, requested)


def _left(deadline: float, most: float) -> float:
    return min(most, max(0.0, deadline - time.monotonic()))
