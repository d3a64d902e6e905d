"""Messages of every step, sent together when steps are very quick."""

from __future__ import annotations

import time

from gazelle_ros import Publisher

# Longest that a message waits for others, in wall time [s], and how many go at once.
_PATIENCE_S = 0.002
_MOST = 64


class Outbox:
    """Collects serialised messages of one topic for two milliseconds of wall time at most.

    In real time every message goes out at once. ``flush`` must be called when no more come.

    Args:
        publisher: Of a type without a header.
    """

    def __init__(self, publisher: Publisher) -> None:
        self._publisher = publisher
        self._waiting: list[bytes] = []
        self._sent_at = 0.0

    def add(self, data: bytes) -> None:
        """Send a message, now or shortly after."""
        self._waiting.append(data)
        if len(self._waiting) >= _MOST or time.monotonic() - self._sent_at >= _PATIENCE_S:
            self.flush()

    def flush(self) -> None:
        """Send what waits."""
        if self._waiting:
            self._publisher.publish_bytes(*self._waiting)
            self._waiting.clear()
            self._sent_at = time.monotonic()
