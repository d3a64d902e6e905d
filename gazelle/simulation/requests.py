"""One owner of the state: whoever else wants something posts it here.

Requests run between two steps, in the order they came, so that spawn, delete and reset
never race with the physics, and the answer comes after the thing is true.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from types import TracebackType
from typing import Any, TypeVar

T = TypeVar("T")

# How long a waiting thread sleeps before it looks whether the stepping has ended [s].
_PATIENCE = 0.002


class Ownership:
    """The lock of the state. Who lets go of it looks whether something was posted meanwhile.

    Otherwise what is posted between an owner's last look and its letting go would wait for the
    next owner: for ever, while the simulation is paused.

    Args:
        settle: Does what waits, if anything does and nobody else owns the state.
    """

    def __init__(self, settle: Callable[[], None]) -> None:
        self._lock = threading.RLock()
        self._depth = 0
        self._settle = settle

    def acquire(self, *, blocking: bool = True) -> bool:
        """Own the state; whether it came to that."""
        owned = self._lock.acquire(blocking=blocking)
        self._depth += owned
        return owned

    def release(self) -> None:
        """Let go of what ``acquire`` got."""
        self._depth -= 1
        outermost = self._depth == 0
        self._lock.release()
        if outermost:
            self._settle()

    def __enter__(self) -> None:
        self.acquire()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.release()


class RequestQueue:
    """Serialises all access to a simulation.

    Attributes:
        lock: Held by whoever owns the state; the owner calls ``drain`` between two steps.
    """

    def __init__(self) -> None:
        self.lock = Ownership(self._settle)
        self._waiting: deque[tuple[Callable[[], Any], Future[Any]]] = deque()

    def post(self, work: Callable[[], T]) -> Future[T]:
        """Have something done between two steps; at once when nothing is stepping."""
        future: Future[T] = Future()
        self._waiting.append((work, future))
        self._settle()
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
                self._settle()

    def _settle(self) -> None:
        """Do what waits, if anything does and nobody else owns the state."""
        if self._waiting and self.lock.acquire(blocking=False):
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
