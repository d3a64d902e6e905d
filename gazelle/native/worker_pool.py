"""Share a range of work among threads; kernels run without the interpreter's lock."""

from __future__ import annotations

import contextlib
import functools
import threading
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.errors import EngineError
from gazelle.native.processors import processors
from gazelle.native.system import System

BLOCKS_A_THREAD = 4
"""A thread that is slow, or begins late, leaves some of them to the others."""


class _Worker:
    """A thread that waits for work, with two locks: executors take some 20 us longer a call."""

    def __init__(self, name: str) -> None:
        self._work: Callable[[], Any] | None = None
        self._value: Any = None
        self._error: BaseException | None = None
        self._over = True
        self._go, self._done = threading.Lock(), threading.Lock()
        self._go.acquire()
        self._done.acquire()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def start(self, work: Callable[[], Any] | None) -> None:
        """Start work; None ends the thread."""
        self._work, self._over = work, False
        self._go.release()

    def outcome(self) -> tuple[Any, BaseException | None]:
        """Wait for the work of ``start``; returns its result and the exception of it or of Ctrl-C."""
        stop = None
        while not self._over:  # Ctrl-C may come when the lock has just been acquired
            try:
                self._done.acquire()
            except KeyboardInterrupt as interruption:  # no other code can wait for it later
                stop = interruption
        value, error = self._value, stop or self._error
        self._work = self._value = self._error = None
        return value, error

    def end(self) -> None:
        """End the thread."""
        self.start(None)
        if self._thread is not threading.current_thread():
            self._thread.join()

    def _run(self) -> None:
        while True:
            self._go.acquire()
            if self._work is None:
                return
            try:
                self._value = self._work()
            except BaseException as error:  # noqa: BLE001  the waiting thread gets it
                self._error = error
            self._over = True
            with contextlib.suppress(RuntimeError):  # free where ``outcome`` did not need it
                self._done.release()


class WorkerPool:
    """Some threads, started when there is enough to do for more than one.

    Args:
        size: Number of threads; all processors if None.

    Raises:
        EngineError: ``size`` is less than 1.
    """

    def __init__(self, size: int | None = None) -> None:
        if size is not None and size < 1:
            raise EngineError(f"threads must be at least 1, not {size}")
        self.size = processors() if size is None else size
        self._workers: list[_Worker] = []
        self._busy = threading.Lock()
        weakref.finalize(self, _end, self._workers)

    def share(self, work: Callable[[int, int, int], Any], count: int, least: int) -> list[Any]:
        """Call ``work(first, last, part)`` for parts of ``range(count)``; returns their results.

        Args:
            work: Called at once by several threads, each with a part of its own.
            count: Number of items to share.
            least: No part is smaller, if there is that much.
        """
        parts = min(self.size, count // least)
        if parts <= 1:
            return [work(0, count, 0)]
        ends = [count * part // parts for part in range(parts + 1)]
        return self.call(lambda part: work(ends[part], ends[part + 1], part), parts)

    def update(self, system: System, nworld: int, time: int) -> None:
        """Update all rows of a system, on several threads where that is worth it.

        Args:
            system: System.
            nworld: Number of worlds.
            time: Simulated time [ns].
        """
        rows = nworld * system.rows
        parts = min(self.size, rows // system.least)
        if parts < 2:
            system.update_from_python(0, rows, time)
            return
        taken, blocks = np.zeros(1, np.int64), min(rows, parts * BLOCKS_A_THREAD)
        self.call(lambda _: system.update_blocks(taken, blocks, rows, time), parts)

    def call(self, work: Callable[[int], Any], parts: int) -> list[Any]:
        """Call ``work(part)`` for at most a given number of parts at once, at least one; returns their results.

        Args:
            work: Called by several threads, each with a number of its own from 0 on.
            parts: Number of useful parts.
        """
        parts = min(self.size, parts)
        if parts <= 1:
            return [work(0)]
        with self._busy:
            workers = self._ready(parts - 1)
            for part, worker in enumerate(workers, 1):
                worker.start(functools.partial(work, part))
            try:
                first = work(0)
            finally:  # workers are waited for, also when something went wrong
                others = [worker.outcome() for worker in workers]
            return [first, *(_value(*outcome) for outcome in others)]

    def _ready(self, count: int) -> list[_Worker]:
        """Return a given number of threads, started if necessary."""
        while len(self._workers) < count:
            self._workers.append(_Worker(f"worker_{len(self._workers)}"))
        return self._workers[:count]

    def close(self) -> None:
        """Stop the threads."""
        with self._busy:
            _end(self._workers)


def _value(value: Any, error: BaseException | None) -> Any:
    if error is not None:
        raise error
    return value


def _end(workers: list[_Worker]) -> None:
    while workers:
        workers.pop().end()
