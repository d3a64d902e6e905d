"""The event loop of the process: all sockets, all timers, all callbacks, few threads.

One thread at a time *leads*: it waits for sockets and timers and handles them. Work that
may take long, such as a user's callback, is submitted as a task. The leader then hands the
lead to another thread and runs the task itself, so a message reaches its callback
without a change of thread, yet a callback that blocks never blocks the loop. There are as many
threads as callbacks block at the same moment, plus two. Handlers of sockets and timers
run only on the leader: what they own needs no locks.

This is the leader/followers pattern (Schmidt and others, Pattern-Oriented Software
Architecture 2, 2000).
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

from gazelle.ros.errors import report

READ = selectors.EVENT_READ
WRITE = selectors.EVENT_WRITE

GRACE = 0.001
"""Seconds a busy thread may take before waiting tasks are given to another one."""
LINGER = 5.0
"""Seconds an idle thread waits for work before it ends."""
MOST_THREADS = 1000

Handler = Callable[[int], None]
Task = Callable[[], None]


class Timer:
    """Something that runs later, on the leader; `cancel` it from anywhere."""

    __slots__ = ("callback",)

    def __init__(self, callback: Task) -> None:
        self.callback: Task | None = callback

    def cancel(self) -> None:
        """Never run it, if it did not run yet."""
        self.callback = None


class _Seat:
    """A thread's place: the lock it sleeps on, and when its present task began."""

    __slots__ = ("started", "thread", "wake")

    def __init__(self) -> None:
        self.wake = threading.Lock()
        self.wake.acquire()
        self.started = 0.0
        self.thread: threading.Thread | None = None


class EventLoop:
    """Sockets, timers and tasks of one process."""

    def __init__(self) -> None:
        self._selector = selectors.DefaultSelector()
        self._soon: deque[Task] = deque()
        self._timers: list[tuple[float, int, Timer]] = []
        self._timer_count = 0
        self._tasks: deque[Task] = deque()
        self._mutex = threading.Lock()
        self._idle: list[_Seat] = []
        self._busy: set[_Seat] = set()
        self._threads: set[threading.Thread] = set()
        self._leader = 0
        self._sleeping = False
        self._stopping = False
        self._bell, self._button = socket.socketpair()
        self._bell.setblocking(False)
        self._button.setblocking(False)
        self._selector.register(self._bell, READ, self._answer_bell)
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

    def submit(self, task: Task) -> None:
        """Run `task`, which may take long, on a thread that does not lead."""
        self._tasks.append(task)
        if self._leader == threading.get_ident():
            return  # the leader looks at the tasks before it sleeps
        with self._mutex:
            seat = self._idle.pop() if self._idle else None
            if seat is not None:
                self._busy.add(seat)
                seat.started = time.monotonic()
        if seat is not None:
            seat.wake.release()
        else:
            self._ring()

    def run(self, function: Callable[[], Any], timeout: float = 10.0) -> Any:
        """Run `function` on the leader and wait for what it returns or raises."""
        if self.leads():
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

    # What only handlers may call ---------------------------------------------------------

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """Call `handler(ready)` whenever `sock` is ready for one of `events`; 0 ends it."""
        known = sock.fileno() >= 0 and sock in self._selector.get_map()
        if not known:
            if events:
                self._selector.register(sock, events, handler)
        elif events:
            self._selector.modify(sock, events, handler)
        else:
            self._selector.unregister(sock)

    # The life of the threads -------------------------------------------------------------

    def stop(self) -> None:
        """End all threads, as soon as their tasks are done, and wait for them."""
        self._stopping = True
        self._press()
        with self._mutex:
            seats, self._idle = self._idle, []
        for seat in seats:
            seat.wake.release()
        for thread in list(self._threads):
            if thread is not threading.current_thread():
                thread.join(timeout=2.0)

    def _spawn_leader(self) -> None:
        seat = _Seat()
        name = f"gazelle-ros-{self._timer_count}"
        thread = threading.Thread(target=self._work, args=(seat,), name=name, daemon=True)
        seat.thread = thread
        self._threads.add(thread)
        thread.start()

    def _work(self, seat: _Seat) -> None:
        """A thread's life: lead when nobody does, else run tasks, else sleep."""
        leading = True
        while not self._stopping:
            if leading:
                self._lead()
                if self._stopping:
                    break
                self._step_down(seat)
            self._run_tasks(seat)
            with self._mutex:
                self._busy.discard(seat)
                leading = False
                self._idle.append(seat)
            if not seat.wake.acquire(timeout=LINGER):
                with self._mutex:
                    retired = seat in self._idle
                    if retired:
                        self._idle.remove(seat)
                if retired:
                    break
                seat.wake.acquire()
            leading = seat not in self._busy
        self._leave(seat)

    def _leave(self, seat: _Seat) -> None:
        thread = seat.thread
        with self._mutex:
            self._busy.discard(seat)
            if thread is not None:
                self._threads.discard(thread)
            last = self._stopping and not self._threads
        if last:
            self._selector.close()
            self._bell.close()
            self._button.close()

    def _run_tasks(self, seat: _Seat) -> None:
        while not self._stopping:
            try:
                task = self._tasks.popleft()
            except IndexError:
                return
            seat.started = time.monotonic()
            try:
                task()
            except Exception as error:  # noqa: BLE001  # a task must not end its thread
                report("a task of the event loop", error)

    def _step_down(self, seat: _Seat) -> None:
        """Give the lead to another thread and become a worker."""
        self._leader = 0
        with self._mutex:
            self._busy.add(seat)
            seat.started = time.monotonic()
            heir = self._idle.pop() if self._idle else None
        if heir is not None:
            heir.wake.release()
        else:
            self._spawn_leader()

    def _should_step_down(self) -> bool:
        """True if waiting tasks would wait too long for the threads that are busy now."""
        if len(self._threads) >= MOST_THREADS and not self._idle:
            return False
        limit = time.monotonic() - GRACE
        with self._mutex:
            return all(seat.started < limit for seat in self._busy)

    def _lead(self) -> None:
        """Handle sockets and timers until there is a task to run."""
        self._leader = threading.get_ident()
        select = self._selector.select
        while not self._stopping:
            if self._tasks and self._should_step_down():
                return
            self._sleeping = True  # from here on others ring, so look at their wishes after it
            ready = select(self._patience())
            self._sleeping = False
            for key, events in ready:
                try:
                    key.data(events)
                except Exception as error:  # noqa: BLE001  # one socket must not end the loop
                    report("a socket's handler", error)
            if self._soon:
                self._run_soon()
            if self._timers:
                self._run_timers()

    def _patience(self) -> float | None:
        """How long to wait for sockets, in seconds; None for as long as it takes."""
        if self._soon or self._stopping:
            return 0.0
        if self._tasks:
            return GRACE
        if not self._timers:
            return None
        return max(0.0, self._timers[0][0] - time.monotonic())

    def _run_soon(self) -> None:
        for _ in range(len(self._soon)):
            self._call(self._soon.popleft())

    def _run_timers(self) -> None:
        now = time.monotonic()
        while self._timers and self._timers[0][0] <= now:
            timer = heapq.heappop(self._timers)[2]
            callback, timer.callback = timer.callback, None
            if callback is not None:
                self._call(callback)

    @staticmethod
    def _call(callback: Task) -> None:
        try:
            callback()
        except Exception as error:  # noqa: BLE001  # one callback must not end the loop
            report("a call on the event loop", error)

    def _ring(self) -> None:
        """Wake the leader if it sleeps."""
        if self._sleeping and self._leader != threading.get_ident():
            self._sleeping = False
            self._press()

    def _press(self) -> None:
        with contextlib.suppress(BlockingIOError, OSError):
            self._button.send(b"\0")

    def _answer_bell(self, _events: int) -> None:
        with contextlib.suppress(BlockingIOError):
            self._bell.recv(4096)


