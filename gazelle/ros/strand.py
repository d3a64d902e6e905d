"""Work in order, on whatever thread is free."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle.ros.crew import FIRST_DOUBT, QUICK
from gazelle.ros.errors import report
from gazelle.ros.loop import EventLoop

SLOW = 0.02
"""Seconds an item may take on a thread that waits for its connection alone."""


class Strand:
    """Handles items one at a time and in order, on whatever thread is free.

    Args:
        loop: The loop whose threads are used.
        handle: Called with each item; may take long, may raise.
        what: What the items are, for the report of an error.
    """

    BATCH = 16
    TURN = 0.002
    """Seconds after which others get a turn."""
    __slots__ = (
        "_doubt",
        "_doubt_until",
        "_handle",
        "_idle",
        "_loop",
        "_runner",
        "items",
        "what",
    )

    def __init__(self, loop: EventLoop, handle: Callable[[Any], None], what: str) -> None:
        self._loop = loop
        self._handle = handle
        self._idle = [True]
        """Holds something while nobody runs; who takes it out, runs. That needs no lock."""
        self._runner = 0
        self._doubt = FIRST_DOUBT
        self._doubt_until = math.inf
        self.items: deque[Any] = deque()
        self.what = what

    def post(self, item: Any) -> None:
        """Handle `item` after those before it."""
        self.items.append(item)
        if self._idle:
            self._start()

    def post_all(self, items: list[Any]) -> None:
        """Handle several items, in order."""
        self.items.extend(items)
        if self._idle:
            self._start()

    def handle_all(self, items: list[Any]) -> bool:
        """Handle items on this thread if nobody is at it, else post them.

        The thread must be one that holds up nobody when an item is slow.

        Returns:
            Whether items are not too slow for that.
        """
        try:
            self._idle.pop()
        except IndexError:
            self.post_all(items)  # for the thread that is at it
        else:
            if len(items) == 1 and not self.items:
                self._handle_one(items[0])
            else:
                self.items.extend(items)
                self._run(SLOW)
        return not self._doubt_until

    def _handle_one(self, item: Any) -> None:
        self._runner = threading.get_ident()
        begin = time.monotonic()
        try:
            self._handle(item)
        except Exception as error:  # noqa: BLE001  # a callback must not end its thread
            report(self.what, error)
        self._finish(begin, 1, SLOW)

    def runs_here(self) -> bool:
        """True if it is the calling thread that handles an item of this strand."""
        return not self._idle and self._runner == threading.get_ident()

    def _start(self) -> None:
        try:
            self._idle.pop()
        except IndexError:
            return  # another thread was faster
        self._loop.submit(self._run, quick=self.is_quick())

    def is_quick(self) -> bool:
        """Whether items are expected to take no time."""
        if self._doubt_until and time.monotonic() > self._doubt_until:
            self._doubt_until = 0.0
        return not self._doubt_until

    def _run(self, bound: float = QUICK) -> None:
        items, handle = self.items, self._handle
        self._runner = threading.get_ident()
        begin = time.monotonic()
        count = 0
        while items and time.monotonic() - begin < self.TURN:
            for _ in range(min(self.BATCH, len(items))):
                try:
                    item = items.popleft()
                except IndexError:  # a queue that is full drops items meanwhile
                    break
                count += 1
                try:
                    handle(item)
                except Exception as error:  # noqa: BLE001  # a callback must not end its thread
                    report(self.what, error)
        self._finish(begin, count, bound)

    def _finish(self, begin: float, count: int, bound: float) -> None:
        end = time.monotonic()
        if self._doubt_until or end - begin > bound:
            self._learn((end - begin) / max(1, count), end)
        # Whoever posts from here on starts another run; what was posted just before must not
        # wait for that.
        self._idle.append(True)
        if self.items:
            self._start()

    def _learn(self, seconds: float, now: float) -> None:
        """Expect items to take as long as these did."""
        if seconds > QUICK:
            self._doubt = min(self._doubt * 2, 60.0)
            self._doubt_until = now + self._doubt
        else:
            self._doubt = FIRST_DOUBT
            if self._doubt_until > now + 60.0:
                self._doubt_until = 0.0
