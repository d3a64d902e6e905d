"""Scans in the order they came, each when its transform is known."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle.ros.node import Node

_LOOK_S = 0.2
_KEPT = 100


class ScanQueue:
    """Keeps messages until they can be used, as a message filter of tf does.

    Args:
        node: On the graph.
        topic: Of the messages.
        kind: Of the messages.
    """

    def __init__(self, node: Node, topic: str, kind: Any) -> None:
        self._node = node
        self._waiting: deque[Any] = deque(maxlen=_KEPT)
        self._news = threading.Condition()
        self.seen = 0
        """How many came."""
        self.frame = ""
        """Of the last one."""
        node.subscribe(topic, kind, self._take, queue_size=_KEPT)

    def _take(self, message: Any) -> None:
        with self._news:
            self.seen += 1
            self.frame = message.header.frame_id.strip("/")
            self._waiting.append(message)
            self._news.notify_all()

    def wake(self) -> None:
        """Something else has changed."""
        with self._news:
            self._news.notify_all()

    def work(self, ready: Callable[[Any], bool]) -> None:
        """Hand over what waits, oldest first; stop at the first that has to wait on.

        Args:
            ready: Uses a message, and says whether it could.
        """
        with self._news:
            if not self._waiting:
                self._news.wait(_LOOK_S)
            waiting = list(self._waiting)
        used = []
        for place, message in enumerate(waiting):
            if ready(message):
                used.append(message)
            elif place == len(waiting) - 1 or not ready(waiting[-1]):
                break
            else:
                # A newer one could be used: what is before it never can.
                used.extend(waiting)
                break
        with self._news:
            for message in used:
                if message in self._waiting:
                    self._waiting.remove(message)
            if not used:
                self._news.wait(0.01)
