"""Subscriptions that exist only while their results have subscribers."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher
from gazelle_ros.subscribing import Subscriber


class OnDemandOutputs:
    """Publishers that subscribe to their sources while one of them has subscribers itself.

    Args:
        node: On the graph.
        topics: To publish on, each with the class of its messages.
        begin: Subscribes to the sources.
    """

    def __init__(
        self,
        node: Node,
        topics: Sequence[tuple[str, Any]],
        begin: Callable[[], Sequence[Subscriber]],
    ) -> None:
        self._begin = begin
        self._lock = threading.Lock()
        self._sources: Sequence[Subscriber] = ()
        self._publishers: Sequence[Publisher] = ()
        self._publishers = [
            node.advertise(
                topic,
                kind,
                on_connect=self._update_subscriptions,
                on_disconnect=self._update_subscriptions,
            )
            for topic, kind in topics
        ]
        self._update_subscriptions("")  # one may have connected before there were all publishers

    @property
    def subscribed(self) -> list[bool]:
        """Topics that have subscribers, in their order."""
        return [each.has_subscribers for each in self._publishers]

    def publish(self, *messages: Any) -> None:
        """Publish a message on each topic; none where it is None."""
        for publisher, message in zip(self._publishers, messages, strict=False):
            if message is not None:
                publisher.publish(message)

    def _update_subscriptions(self, _peer: str) -> None:
        """Subscribe to the sources or unsubscribe, as a topic has subscribers or none has."""
        with self._lock:
            needed = any(each.num_connections > 0 for each in self._publishers)
            if needed and not self._sources:
                self._sources = self._begin()
            elif not needed:
                for each in self._sources:
                    each.close()
                self._sources = ()
