"""Re-entrant lock that threads hold in the order in which they ask for it.

Who gives it up hands it to the first thread that waits, and asks again behind all others. So no
thread waits longer than each other one holds it once. A lock of the system goes to whichever
thread runs next, which in a loop is mostly the one that had it.

Each method is compiled code that holds the interpreter's lock: neither another thread nor a
signal's exception comes between two of its lines, unless one of them calls Python. Where Python
runs this source the same is true between two calls, which is why the queue is read by index.
"""

# mypy: disallow-untyped-decorators=False

from __future__ import annotations

import functools
from _thread import allocate_lock
from collections import deque
from collections.abc import Callable
from types import TracebackType
from typing import Any

import cython

if not cython.compiled:
    from _thread import get_ident

    def check_signals() -> None:
        """Do nothing: Python checks for signals between its lines by itself."""


# How often a waiting thread checks that the owner can ever answer it [s]. A turn wakes it.
_LOOK: float = 0.25


def _wait_on(owner: int) -> None:
    """Wait for the thread that holds the lock."""


@cython.cclass
class Turn:
    """Place in the queue: of a thread that waits, or of work that the lock's owner does.

    Args:
        thread: Identifier of the thread; 0 for work.
        work: Work to do; None for a thread.
    """

    def __init__(self, thread: int, work: Callable[[], Any] | None = None) -> None:
        self.thread = thread
        self.work = work
        self.granted: Any = None
        if work is None:
            self.granted = allocate_lock()
            self.granted.acquire()


@cython.cclass
class FairLock:
    """Re-entrant lock, first come, first served; to be held with ``with``.

    Attributes:
        owner: Identifier of the thread that holds it; 0 for none.
        waiting: Turns of threads and of posted work, in the order in which they are served.
        closed: ``with`` calls ``refuse`` in threads that do not hold it already.
    """

    def __init__(self) -> None:
        self.owner = 0
        self.depth = 0
        self.closed = False
        self.waiting: deque[Turn] = deque()

    def watch(self) -> Callable[[int], None]:
        """Return what is called every now and then, with the owner, while a thread waits.

        What it raises ends the waiting; subclasses override it.
        """
        return _wait_on

    def refuse(self) -> None:
        """Raise the error of a closed lock; subclasses override it."""

    def acquire(self) -> None:
        """Acquire the lock once more, also if it is closed."""
        self._take()

    def release(self) -> None:
        """Release the lock once.

        Raises:
            RuntimeError: The calling thread does not hold it.
        """
        self._drop()

    def __enter__(self) -> None:
        self._enter()

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._drop()

    def is_owner(self) -> bool:
        """Return whether the calling thread holds it."""
        return bool(self.owner == get_ident())

    def yield_lock(self) -> None:
        """Release the lock to the waiting threads, and acquire it again after them.

        A thread that holds it more than once keeps it.

        Raises:
            KeyboardInterrupt: One came meanwhile; the calling thread holds the lock.
            Exception: ``watch`` raised it; the calling thread does not hold the lock.
        """
        interruption: Any = None
        if self.depth != 1 or not self.waiting:
            return
        while True:
            try:
                self._wait(Turn(get_ident()))
                break
            except KeyboardInterrupt as error:  # the state is another thread's meanwhile
                interruption = error
        if interruption is not None:
            raise interruption

    def submit(self, work: Callable[[], Any]) -> None:
        """Run work in the thread that holds the lock when its turn comes.

        In the owner it runs at once.
        """
        me: cython.ulong = get_ident()
        if self.owner == me:
            work()
            return
        self.waiting.append(Turn(0, work))
        if self.owner == 0:
            self.owner = me
            self.depth = 1
            self._pass_on()

    @cython.cfunc
    def _enter(self) -> Any:
        self._take()
        if self.closed and self.depth == 1:
            self._drop()
            self.refuse()

    @cython.cfunc
    def _take(self) -> Any:
        me: cython.ulong = get_ident()
        if self.owner == me:
            self.depth += 1
        elif self.owner == 0:
            self.owner = me
            self.depth = 1
        else:
            self._wait(Turn(me))

    @cython.cfunc
    def _drop(self) -> Any:
        if self.owner != get_ident():
            raise RuntimeError("a lock is released by a thread that does not hold it")
        if self.depth > 1:
            self.depth -= 1
        elif self.waiting:
            self._pass_on()
        else:
            self.owner = 0

    @cython.cfunc
    def _wait(self, turn: Turn) -> Any:
        """Wait behind all others until the lock is handed over; an exception ends the turn."""
        watch: Any = None
        try:
            self.waiting.append(turn)
            if self.owner == 0:  # given up meanwhile
                self.owner = turn.thread
                self.depth = 1
            if self.owner == turn.thread:
                self._pass_on()
            # A signal that comes before the lock sleeps does not wake it.
            while not turn.granted.acquire(True, _LOOK):
                if watch is None:
                    watch = self.watch()
                watch(self.owner)
                check_signals()
        except BaseException:
            if self.owner == turn.thread:
                self._pass_on()
            else:
                self.waiting.remove(turn)
            raise

    @cython.cfunc
    def _pass_on(self) -> Any:
        """Run the work that comes first, and hand the lock to the first waiting thread."""
        while self.waiting:
            turn: Turn = self.waiting[0]
            del self.waiting[0]
            if turn.work is None:
                self.owner = turn.thread
                turn.granted.release()
                return
            try:
                turn.work()
            except BaseException:
                self._pass_on()
                raise
        self.owner = 0


def locked(method: Callable[..., Any]) -> Callable[..., Any]:
    """Return a method that holds ``self._lock`` while it calls another; of None it holds nothing."""

    @functools.wraps(method)
    def holding(*args: Any, **options: Any) -> Any:
        lock: FairLock | None = args[0]._lock if args else None  # noqa: SLF001
        if lock is None or lock.owner == get_ident():
            return method(*args, **options)
        lock._enter()  # noqa: SLF001  its own class
        try:
            return method(*args, **options)
        finally:
            lock._drop()  # noqa: SLF001

    return holding
