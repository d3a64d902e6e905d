"""The threads of the event loop: who leads, who works, who sleeps.

One thread at a time *leads*: it waits for sockets and timers and handles them. Work that
may take long, such as a user's callback, is submitted as a task. For a task of unknown
length the leader hands the lead to another thread and runs the task itself. For one that
used to be quick it keeps the lead: then a *sentry*, an idle thread that looks at it every few
milliseconds, takes the lead away should the task be slow after all. So a message reaches its
callback without a change of thread, yet a callback that blocks does not block the loop.
There are as many threads as callbacks block at the same moment, plus two.

This is the leader/followers pattern (Schmidt and others, Pattern-Oriented Software
Architecture 2, 2000).
"""

from __future__ import annotations

import threading
import time
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable

from gazelle.ros.errors import report

GRACE = 0.001
"""Seconds a busy thread may take before waiting tasks are given to another one."""
LINGER = 5.0
"""Seconds an idle thread waits for work before it ends."""
MOST_THREADS = 1000
QUICK = 0.003
"""A task that took no longer, in seconds, is expected to be quick again."""
PATROL = 0.01
"""Seconds between two looks of the sentry."""
STALL = 0.008
"""Seconds after which a task that was expected to be quick loses the lead."""
FIRST_DOUBT = 0.05
"""Seconds for which a task that was slow is not expected to be quick; doubled each time."""
WATCH = 0.25
"""Seconds the sentry stays awake after the last quick task."""

Task = Callable[[], None]


class Seat:
    """A thread's place: the lock it sleeps on, and when its present task began."""

    __slots__ = ("lead", "started", "thread", "wake")

    def __init__(self) -> None:
        self.wake = threading.Lock()
        self.wake.acquire()
        self.started = 0.0
        self.lead = True
        """Whether it is to lead when it wakes."""
        self.thread: threading.Thread | None = None


