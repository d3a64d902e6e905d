"""Threads for what may take long, such as users' callbacks."""

from __future__ import annotations

import os
import queue
import sys
import threading
import weakref
from collections import deque
from collections.abc import Callable
from typing import Protocol

from gazelle_ros.errors import report

GROWTH_DELAY_S = 0.001
"""Time that a task waits for a worker before there is another one."""
MAX_IDLE = 16
"""Idle workers that are kept."""
MAX_WORKERS = 1000

Task = Callable[[], None]


class TaskQueue(Protocol):
    """Tasks on their way to workers."""

    def put(self, task: Task | None) -> None:
        """Append a task; None ends the worker that gets it."""

    def get(self) -> Task | None:
        """Wait for a task and take it."""


class EventTaskQueue:
    """A task queue with workers that wait for a semaphore of the system (Linux).

    `queue.SimpleQueue` wakes a worker while the waker still holds the interpreter, so that it has
    to wait once more: 19 instead of 9 us from a publisher to a callback in the same process.
    """

    def __init__(self) -> None:
        self._tasks: deque[Task | None] = deque()
        self._semaphore = os.eventfd(0, os.EFD_CLOEXEC | os.EFD_SEMAPHORE)
        closing = weakref.finalize(self, os.close, self._semaphore)
        closing.atexit = False  # workers wait until the end

    def put(self, task: Task | None) -> None:
        """Add a task; see `TaskQueue`."""
        self._tasks.append(task)
        os.write(self._semaphore, _ONE)

    def get(self) -> Task | None:
        """Return the next task; see `TaskQueue`."""
        while True:
            os.read(self._semaphore, 8)
            try:
                return self._tasks.popleft()
            except IndexError:  # a forked process has rung
                continue


_ONE = (1).to_bytes(8, sys.byteorder)


class ThreadPool:
    """As many workers as tasks block at the same time.

    `concurrent.futures.ThreadPoolExecutor` starts a worker for each of the messages that arrive
    together, and holds up the end of the process for a callback that blocks. Here a worker starts
    only when none took a task for `GROWTH_DELAY_S`, and the process ends without it.

    Args:
        call_later: Runs something after some seconds, on another thread than the workers'.
    """

    def __init__(self, call_later: Callable[[float, Task], object]) -> None:
        self._call_later = call_later
        self._tasks: TaskQueue = EventTaskQueue() if hasattr(os, "eventfd") else queue.SimpleQueue()
        self._lock = threading.Lock()
        self._workers: set[threading.Thread] = set()
        self._spare = 0
        """Workers that are idle, less the tasks that wait."""
        self._taken = 0
        """Number of tasks taken by workers so far."""
        self._growing = False
        """True if a check for tasks that wait too long is scheduled."""
        self._stopping = False
        self._started = 0

    def submit(self, task: Task) -> None:
        """Run `task` on a worker; its exception is reported."""
        with self._lock:
            self._spare -= 1
            grow = self._spare < 0 and not self._growing and not self._stopping
            if grow:
                self._growing = True
        self._tasks.put(task)
        if grow:
            if self._workers:
                self._grow_later()
            else:
                self._grow(self._taken)

    def stop(self, timeout: float = 2.0) -> None:
        """Stop the workers once their tasks are done, and wait for each so long [s]."""
        with self._lock:
            self._stopping = True
            workers = list(self._workers)
        for _ in workers:
            self._tasks.put(None)
        for worker in workers:
            if worker is not threading.current_thread():
                worker.join(timeout)

    def _grow_later(self) -> None:
        taken = self._taken
        self._call_later(GROWTH_DELAY_S, lambda: self._grow(taken))

    def _grow(self, taken: int) -> None:
        """Start a worker if tasks wait and none was taken since there were `taken`."""
        with self._lock:
            self._growing = self._spare < 0 and not self._stopping
            if self._growing and self._taken == taken:
                self._start_worker()
            again = self._growing = self._growing and self._spare < 0
        if again:
            self._grow_later()

    def _start_worker(self) -> None:
        if len(self._workers) >= MAX_WORKERS:
            return
        self._started += 1
        self._spare += 1
        name = f"gazelle-ros-{self._started}"
        worker = threading.Thread(target=self._work, name=name, daemon=True)
        self._workers.add(worker)
        worker.start()

    def _work(self) -> None:
        while (task := self._tasks.get()) is not None:
            self._taken += 1
            try:
                task()
            except Exception as error:  # noqa: BLE001  # a task must not end its worker
                report("a task of the thread pool", error)
            del task  # what it holds is not kept alive while the worker is idle
            with self._lock:
                if self._spare >= MAX_IDLE:
                    break
                self._spare += 1
        with self._lock:
            self._workers.discard(threading.current_thread())
