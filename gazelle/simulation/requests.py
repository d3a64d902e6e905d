"""One owner of the state: whoever else wants something asks for it here.

A thread owns the state while it steps, or while it reads or changes something. What others ask
for meanwhile is done between two steps, by the owner, in the order it came; so spawn, delete and
reset never race with the physics, a reading is of one moment, and the answer comes after the
thing is true.
"""

from __future__ import annotations

import functools
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from types import TracebackType
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar

from gazelle.array_types import Worlds
from gazelle.errors import SimulationError
from gazelle.simulation.deadlocks import BlockedOwner
from gazelle.simulation.inputs import chosen

T = TypeVar("T")
P = ParamSpec("P")

# How often a waiting thread looks whether the owner can ever answer it [s]. Answers wake it.
_LOOK = 0.25


class RequestQueue:
    """Serialises all access to a simulation.

    Use it with ``with`` to own the state for several things at once.

    Args:
        nworld: Number of worlds that there are.

    Attributes:
        owner: Identifier of the thread that owns the state; 0 for nobody.
        waiting: What was asked for and is not done yet.
        closed: Whether nothing can be asked for any more.
        changes: How often it changed who listens, what is awake, or what there is.
    """

    def __init__(self, nworld: int = 1) -> None:
        self.owner = 0
        self._lock = threading.RLock()
        self._depth = 0
        self.waiting: deque[tuple[Callable[[], Any], Future[Any]]] = deque()
        self.closed = False
        self.changes = 0
        self.nworld = nworld
        self._reason = ""

    @property
    def lock(self) -> RequestQueue:
        """Itself, to be held by who owns the state for long; it calls ``drain`` between two steps."""
        return self

    def acquire(self) -> None:
        """Own the state, as soon as nobody else does.

        Raises:
            SimulationError: The thread that owns it waits for another; see ``deadlocks``.
        """
        if not self._try():
            owner = BlockedOwner()
            while not self._lock.acquire(timeout=_LOOK):
                owner.check(self.owner)
            self.owner = threading.get_ident()
            self._depth += 1

    def release(self) -> None:
        """Let go of what ``acquire`` got; what was asked for meanwhile is done."""
        self._depth -= 1
        if self._depth:
            self._lock.release()
            return
        self.owner = 0
        self._lock.release()
        # Who asked between the last look and the letting go could not do it alone.
        if self.waiting:
            self._settle()

    def _try(self) -> bool:
        """Own the state if nobody else does; whether it came to that."""
        if not self._lock.acquire(blocking=False):
            return False
        self.owner = threading.get_ident()
        self._depth += 1
        return True

    def __enter__(self) -> None:
        self.acquire()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.release()

    def post(self, work: Callable[[], T]) -> Future[T]:
        """Have something done between two steps; at once when nothing is stepping."""
        future: Future[T] = Future()
        self.waiting.append((work, future))
        self._settle()
        return future

    def call(self, work: Callable[[], T]) -> T:
        """Have something done between two steps and wait for its result.

        Raises:
            SimulationError: The simulation is closed, or waits for this very thread.
            Exception: What the work raised.
        """
        if self.owner == threading.get_ident():
            return work()
        if self.closed:
            raise SimulationError(self._reason)
        if not self._try():
            return self._wait(self.post(work))
        try:
            if self.waiting:
                self.drain()
            return work()
        finally:
            self.release()

    def _wait(self, future: Future[T]) -> T:
        owner = BlockedOwner()
        while True:
            try:
                return future.result(timeout=_LOOK)
            except TimeoutError:
                if future.done():
                    return future.result()
            self._settle()  # an interrupt may have kept the owner from it
            try:
                owner.check(self.owner)
            except SimulationError:
                if future.cancel():
                    raise

    def _settle(self) -> None:
        """Do what waits, if anything does and nobody else owns the state."""
        if self.waiting and self._try():
            try:
                self.drain()
            finally:
                self.release()

    def drain(self) -> None:
        """Do all that waits now; the caller owns the state."""
        for _ in range(len(self.waiting)):
            if not self.waiting:
                return
            work, future = self.waiting.popleft()
            if not future.set_running_or_notify_cancel():
                continue
            if self.closed:
                future.set_exception(SimulationError(self._reason))
                continue
            try:
                future.set_result(work())
            except Exception as error:  # noqa: BLE001  the waiting thread gets it, whatever it is
                future.set_exception(error)
            except BaseException:
                future.set_exception(SimulationError("the simulation was interrupted"))
                raise

    def close(self, reason: str) -> None:
        """Refuse all that waits, and all that is asked for from now on.

        Args:
            reason: The text of the error that they get.
        """
        self.closed, self._reason = True, reason
        self.drain()


class Owned(Protocol):
    """What belongs to a running simulation; without one it belongs to nobody."""

    @property
    def _requests(self) -> RequestQueue | None: ...


S = TypeVar("S", bound=Owned)


def between_steps(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """Let a method see and change the state between two steps, whichever thread calls it.

    In the thread that owns the state it is called as it is.
    """

    @functools.wraps(method)
    def asked(self: S, /, *args: P.args, **options: P.kwargs) -> T:
        requests = self._requests
        if requests is None or requests.owner == threading.get_ident():
            return method(self, *args, **options)
        return requests.call(lambda: method(self, *args, **options))

    return asked


class StatePart:
    """A part of what a simulation owns; it belongs to nobody until it is bound to one."""

    _requests: RequestQueue | None = None

    def _some(self, worlds: Worlds | None) -> Worlds | None:
        """Return indices of worlds that the simulation has.

        Raises:
            SimulationError: It has no such world.
        """
        return worlds if self._requests is None else chosen(worlds, self._requests.nworld)

    def bind(self, requests: RequestQueue | None) -> None:
        """Belong to a simulation."""
        self._requests = requests
