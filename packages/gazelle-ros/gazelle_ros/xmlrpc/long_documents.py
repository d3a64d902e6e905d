"""Long documents are read and written beside the event loop, so that short ones need not wait."""

from __future__ import annotations

from collections import deque
from typing import Any

from gazelle_ros.loop import EventLoop
from gazelle_ros.thread_pool import Task

LONG_BYTES = 64 * 1024
"""Reading or writing a document of this length takes a few milliseconds."""
_TAGS = 30
"""Least size of a value, with its tags [bytes]."""


def is_long(value: Any) -> bool:
    """Return whether the document of a value is long; examine no more of it than needed."""
    left = LONG_BYTES
    waiting = [value]
    while waiting and left > 0:
        item = waiting.pop()
        left -= _TAGS
        if isinstance(item, (str, bytes)):
            left -= len(item)
        elif isinstance(item, dict):
            left -= _TAGS * len(item)
            if left > 0:
                waiting += item.values()
        elif isinstance(item, (list, tuple)):
            left -= _TAGS * len(item)
            if left > 0:
                waiting += item
        else:  # the standard library's wrapper of bytes
            left -= len(getattr(item, "data", ""))
    return left <= 0


class BackgroundTasks:
    """Runs tasks one after another on a thread that blocks no other. Only on the loop's thread.

    There is one at a time, however many clients send long documents: Python runs one thread at a
    time, and the loop would have to wait for its turn.

    Args:
        loop: Loop of the threads.
    """

    def __init__(self, loop: EventLoop) -> None:
        self._loop = loop
        self._tasks: deque[Task] = deque()
        self._busy = False

    def post(self, task: Task) -> None:
        """Run a task, which raises nothing, after those before it."""
        self._tasks.append(task)
        if not self._busy:
            self._next()

    def _next(self) -> None:
        self._busy = bool(self._tasks)
        if self._busy:
            task = self._tasks.popleft()
            self._loop.submit(lambda: self._run(task))

    def _run(self, task: Task) -> None:
        try:
            task()
        finally:
            self._loop.call_soon(self._next)
