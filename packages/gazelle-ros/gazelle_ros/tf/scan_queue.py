"""Scans and other stamped messages in the order they came, each when its transform is known."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

from gazelle_ros.messages import Message
from gazelle_ros.node import Node

_LOOK_S = 0.2
KEPT = 100
"""Messages kept, the newest ones."""

T = TypeVar("T")


class MessageQueue:
    """Keeps messages until they can be used, as a message filter of tf does.

    Args:
        kept: Messages kept, the newest ones.

    Attributes:
        seen: Number of messages received.
        frame: Frame of the last one.
    """

    def __init__(self, kept: int = KEPT) -> None:
        self._waiting: deque[Any] = deque(maxlen=kept)
        self._news = threading.Condition()
        self.seen = 0
        self.frame = ""

    def add(self, message: Any) -> None:
        """Add a message with a header."""
        with self._news:
            self.seen += 1
            self.frame = message.header.frame_id.strip("/")
            self._waiting.append(message)
            self._news.notify_all()

    def wake(self) -> None:
        """Wake the queue after another change."""
        with self._news:
            self._news.notify_all()

    def work(self, find: Callable[[Any], T | None], use: Callable[[Any, T], None]) -> None:
        """Process waiting messages, oldest first; stop at the first that has to wait.

        Args:
            find: The transforms of a message; None while they are not there.
            use: Uses a message and its transforms.
        """
        with self._news:
            if not self._waiting:
                self._news.wait(_LOOK_S)
            waiting = list(self._waiting)
        # Queried before the older ones: transforms come in their order, also while these are worked off. So what
        # is not known then, though this one was, is too old ever to be known.
        newest = find(waiting[-1]) if waiting else None
        done = []
        for message in waiting:
            found = newest if message is waiting[-1] else None
            found = find(message) if found is None else found
            if found is not None:
                use(message, found)
            elif newest is None:
                break
            done.append(message)
        with self._news:
            for message in done:
                if message in self._waiting:
                    self._waiting.remove(message)
            if not done:
                self._news.wait(0.01)


class ScanQueue(MessageQueue):
    """Queue of the messages of a topic.

    Args:
        node: On the graph.
        topic: Of the messages.
        kind: Of the messages.
    """

    def __init__(self, node: Node, topic: str, kind: type[Message]) -> None:
        super().__init__()
        node.subscribe(topic, kind, self.add, queue_size=KEPT)
