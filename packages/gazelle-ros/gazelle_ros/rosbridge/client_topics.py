"""Subscriptions and publications of one client."""

from __future__ import annotations

import threading
import time
from typing import Any

from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.messages import load_message
from gazelle_ros.node import Node
from gazelle_ros.raw import RawMessage
from gazelle_ros.rosbridge.bridged_message import COMPRESSIONS, TopicEncoder
from gazelle_ros.rosbridge.client_queue import ClientQueue, DeliverySettings, TopicQueue
from gazelle_ros.rosbridge.shared_publishers import PublisherPool, SharedPublisher
from gazelle_ros.rosbridge.values import fill_message
from gazelle_ros.subscribing import Subscriber
from gazelle_ros.time import Time

_QUEUE_SIZE = 100
_ANY = "*"


class TopicTypes:
    """The types of topics, and what encodes their messages, shared by all clients.

    Args:
        node: The server's.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._lock = threading.Lock()
        self._encoders: dict[str, tuple[Any, TopicEncoder]] = {}

    def class_of(self, topic: str, type_name: str | None) -> Any:
        """Return the class of a topic's messages.

        Args:
            topic: Its name.
            type_name: The type that a client names, or None.

        Raises:
            RosError: The topic is of another type, or unknown without a named type.
        """
        types = dict(self._node.master.topic_types())
        known = types.get(self._node.resolve(topic))
        if type_name is None and known in {None, _ANY}:
            raise RosError(
                f"Cannot infer topic type for topic {topic} as it is not yet advertised",
                hint=did_you_mean(topic, types),
            )
        message_class = load_message(type_name or str(known))
        if known not in {None, _ANY, message_class._type}:
            raise RosError(
                f"Tried to register topic {topic} with type {message_class._type}, "
                f"but it is already established with type {known}"
            )
        return message_class

    def encoder(self, topic: str, message_class: Any) -> TopicEncoder:
        """Return the encoder of a topic's messages; the same for all clients."""
        with self._lock:
            known = self._encoders.get(topic)
            if known is None or known[0] is not message_class:
                known = message_class, TopicEncoder(topic, message_class, self._node.clock.now)
                self._encoders[topic] = known
            return known[1]


class ClientSubscription:
    """One client's subscription to a topic, for all the requests it made.

    Args:
        node: Subscribes.
        topic: As the client calls it.
        encoder: Of the topic.
        message_class: Of the messages.
        outbox: The client's.
    """

    def __init__(
        self, node: Node, topic: str, encoder: TopicEncoder, message_class: Any, outbox: ClientQueue
    ) -> None:
        self._encoder, self._outbox = encoder, outbox
        self._requests: dict[Any, DeliverySettings] = {}
        self._queue = TopicQueue()
        self._node, self._topic, self.message_class = node, topic, message_class
        self._subscriber: Subscriber | None = None

    def request(self, identifier: Any, settings: DeliverySettings) -> None:
        """Add a request, or change the settings of one."""
        self._requests[identifier] = settings
        self._merge()
        if self._subscriber is None:
            self._subscriber = self._node.subscribe(
                self._topic, self.message_class, self._receive, raw=True
            )

    def cancel(self, identifier: Any) -> bool:
        """Remove a request, or all if it is None; returns whether that was the last."""
        if identifier is None:
            self._requests.clear()
        self._requests.pop(identifier, None)
        if self._requests:
            self._merge()
        return not self._requests

    def close(self) -> None:
        """Unsubscribe."""
        if self._subscriber is not None:
            self._subscriber.close()
        self._outbox.forget(self._queue)

    def _receive(self, raw: RawMessage) -> None:
        self._outbox.offer(self._queue, self._encoder.message(raw), time.monotonic())

    def _merge(self) -> None:
        """Combine all requests: highest rate, shortest queue, smallest fragments."""
        wishes = list(self._requests.values())
        sizes = [each.fragment_size for each in wishes if each.fragment_size is not None]
        self._queue.settings = DeliverySettings(
            throttle=min(each.throttle for each in wishes),
            queue_length=min(each.queue_length for each in wishes),
            fragment_size=min(sizes, default=None),
            compression=max((each.compression for each in wishes), key=COMPRESSIONS.index),
        )


class ClientTopics:
    """All topics of one client.

    Args:
        node: The server's.
        types: Shared by all clients.
        publishers: Shared by all clients.
        outbox: The client's.
    """

    def __init__(
        self, node: Node, types: TopicTypes, publishers: PublisherPool, outbox: ClientQueue
    ) -> None:
        self._node, self._types, self._pool, self._outbox = node, types, publishers, outbox
        self._subscriptions: dict[str, ClientSubscription] = {}
        self._publishers: dict[str, tuple[SharedPublisher, set[Any]]] = {}

    def subscribe(
        self, topic: str, kind: str | None, identifier: Any, settings: DeliverySettings
    ) -> None:
        """Subscribe the client, once more if need be.

        Raises:
            RosError: The type is not known, or another.
        """
        known = self._subscriptions.get(topic)
        if known is None or kind is not None:
            message_class = self._types.class_of(topic, kind)
            if known is None:
                encoder = self._types.encoder(topic, message_class)
                known = ClientSubscription(self._node, topic, encoder, message_class, self._outbox)
        known.request(identifier, settings)
        self._subscriptions[topic] = known

    def unsubscribe(self, topic: str, identifier: Any) -> None:
        """Undo one subscription, or all of a topic if the identifier is None."""
        known = self._subscriptions.get(topic)
        if known is not None and known.cancel(identifier):
            del self._subscriptions[topic]
            known.close()

    def advertise(
        self,
        topic: str,
        kind: str | None,
        identifier: Any = None,
        *,
        size: int = _QUEUE_SIZE,
        latch: bool = False,
    ) -> SharedPublisher:
        """Publish on a topic from now on.

        Raises:
            RosError: The type is not known, or another.
        """
        known = self._publishers.get(topic)
        if known is None or kind is not None:
            shared = self._pool.acquire(
                topic, lambda: self._types.class_of(topic, kind), size, latch=latch
            )
            if known is not None:
                self._pool.release(topic)
                known[1].add(identifier)
                return shared
            known = self._publishers[topic] = shared, set()
        known[1].add(identifier)
        return known[0]

    def unadvertise(self, topic: str, identifier: Any) -> bool:
        """Undo one advertisement, or all of a topic if the identifier is None; false if none."""
        known = self._publishers.get(topic)
        if known is None:
            return False
        if identifier is None:
            known[1].clear()
        known[1].discard(identifier)
        if not known[1]:
            del self._publishers[topic]
            self._pool.release(topic)
        return True

    def publish(self, topic: str, values: Any, *, size: int, latch: bool) -> None:
        """Publish a message; the topic is advertised if it is known.

        Raises:
            RosError: The topic is not known, or the values are no message of its type.
        """
        known = self._publishers.get(topic)
        shared = known[0] if known else self.advertise(topic, None, size=size, latch=latch)
        now = Time(nsecs=self._node.clock.now())
        shared.publish(fill_message(shared.message_class(), values, now))

    def close(self) -> None:
        """Undo everything at the end of the client."""
        for subscription in self._subscriptions.values():
            subscription.close()
        self._subscriptions.clear()
        for topic in list(self._publishers):
            self.unadvertise(topic, None)
