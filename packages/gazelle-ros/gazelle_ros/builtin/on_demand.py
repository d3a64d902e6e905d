"""Subscriptions that exist only while somebody wants what is made of them."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher
from gazelle_ros.subscribing import Subscriber


class OnDemandPublisher:
    """Publisher that subscribes to its sources while it has subscribers itself.

    Args:
        node: On the graph.
        topic: To publish on.
        kind: Class of the messages.
        begin: Subscribes to the sources.
    """

    def __init__(
        self, node: Node, topic: str, kind: Any, begin: Callable[[], Sequence[Subscriber]]
    ) -> None:
        self._begin = begin
        self._lock = threading.Lock()
        self._sources: Sequence[Subscriber] = ()
        self._publisher: Publisher | None = None
        self._publisher = node.advertise(
            topic, kind, on_connect=self._look, on_disconnect=self._look
        )
        self._look("")  # one may have connected before there was a publisher

    def publish(self, message: Any) -> None:
        """Publish a message."""
        if self._publisher is not None:
            self._publisher.publish(message)

    def _look(self, _peer: str) -> None:
        """Subscribe to the sources or unsubscribe, as the topic has subscribers or not."""
        with self._lock:
            if self._publisher is None:
                return
            wanted = self._publisher.num_connections > 0
            if wanted and not self._sources:
                self._sources = self._begin()
            elif not wanted:
                for each in self._sources:
                    each.close()
                self._sources = ()
