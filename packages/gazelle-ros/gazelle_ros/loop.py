"""The event loop of the process: one thread that waits for all its sockets and timers.

Handlers of sockets and timers run on that thread, so that what they own needs no locks; they are
quick and never wait. What may take long, such as a user's callback, goes to a pool of threads.

A socket that the loop watches is closed by the loop: `EventLoop.close` forgets it and closes it in one
step on the loop's thread, and every other use of a watched socket's number is an error that is said.
"""

from __future__ import annotations

import contextlib
import heapq
import os
import selectors
import socket
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from gazelle_ros.errors import report
from gazelle_ros.thread_pool import Task, ThreadPool

READ = selectors.EVENT_READ
WRITE = selectors.EVENT_WRITE

Handler = Callable[[int], None]


class TimerHandle:
    """Something that runs later, on the loop's thread; `cancel` it from anywhere."""

    __slots__ = ("callback",)

    def __init__(self, callback: Task) -> None:
        self.callback: Task | None = callback

    def cancel(self) -> None:
        """Cancel it, if it has not run yet."""
        self.callback = None


class EventLoop:
    """Sockets, timers and tasks of one process."""

    def __init__(self) -> None:
        self._selector = selectors.DefaultSelector()
        self._watched: dict[int, tuple[socket.socket, Handler]] = {}
        """Sockets and their handlers by file descriptor."""
        self._soon: deque[Task] = deque()
        self._timers: list[tuple[float, int, TimerHandle]] = []
        self._timer_count = 0
        self._sleeping = False
        self._stopping = False
        self._wakeup, self._waker = socket.socketpair()
        self._wakeup.setblocking(False)
        self._waker.setblocking(False)
        self.dedicated = 0
        """Busy sockets that workers read by themselves now; see `tcpros.dedicated`."""
        self._pool = ThreadPool(self.call_later)
        self.submit = self._pool.submit
        """Runs a task on a worker; what it raises is reported."""
        self._thread = threading.Thread(target=self._run, name="gazelle-ros-loop", daemon=True)
        self._thread.start()

    # What any thread may call ------------------------------------------------------------

    def is_current(self) -> bool:
        """Return True on the loop's own thread."""
        return self._thread is threading.current_thread()

    def call_soon(self, callback: Task) -> None:
        """Run `callback` on the loop's thread, after those asked for before."""
        self._soon.append(callback)
        if self._sleeping:
            self._sleeping = False
            self._wake()

    def call_later(self, seconds: float, callback: Task) -> TimerHandle:
        """Run `callback` on the loop's thread after `seconds` of wall time."""
        timer = TimerHandle(callback)
        due = time.monotonic() + seconds

        def add() -> None:
            self._timer_count += 1
            heapq.heappush(self._timers, (due, self._timer_count, timer))

        if self.is_current():
            add()
        else:
            self.call_soon(add)
        return timer

    def run(self, function: Callable[[], Any], timeout: float = 10.0) -> Any:
        """Run `function` on the loop's thread and wait for its result or exception.

        Raises:
            TimeoutError: The loop does not answer.
        """
        if self.is_current():
            return function()
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

    def stop(self, timeout: float = 2.0) -> None:
        """Stop all threads, as soon as their tasks are done, and wait for each so long [s]."""
        self._pool.stop(timeout)
        self._stopping = True
        self._wake()
        if not self.is_current():
            self._thread.join(timeout)

    # What only handlers may call ---------------------------------------------------------

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """Call `handler(ready)` whenever `sock` is ready for one of `events`, READ or WRITE.

        Raises:
            ValueError: The socket is closed, or there are no events.
            RuntimeError: This is not the loop's thread.
        """
        number = self._number(sock)
        if number < 0:
            raise ValueError("a closed socket cannot be watched")
        known = self._watched.get(number)
        if known is not None and known[0] is not sock:
            self._forget_stale(number)
            known = None
        if known is None:
            self._selector.register(number, events)
        else:
            self._selector.modify(number, events)
        self._watched[number] = sock, handler

    def unwatch(self, sock: socket.socket) -> None:
        """Stop watching a socket; one that is not watched is ignored.

        Raises:
            RuntimeError: This is not the loop's thread.
        """
        number = self._number(sock)
        known = self._watched.get(number)
        if known is not None and known[0] is sock:
            self._selector.unregister(number)
            del self._watched[number]

    def close(self, sock: socket.socket) -> None:
        """Close a socket that is, or was, watched; again is harmless.

        Raises:
            RuntimeError: This is not the loop's thread.
        """
        self.unwatch(sock)
        sock.close()

    def watches(self, number: int) -> bool:
        """Return whether a socket with that file descriptor is watched."""
        return number in self._watched

    def _number(self, sock: socket.socket) -> int:
        if not self.is_current():
            raise RuntimeError("only the event loop's thread says which sockets are watched")
        return sock.fileno()

    def _forget_stale(self, number: int) -> None:
        """Discard a watched socket that was closed elsewhere; its number is another's now."""
        report("the event loop", RuntimeError(f"socket {number} was closed while it was watched"))
        del self._watched[number]
        with contextlib.suppress(OSError):  # the system forgot it with the socket
            self._selector.unregister(number)

    # The loop ----------------------------------------------------------------------------

    def _run(self) -> None:
        self._selector.register(self._wakeup, READ)
        while not self._stopping:
            self._sleeping = True  # from here on others wake it, so look at their wishes after it
            ready = self._selector.select(self._patience())
            self._sleeping = False
            for key, events in ready:
                self._handle(key.fd, events)
            for _ in range(len(self._soon)):
                self._try(self._soon.popleft())
            self._run_timers()
        while self._soon:  # what workers asked for before they ended
            self._try(self._soon.popleft())
        self._selector.close()
        self._wakeup.close()
        self._waker.close()

    def _handle(self, number: int, events: int) -> None:
        known = self._watched.get(number)
        if known is not None:
            try:
                known[1](events)
            except Exception as error:  # noqa: BLE001  # one socket must not end the loop
                report("a socket's handler", error)
        elif number == self._wakeup.fileno():
            with contextlib.suppress(BlockingIOError):
                self._wakeup.recv(4096)
        # Else another handler of this very round closed it.

    def _patience(self) -> float | None:
        """Return the timeout for waiting on sockets [s]; None for no limit."""
        if self._soon or self._stopping:
            return 0.0
        if not self._timers:
            return None
        return max(0.0, self._timers[0][0] - time.monotonic())

    def _run_timers(self) -> None:
        while self._timers and self._timers[0][0] <= time.monotonic():
            timer = heapq.heappop(self._timers)[2]
            callback, timer.callback = timer.callback, None
            if callback is not None:
                self._try(callback)

    @staticmethod
    def _try(task: Task) -> None:
        try:
            task()
        except Exception as error:  # noqa: BLE001  # one task must not end the loop
            report("a task of the event loop", error)

    def _wake(self) -> None:
        with contextlib.suppress(OSError):  # it is awake anyway, or has ended
            self._waker.send(b"\0")


_shared: EventLoop | None = None
_users = 0
_lock = threading.Lock()


def _forget_loop() -> None:
    """Discard the loop in a forked child: it has no threads, and its locks may be held."""
    global _shared, _users, _lock  # there is one loop a process
    _shared, _users, _lock = None, 0, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_loop)


def acquire() -> EventLoop:
    """Return the loop of this process, started if need be; return it with `release`."""
    global _shared, _users  # noqa: PLW0603  # there is one loop a process
    with _lock:
        if _shared is None:
            _shared, _users = EventLoop(), 0
        _users += 1
        return _shared


def release(loop: EventLoop) -> None:
    """Release the loop; the last user ends its threads."""
    global _shared, _users  # noqa: PLW0603  # there is one loop a process
    with _lock:
        if loop is not _shared:
            return
        _users -= 1
        if _users > 0:
            return
        _shared = None
    loop.stop()
