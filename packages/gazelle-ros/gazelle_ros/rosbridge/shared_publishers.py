"""Publishers that clients share, and that outlive them by some seconds."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.node import Node

_CONNECTING_S = 1.0
"""Time after advertising a topic in which messages wait for the first subscriber [s]."""
_MOST_HELD = 1000


class SharedPublisher:
    """Publishes on one topic for all clients that do.

    A client sends its first message right after it has advertised, when no subscriber had time to
    connect: such messages wait for one, though not for long.

    Args:
        node: Publishes.
        topic: Its name.
        message_class: Of the messages.
        size: Of the queue for each subscriber.
        latch: Whether the last message is kept for new subscribers.
    """

    def __init__(
        self, node: Node, topic: str, message_class: Any, size: int, *, latch: bool
    ) -> None:
        self.users = self.generation = 0
        self.message_class = message_class
        self._lock = threading.Lock()
        self._held: deque[Any] | None = None if latch else deque(maxlen=_MOST_HELD)
        self._publisher = node.advertise(
            topic, message_class, size, latch=latch, on_connect=lambda _peer: self._flush()
        )
        if not latch:
            node.loop.call_later(_CONNECTING_S, lambda: node.loop.submit(self._flush))

    def publish(self, message: Any) -> None:
        """Publish a message."""
        with self._lock:
            if self._held is not None and not self._publisher.has_subscribers:
                self._held.append(message)
                return
            self._send_held()
        self._publisher.publish(message)

    def close(self) -> None:
        """Publish no more."""
        self._flush()
        self._publisher.close()

    def _flush(self) -> None:
        with self._lock:
            self._send_held()

    def _send_held(self) -> None:
        held, self._held = self._held, None
        for message in held or ():
            self._publisher.publish(message)


class PublisherPool:
    """The publishers of all clients of a server.

    Args:
        node: The server's.
        linger: Seconds a topic stays advertised after the last client that published on it.
    """

    def __init__(self, node: Node, linger: float) -> None:
        self._node, self._linger = node, linger
        self._lock = threading.Lock()
        self._publishers: dict[str, SharedPublisher] = {}

    def acquire(
        self, topic: str, find_class: Callable[[], Any], size: int, *, latch: bool
    ) -> SharedPublisher:
        """Return a publisher, for one client more until it is released.

        Args:
            topic: Its name.
            find_class: Gives the class of the messages; called before anything is changed.
            size: Of the queue for each subscriber.
            latch: Whether the last message is kept.

        Raises:
            RosError: The topic has another type here.
        """
        message_class = find_class()
        with self._lock:
            shared = self._publishers.get(topic)
            if shared is not None and shared.message_class._md5sum != message_class._md5sum:
                if shared.users:
                    raise RosError(
                        f"Tried to register topic {topic} with type {message_class._type}, but it "
                        f"is already established with type {shared.message_class._type}"
                    )
                shared.close()
                shared = None
            if shared is None:
                shared = SharedPublisher(self._node, topic, message_class, size, latch=latch)
                self._publishers[topic] = shared
            shared.users += 1
            shared.generation += 1
            return shared

    def release(self, topic: str) -> None:
        """Release the publisher of one client; the topic closes a while after the last."""
        with self._lock:
            shared = self._publishers[topic]
            shared.users -= 1
            if shared.users:
                return
            generation = shared.generation

        def end() -> None:
            with self._lock:
                same = self._publishers.get(topic) is shared
                if not same or shared.users or shared.generation != generation:
                    return
                del self._publishers[topic]
                shared.close()

        loop = self._node.loop
        loop.call_later(self._linger, lambda: loop.submit(end))
