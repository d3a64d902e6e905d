"""The lock on a simulation's state.

A thread holds it while it steps, reads or changes something. A thread that steps lends it between
two steps to those that wait. So spawn, delete and reset never race with the physics, and a
reading is of one moment.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import Concatenate, ParamSpec, Protocol, TypeVar

from gazelle.array_types import Worlds
from gazelle.errors import SimulationError
from gazelle.native.fair_lock import FairLock, locked
from gazelle.simulation.deadlocks import BlockedOwner
from gazelle.simulation.inputs import chosen

T = TypeVar("T")
P = ParamSpec("P")


class StateLock(FairLock):
    """Lock on all of a simulation, to be held with ``with``.

    Args:
        nworld: Number of worlds that there are.

    Attributes:
        changes: Counts changes of listeners, of sensors that are awake, and of models.
    """

    def __init__(self, nworld: int = 1) -> None:
        super().__init__()
        self.changes = 0
        self.nworld = nworld
        self._reason = ""

    def watch(self) -> Callable[[int], None]:
        """Return a check that the owner does not wait for other threads; see ``deadlocks``."""
        return BlockedOwner().check

    def refuse(self) -> None:
        """Raise the error that says why it is closed."""
        raise SimulationError(self._reason)

    def close(self, reason: str) -> None:
        """Close the lock: all threads that wait for it now or later get an error; the caller holds it.

        Args:
            reason: The text of the error that they get.
        """
        self.closed, self._reason = True, reason

    def post(self, work: Callable[[], T]) -> Future[T]:
        """Run a function between two steps, at once when nothing is stepping; do not wait."""
        future: Future[T] = Future()

        def do() -> None:
            if self.closed:
                future.set_exception(SimulationError(self._reason))
                return
            try:
                future.set_result(work())
            except Exception as error:  # noqa: BLE001  the caller gets it, whatever it is
                future.set_exception(error)
            except BaseException:
                future.set_exception(SimulationError("the simulation was interrupted"))
                raise

        self.submit(do)
        return future

    def wrap(self, work: Callable[P, T]) -> Callable[P, T]:
        """Return a function that holds the lock while it calls another."""

        def locked(*args: P.args, **options: P.kwargs) -> T:
            with self:
                return work(*args, **options)

        return locked


class Owned(Protocol):
    """Part of a running simulation; without one its lock is None."""

    @property
    def _lock(self) -> StateLock | None: ...


S = TypeVar("S", bound=Owned)


def between_steps(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """Wrap a method so that it holds the simulation's lock, from any thread."""
    held: Callable[Concatenate[S, P], T] = locked(method)
    return held


class StatePart:
    """A part of a simulation's state; it belongs to no simulation until it is bound to one."""

    _lock: StateLock | None = None

    def _some(self, worlds: Worlds | None) -> Worlds | None:
        """Return indices of worlds that the simulation has.

        Raises:
            SimulationError: It has no such world.
        """
        return worlds if self._lock is None else chosen(worlds, self._lock.nworld)

    def bind(self, lock: StateLock | None) -> None:
        """Bind the part to the lock of a simulation."""
        self._lock = lock
