"""Outgoing queue of one client: answers, and messages of topics at their rates."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

from gazelle_ros.rosbridge.bridged_message import BridgedMessage


@dataclass(frozen=True, slots=True)
class DeliverySettings:
    """Delivery settings of a topic for a client."""

    throttle: float = 0.0
    """Least time between two [s]."""
    queue_length: int = 0
    """Messages kept for the throttle; with none, what comes too early is dropped."""
    fragment_size: int | None = None
    compression: str = "none"


class TopicQueue:
    """The messages of one topic that wait for a client."""

    def __init__(self) -> None:
        self.settings = DeliverySettings()
        self.waiting: deque[BridgedMessage] = deque()
        self.last = float("-inf")
        """When a message was sent, or forwarded, last."""

    def due(self) -> float:
        """Return the time of the next message."""
        return self.last + self.settings.throttle


@dataclass(frozen=True, slots=True)
class OutgoingMessage:
    """Something to be sent now: text that is ready, or a message to encode."""

    text: str | bytes | None = None
    message: BridgedMessage | None = None
    settings: DeliverySettings = DeliverySettings()


class ClientQueue:
    """Filled by any thread, emptied by the client's own sender.

    Args:
        most_bytes: Beyond this the oldest messages of a topic make way for new ones. Answers are
            never dropped; of these four times as much marks the client as stuck.
        wake: Called when there is something new; from any thread.
    """

    def __init__(self, most_bytes: int, wake: Callable[[], None]) -> None:
        self._most, self._wake = most_bytes, wake
        self._lock = threading.Lock()
        self._answers: deque[str] = deque()
        self._turns: deque[TopicQueue] = deque()
        self._answer_bytes = self._topic_bytes = 0
        self.dropped = 0
        """Messages that a slow client never got."""

    @property
    def stuck(self) -> bool:
        """True if the client stopped receiving and should be disconnected."""
        return self._answer_bytes > 4 * self._most

    def answer(self, text: str) -> None:
        """Queue a text that must arrive."""
        with self._lock:
            self._answers.append(text)
            self._answer_bytes += len(text)
        self._wake()

    def offer(self, queue: TopicQueue, message: BridgedMessage, now: float) -> None:
        """Queue a message of a topic; it may be dropped, as the topic's settings say.

        Args:
            queue: The topic's.
            message: The message.
            now: The time [s].
        """
        with self._lock:
            settings = queue.settings
            if settings.throttle and not settings.queue_length:
                if now < queue.due():
                    return
                queue.last = now
            if settings.throttle and settings.queue_length:
                self._shorten(queue, settings.queue_length - 1)
            elif self._topic_bytes + len(message) > self._most:
                self._shorten(queue, max(settings.queue_length, 1) - 1)
            queue.waiting.append(message)
            self._topic_bytes += len(message)
            self._turns.append(queue)
        self._wake()

    def forget(self, queue: TopicQueue) -> None:
        """Remove a topic."""
        with self._lock:
            self._topic_bytes -= sum(map(len, queue.waiting))
            queue.waiting.clear()
            self._turns = deque(each for each in self._turns if each is not queue)

    def take(self, now: float) -> tuple[OutgoingMessage | None, float | None]:
        """Return the next item to send, or else the time to look again [s]; None if not shortly.

        Args:
            now: The time [s].
        """
        with self._lock:
            if self._answers:
                text = self._answers.popleft()
                self._answer_bytes -= len(text)
                return OutgoingMessage(text), None
            early: deque[TopicQueue] = deque()
            found = None
            while self._turns and found is None:
                queue = self._turns.popleft()
                if self._too_early(queue, now):
                    early.append(queue)
                else:
                    found = queue
            early.extend(self._turns)
            self._turns = early
            if found is None:
                return None, min((queue.due() for queue in self._turns), default=None)
            return self._pop(found, now), None

    def _too_early(self, queue: TopicQueue, now: float) -> bool:
        settings = queue.settings
        return bool(settings.throttle and settings.queue_length) and now < queue.due()

    def _pop(self, queue: TopicQueue, now: float) -> OutgoingMessage:
        message = queue.waiting.popleft()
        self._topic_bytes -= len(message)
        if queue.settings.queue_length:
            queue.last = now
        return OutgoingMessage(message=message, settings=queue.settings)

    def _shorten(self, queue: TopicQueue, most: int) -> None:
        """Remove the oldest messages of a topic, and as many of its turns."""
        while len(queue.waiting) > most:
            self._topic_bytes -= len(queue.waiting.popleft())
            self._turns.remove(queue)
            self.dropped += 1