class Crew(ABC):
    """Threads that take turns in leading."""

    def __init__(self) -> None:
        self._tasks: deque[Task] = deque()
        self._quick: deque[Task] = deque()
        self._last_quick = 0.0
        self._inline: Seat | None = None
        self._inline_ident = 0
        self._sentry: Seat | None = None
        self._spawned = 0
        self._mutex = threading.Lock()
        self._idle: list[Seat] = []
        self._busy: set[Seat] = set()
        self._threads: set[threading.Thread] = set()
        self._leader = 0
        self._sleeping = False
        self._stopping = False

    @abstractmethod
    def _lead(self, seat: Seat) -> bool:
        """Handle sockets and timers until there is a task to run; False if deposed."""

    @abstractmethod
    def _press(self) -> None:
        """Wake the leader."""

    @abstractmethod
    def _close(self) -> None:
        """The last thread ended."""

    def submit(self, task: Task, *, quick: bool = False) -> None:
        """Run `task` on a thread that does not wait for sockets.

        Args:
            task: What to run.
            quick: It is expected to take no longer than `QUICK`.
        """
        me = threading.get_ident()
        if me == self._leader or me == self._inline_ident:  # noqa: PLR1714  # this is the hot path
            (self._quick if quick else self._tasks).append(task)
            if me not in (self._leader, self._inline_ident):
                self._ring()  # deposed in this very moment
            return  # the leader looks at the tasks before it sleeps
        if quick:
            if self._sentry is not None and self._inline is None:
                # The leader is woken faster than an idle thread, and need not give up the lead.
                self._quick.append(task)
                self._ring()
                return
            self._last_quick = time.monotonic()  # so that the next idle thread is a sentry
        self._tasks.append(task)
        with self._mutex:
            seat = self._take_idle()
            if seat is not None:
                # While the leader runs a task itself, somebody else should lead.
                seat.lead = self._depose()
                if not seat.lead:
                    self._busy.add(seat)
                    seat.started = time.monotonic()
        if seat is not None:
            seat.wake.release()
        else:
            self._ring()

    def give_way(self) -> None:
        """Say that this thread is about to wait for something; it will not lead meanwhile."""
        if self._inline_ident != threading.get_ident():
            return
        with self._mutex:
            if not self._depose():
                return
            heir = self._take_idle()
        self._crown(heir)

    def _ring(self) -> None:
        """Wake the leader if it sleeps."""
        if self._sleeping and self._leader != threading.get_ident():
            self._sleeping = False
            self._press()

    # The life of the threads -------------------------------------------------------------

    def stop(self) -> None:
        """End all threads, as soon as their tasks are done, and wait for them."""
        self._stopping = True
        self._press()
        with self._mutex:
            seats, self._idle, self._sentry = self._idle, [], None
        for seat in seats:
            seat.wake.release()
        for thread in list(self._threads):
            if thread is not threading.current_thread():
                thread.join(timeout=2.0)

    def _spawn_leader(self) -> None:
        seat = Seat()
        self._spawned += 1
        thread = threading.Thread(
            target=self._work, args=(seat,), name=f"gazelle-ros-{self._spawned}", daemon=True
        )
        seat.thread = thread
        self._threads.add(thread)
        thread.start()

    def _work(self, seat: Seat) -> None:
        """A thread's life: lead when it is to, else run tasks, else sleep."""
        while not self._stopping:
            if seat.lead:
                seat.lead = False
                if self._lead(seat):
                    self._step_down(seat)
            self._run_tasks(seat)
            if not self._sleep(seat):
                break
        self._leave(seat)

    def _sleep(self, seat: Seat) -> bool:
        """Wait until there is something to do; False if the thread is to end."""
        with self._mutex:
            if self._stopping:
                return False
            self._busy.discard(seat)
            self._idle.append(seat)
            if self._sentry is None:
                self._sentry = seat
        while not seat.wake.acquire(timeout=self._nap(seat)):
            with self._mutex:
                if seat not in self._idle:
                    continue  # woken in this very moment
                if self._is_stalled() and self._depose():
                    self._forget_idle(seat)
                    seat.lead = True
                    return True
                if self._sentry is not seat and len(self._idle) > 1:
                    self._forget_idle(seat)
                    return False
        return True

    def _nap(self, seat: Seat) -> float:
        """How long an idle thread sleeps; short for the sentry while there is traffic."""
        if self._sentry is not seat:
            return LINGER
        if time.monotonic() - self._last_quick < WATCH:
            return PATROL
        with self._mutex:
            if self._inline is not None:
                return PATROL
            if self._sentry is seat:
                self._sentry = None
        return LINGER

    def _is_stalled(self) -> bool:
        return self._inline is not None and (
            time.monotonic() - self._inline.started > STALL or bool(self._tasks)
        )

    def _take_idle(self) -> Seat | None:
        """An idle thread that will be woken. With the mutex only."""
        if not self._idle:
            return None
        seat = self._idle.pop()
        if seat is self._sentry:
            self._sentry = None
        return seat

    def _forget_idle(self, seat: Seat) -> None:
        """An idle thread wakes by itself. With the mutex only."""
        self._idle.remove(seat)
        if seat is self._sentry:
            self._sentry = None

    def _depose(self) -> bool:
        """Take the lead from a leader that runs a task; True if there was one. With the mutex."""
        inline = self._inline
        if inline is None:
            return False
        self._inline, self._inline_ident = None, 0
        self._busy.add(inline)
        return True

    def _leave(self, seat: Seat) -> None:
        thread = seat.thread
        with self._mutex:
            self._busy.discard(seat)
            if thread is not None:
                self._threads.discard(thread)
            last = self._stopping and not self._threads
        if last:
            self._close()

    def _run_tasks(self, seat: Seat) -> None:
        while not self._stopping:
            try:
                task = self._tasks.popleft()
            except IndexError:
                return
            seat.started = time.monotonic()
            self._try(task)

    def _run_quick(self, seat: Seat, now: float) -> bool:
        """Run the quick tasks without giving away the lead; False if it was taken."""
        me, quick = self._leader, self._quick
        self._last_quick = seat.started = now
        with self._mutex:
            if self._sentry is None:  # nobody would notice if a task blocked
                self._tasks.extend(quick)
                quick.clear()
                return True
            self._leader, self._inline_ident, self._inline = 0, me, seat
        for _ in range(len(quick)):  # what comes meanwhile waits until sockets had their turn
            try:
                task = quick.popleft()
            except IndexError:  # deposed in this very moment, and the new leader took it
                break
            self._try(task)
            if self._inline is not seat:
                return False
            if quick:
                seat.started = time.monotonic()
        with self._mutex:
            kept = self._inline is seat
            if kept:
                self._inline, self._inline_ident, self._leader = None, 0, me
        return kept

    @staticmethod
    def _try(task: Task) -> None:
        try:
            task()
        except Exception as error:  # noqa: BLE001  # a task must not end its thread
            report("a task of the event loop", error)

    def _step_down(self, seat: Seat) -> None:
        """Give the lead to another thread and become a worker."""
        self._leader = 0
        with self._mutex:
            self._busy.add(seat)
            seat.started = time.monotonic()
            heir = self._take_idle()
        self._crown(heir)

    def _crown(self, heir: Seat | None) -> None:
        """Let an idle thread lead, or a new one."""
        if heir is None:
            self._spawn_leader()
        else:
            heir.lead = True
            heir.wake.release()

    def _should_step_down(self) -> bool:
        """True if waiting tasks would wait too long for the threads that are busy now."""
        if len(self._threads) >= MOST_THREADS and not self._idle:
            return False
        limit = time.monotonic() - GRACE
        with self._mutex:
            return all(seat.started < limit for seat in self._busy)
