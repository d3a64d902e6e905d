"""Topics with subscribers; others are not computed."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from typing import Any

from gazelle.bridges.conversions import ConversionContext, encoder_of
from gazelle.bridges.graph import TimedGraph
from gazelle_ros import Publisher, load_message

Listen = Callable[[Callable[[Any], None]], Callable[[], None]]
"""Has a function called with every value; returns what ends that."""


class OnDemandTopic:
    """A topic of a simulation: its port is subscribed while the topic has subscribers.

    Args:
        graph: Node of the topic.
        topic: Full name.
        kind: Of the values.
        listen: To the port.
        view: Conversion of a value for the graph.
        queue_size: Of the topic.
        latch: Whether a late subscriber gets the last value.

    Raises:
        RosError: Values of this kind cannot be published.
    """

    def __init__(
        self,
        graph: TimedGraph,
        topic: str,
        kind: type[Any],
        listen: Listen,
        view: ConversionContext,
        *,
        queue_size: int,
        latch: bool = False,
    ) -> None:
        self._encoder, self._view, self._listen = encoder_of(kind), view, listen
        self._graph = graph
        self._message = load_message(self._encoder.message)
        self._ending: list[Callable[[], None]] = []
        self._publisher: Publisher = graph.node.advertise(
            topic,
            self._message,
            queue_size=queue_size,
            latch=latch,
            on_connect=self._follow,
            on_disconnect=self._follow,
        )

    def send(self, value: Any) -> None:
        """Publish a value."""
        message = self._message()
        self._encoder.fill(message, value, self._view)
        self._publisher.publish(message)

    def close(self) -> None:
        """Publish no more."""
        self._publisher.close()
        while self._ending:
            with contextlib.suppress(ValueError):  # the port is gone already
                self._ending.pop()()

    def _follow(self, _peer: str) -> None:
        self._graph.post(self._listen_if_subscribed)

    def _listen_if_subscribed(self) -> None:
        if self._publisher.num_connections and not self._ending:
            self._ending.append(self._listen(self.send))
        elif not self._publisher.num_connections and self._ending:
            self._ending.pop()()