class Strand:
    """Handles items one at a time and in order, on whatever thread is free.

    Args:
        loop: The loop whose threads are used.
        handle: Called with each item; may take long, may raise.
        what: What the items are, for the report of an error.
    """

    BATCH = 256
    __slots__ = ("_handle", "_lock", "_loop", "_running", "items", "what")

    def __init__(self, loop: EventLoop, handle: Callable[[Any], None], what: str) -> None:
        self._loop = loop
        self._handle = handle
        self._lock = threading.Lock()
        self._running = False
        self.items: deque[Any] = deque()
        self.what = what

    def post(self, item: Any) -> None:
        """Handle `item` after those before it."""
        self.items.append(item)
        self._start()

    def post_all(self, items: list[Any]) -> None:
        """Handle several items, in order."""
        self.items.extend(items)
        self._start()

    def _start(self) -> None:
        with self._lock:
            if self._running or not self.items:
                return
            self._running = True
        self._loop.submit(self._run)

    def _run(self) -> None:
        items, handle = self.items, self._handle
        for _ in range(self.BATCH):
            try:
                item = items.popleft()
            except IndexError:
                break
            try:
                handle(item)
            except Exception as error:  # noqa: BLE001  # a callback must not end its thread
                report(self.what, error)
        with self._lock:
            if not items:
                self._running = False
                return
        self._loop.submit(self._run)  # others get a turn


_shared: EventLoop | None = None
_shared_pid = 0
_users = 0
_lock = threading.Lock()


def acquire() -> EventLoop:
    """The loop of this process, started if need be; give it back with `release`."""
    global _shared, _shared_pid, _users  # noqa: PLW0603  # there is one loop a process
    with _lock:
        if _shared is None or _shared_pid != os.getpid():
            _shared, _shared_pid, _users = EventLoop(), os.getpid(), 0
        _users += 1
        return _shared


def release(loop: EventLoop) -> None:
    """Give the loop back; the last user ends its threads."""
    global _shared, _users  # noqa: PLW0603  # there is one loop a process
    with _lock:
        if loop is not _shared or _shared_pid != os.getpid():
            return
        _users -= 1
        if _users > 0:
            return
        _shared = None
    loop.stop()
