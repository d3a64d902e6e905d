"""One owner of the state: whoever else wants something posts it here.

Requests run between two steps, in the order they came, so that spawn, delete and reset
never race with the physics, and the answer comes after the thing is true.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, TypeVar

T = TypeVar("T")

# How long a waiting thread sleeps before it looks whether the stepping has ended [s].
_PATIENCE = 0.002


class RequestQueue:
    """Serialises all access to a simulation.

    Attributes:
        lock: Held by whoever owns the state; the owner calls ``drain`` between two steps.
    """

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self._waiting: deque[tuple[Callable[[], Any], Future[Any]]] = deque()

    def post(self, work: Callable[[], T]) -> Future[T]:
        """Have something done between two steps; at once when nothing is stepping."""
        future: Future[T] = Future()
        self._waiting.append((work, future))
        if self.lock.acquire(blocking=False):
            try:
                self.drain()
            finally:
                self.lock.release()
        return future

    def call(self, work: Callable[[], T]) -> T:
        """Have something done between two steps and wait for its result.

        Raises:
            Exception: What the work raised.
        """
        if self.lock.acquire(blocking=False):
            try:
                return work()
            finally:
                self.lock.release()
        future = self.post(work)
        while True:
            try:
                return future.result(timeout=_PATIENCE)
            except TimeoutError:
                if future.done():
                    return future.result()
                if self.lock.acquire(blocking=False):
                    try:
                        self.drain()
                    finally:
                        self.lock.release()

    def drain(self) -> None:
        """Do all that waits; the caller owns the state."""
        while self._waiting:
            work, future = self._waiting.popleft()
            if not future.set_running_or_notify_cancel():
                continue
            try:
                future.set_result(work())
            except Exception as error:  # noqa: BLE001  the waiting thread gets it, whatever it is
                future.set_exception(error)
