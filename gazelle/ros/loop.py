"""The event loop of the process: all sockets and timers, on few threads (see `crew`).

Handlers of sockets and timers run only on the leader: what they own needs no locks.
"""

from __future__ import annotations

import heapq
import os
import socket
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle.ros import poller
from gazelle.ros.crew import GRACE, Crew, Seat, Task
from gazelle.ros.errors import report
from gazelle.ros.poller import READ, WRITE, Handler, Ready

__all__ = ["READ", "WRITE", "EventLoop", "Handler", "Timer", "acquire", "give_way", "release"]


_MOST_ATTENDED = 4


class Timer:
    """Something that runs later, on the leader; `cancel` it from anywhere."""

    __slots__ = ("callback",)

    def __init__(self, callback: Task) -> None:
        self.callback: Task | None = callback

    def cancel(self) -> None:
        """Never run it, if it did not run yet."""
        self.callback = None


class EventLoop(Crew):
    """Sockets, timers and tasks of one process."""

    def __init__(self) -> None:
        super().__init__()
        self._poller = poller.make()
        self._soon: deque[Task] = deque()
        self._timers: list[tuple[float, int, Timer]] = []
        self._timer_count = 0
        self.attended = 0
        """Busy sockets that threads wait for by themselves; see `tcpros.attendant`."""
        self._spawn_leader()

    # What any thread may call ------------------------------------------------------------

    def leads(self) -> bool:
        """True on the leading thread."""
        return self._leader == threading.get_ident()

    def call_soon(self, callback: Task) -> None:
        """Run `callback` on the leader, after those asked for before."""
        self._soon.append(callback)
        self._ring()

    def call_later(self, seconds: float, callback: Task) -> Timer:
        """Run `callback` on the leader after `seconds` of wall time."""
        timer = Timer(callback)
        due = time.monotonic() + seconds

        def add() -> None:
            self._timer_count += 1
            heapq.heappush(self._timers, (due, self._timer_count, timer))

        if self.leads():
            add()
        else:
            self.call_soon(add)
        return timer

    def run(self, function: Callable[[], Any], timeout: float = 10.0) -> Any:
        """Run `function` on the leader and wait for what it returns or raises."""
        if self.leads():
            return function()
        self.give_way()
        done = threading.Lock()
        done.acquire()
        outcome: list[Any] = []

        def call() -> None:
            try:
                outcome.extend((True, function()))
            except BaseException as error:  # noqa: BLE001  # it is raised again in the caller
                outcome.extend((False, error))
            done.release()

        self.call_soon(call)
        if not done.acquire(timeout=timeout):
            raise TimeoutError("the event loop does not answer")
        if not outcome[0]:
            raise outcome[1]
        return outcome[1]

    # What only handlers may call ---------------------------------------------------------

    def may_attend(self) -> bool:
        """True if one more thread may wait for one socket alone."""
        return self.attended < _MOST_ATTENDED and not self._stopping

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """Call `handler(ready)` whenever `sock` is ready for one of `events`; 0 ends it."""
        self._poller.watch(sock, events, handler)

    # What the leader does ----------------------------------------------------------------

    def _lead(self, seat: Seat) -> bool:
        """Handle sockets and timers until there is a task to run; False if deposed."""
        self._leader = threading.get_ident()
        poll, clock = self._poller.poll, time.monotonic
        soon, quick, timers = self._soon, self._quick, self._timers
        now = clock()
        while not self._stopping:
            if self._tasks and self._should_step_down():
                return True
            self._sleeping = True  # from here on others ring, so look at their wishes after it
            ready = poll(self._patience(now))
            self._sleeping = False
            if ready:
                self._handle(ready)
            if soon:
                self._run_soon()
            now = clock()
            if quick and not self._run_quick(seat, now):
                return False
            if timers and timers[0][0] <= now:
                self._run_timers(now)
        return False

    def _handle(self, ready: Ready) -> None:
        handlers = self._poller.handlers
        for number, events in ready:
            handler = handlers.get(number)
            if handler is None:
                continue  # the bell, or a socket that another handler closed in this very round
            try:
                handler(events)
            except Exception as error:  # noqa: BLE001  # one socket must not end the loop
                report("a socket's handler", error)

    def _patience(self, now: float) -> float | None:
        """How long to wait for sockets, in seconds; None for as long as it takes."""
        if self._soon or self._quick or self._stopping:
            return 0.0
        if self._tasks:
            return GRACE
        if not self._timers:
            return None
        return self._timers[0][0] - now

    def _run_soon(self) -> None:
        for _ in range(len(self._soon)):
            self._try(self._soon.popleft())

    def _run_timers(self, now: float) -> None:
        while self._timers and self._timers[0][0] <= now:
            timer = heapq.heappop(self._timers)[2]
            callback, timer.callback = timer.callback, None
            if callback is not None:
                self._try(callback)

    def _press(self) -> None:
        self._poller.ring()

    def _close(self) -> None:
        self._poller.close()


_shared: EventLoop | None = None
_users = 0
_lock = threading.Lock()


def _forget_loop() -> None:
    """In a forked child there are no threads of the loop, and its locks may be held."""
    global _shared, _users, _lock  # as above
    _shared, _users, _lock = None, 0, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_loop)


def acquire() -> EventLoop:
    """The loop of this process, started if need be; give it back with `release`."""
    global _shared, _users  # noqa: PLW0603  # there is one loop a process
    with _lock:
        if _shared is None:
            _shared, _users = EventLoop(), 0
        _users += 1
        return _shared


def release(loop: EventLoop) -> None:
    """Give the loop back; the last user ends its threads."""
    global _shared, _users  # noqa: PLW0603  # there is one loop a process
    with _lock:
        if loop is not _shared:
            return
        _users -= 1
        if _users > 0:
            return
        _shared = None
    loop.stop()


def give_way() -> None:
    """Say that the calling thread is about to wait for something.

    It changes nothing but speed: a callback that waits without saying so holds up the loop
    for a few milliseconds.
    """
    if _shared is not None:
        _shared.give_way()
