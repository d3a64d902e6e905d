"""Share a range of work among threads; kernels run without the interpreter's lock."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from gazelle.errors import EngineError


def processors() -> int:
    """Processors this process may use; ``GAZELLE_NUM_THREADS`` says fewer."""
    available = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    wanted = os.environ.get("GAZELLE_NUM_THREADS", "")
    return min(available or 1, int(wanted)) if wanted.isdigit() and int(wanted) else available or 1


class Crew:
    """Some threads, started when there is enough to do for more than one.

    Args:
        size: How many; all processors if None.

    Raises:
        EngineError: ``size`` is less than 1.
    """

    def __init__(self, size: int | None = None) -> None:
        if size is not None and size < 1:
            raise EngineError(f"threads must be at least 1, not {size}")
        self.size = processors() if size is None else size
        self._pool: ThreadPoolExecutor | None = None

    def share(self, work: Callable[[int, int, int], Any], count: int, least: int) -> list[Any]:
        """Call ``work(first, last, part)`` for parts of ``range(count)``; what they return.

        Args:
            work: Called at once by several threads, each with a part of its own.
            count: How much there is to do.
            least: No part is smaller, if there is that much.
        """
        parts = max(1, min(self.size, count // least))
        if parts == 1:
            return [work(0, count, 0)]
        if self._pool is None:
            self._pool = ThreadPoolExecutor(self.size - 1, thread_name_prefix="planar")
        ends = [count * part // parts for part in range(parts + 1)]
        others = [
            self._pool.submit(work, ends[part], ends[part + 1], part) for part in range(1, parts)
        ]
        first = work(ends[0], ends[1], 0)
        return [first, *(each.result() for each in others)]

    def close(self) -> None:
        """End the threads."""
        if self._pool is not None:
            self._pool.shutdown()
            self._pool = None
