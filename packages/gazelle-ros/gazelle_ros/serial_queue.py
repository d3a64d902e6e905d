"""Work in order, on whatever worker is free."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle_ros.errors import report
from gazelle_ros.loop import EventLoop

_BATCH = 16
_TURN_S = 0.002
"""Time that one queue keeps a worker before others get a turn."""
_SLOW_S = 0.02


class SerialQueue:
    """Handles items one at a time and in order, on the loop's workers.

    Args:
        loop: The loop of the workers.
        handle: Called with each item; may take long, may raise.
        what: Kind of the items, for the report of an error.
    """

    __slots__ = ("_handle", "_loop", "_runner", "_running", "items", "what")

    def __init__(self, loop: EventLoop, handle: Callable[[Any], None], what: str) -> None:
        self._loop = loop
        self._handle = handle
        self._running = threading.Lock()
        """Held by the thread that handles items, from the request on."""
        self._runner = 0
        self.items: deque[Any] = deque()
        self.what = what

    def post(self, item: Any) -> None:
        """Handle `item` after those before it."""
        self.items.append(item)
        self._start()

    def post_all(self, items: list[Any]) -> bool:
        """Handle several items, in order; returns whether those before them were done."""
        done = not self.items
        self.items.extend(items)
        self._start()
        return done

    def handle_all(self, items: list[Any]) -> bool:
        """Handle items on this thread if no thread handles them, else post them.

        Returns:
            False if they took so long that others should not wait for this thread.
        """
        self.items.extend(items)
        if not self._running.acquire(blocking=False):
            return True
        begin = time.monotonic()
        self._run()
        return time.monotonic() - begin < _SLOW_S

    def runs_here(self) -> bool:
        """Return True if it is the calling thread that handles an item of this queue."""
        return self._running.locked() and self._runner == threading.get_ident()

    def _start(self) -> None:
        if self._running.acquire(blocking=False):
            self._loop.submit(self._run)

    def _run(self) -> None:
        items, handle = self.items, self._handle
        self._runner = threading.get_ident()
        begin = time.monotonic()
        while items and time.monotonic() - begin < _TURN_S:
            for _ in range(min(_BATCH, len(items))):
                try:
                    item = items.popleft()
                except IndexError:  # a queue that is full drops items meanwhile
                    break
                try:
                    handle(item)
                except Exception as error:  # noqa: BLE001  # a callback must not end its thread
                    report(self.what, error)
        self._runner = 0
        # A thread that posts from here on starts another run; what was posted just before must not
        # wait for that.
        self._running.release()
        if items:
            self._start()
