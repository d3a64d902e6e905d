"""Requests to end a process: Ctrl-C, SIGTERM and SIGHUP, alike for every command and node.

A signal handler runs between two instructions of the main thread, which may hold any lock, also that
of the event it waits for. The handlers here therefore take no lock: they note the signal, write a byte
to a pipe, and at most raise `Interrupted`. A thread reads the pipe and sets events.

The first request asks (sets the event of `stopping`, or raises). The second, half a second later or
more, raises. The third ends the process at once. Two signals within half a second are one request:
``timeout`` sends one to its child and one to the whole group.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any, NoReturn

from gazelle_ros.base.program import program_name

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
_SAME_S = 0.5
"""Signals within this time are one request [s]."""
_DEAF_S = 1.5
"""A main thread that runs no handler for so long is inside a library, and cannot be interrupted [s]."""
_LOOKS = 30
"""Checks within that time, so that a process that was paused is not taken for stuck."""
_LOST_S = 0.7
"""An exception that was swallowed, as in a destructor, is raised again after this time [s]."""
_HANDLED = 128
"""Added to the number of a signal by the handler; Python itself writes the bare number."""
_END = 0
_INSIST_AT, _EXIT_AT = 2, 3


class Interrupted(KeyboardInterrupt):
    """A request to end the process, raised in its main thread.

    Args:
        number: The signal.

    Attributes:
        signal: The signal.
    """

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.signal = number


class StopRequest(threading.Event):
    """An event that is set when the process is asked to end.

    Args:
        action: Called then, on another thread.
        timeout: Time after which the main thread is interrupted all the same [s].

    Attributes:
        signal: The signal that asked; None so far.
        timeout: As above; it can be set until the request comes.
        timed_out: Whether the main thread was interrupted then.
        over: Set once the request is of no use any more.
    """

    def __init__(
        self, action: Callable[[], object] | None = None, timeout: float | None = None
    ) -> None:
        super().__init__()
        self.signal: int | None = None
        self.timeout = timeout
        self.timed_out = False
        self.over = threading.Event()
        self._action = action

    def is_set(self) -> bool:
        """Return whether the process was asked to end, at once after a signal."""
        return self.signal is not None or super().is_set()

    def request(self, number: int) -> None:
        """Set the event, and call the action."""
        self.signal = number
        self.set()
        if self._action is not None:
            self._action()


def exit_code(error: KeyboardInterrupt) -> int:
    """Return the exit code of a process that was interrupted, 128 and the signal."""
    return 128 + int(getattr(error, "signal", signal.SIGINT))


def requested() -> bool:
    """Return whether a request asked this process to end, and a block that ends it has begun."""
    return _active is not None and _active.asked


def end_process(code: int) -> NoReturn:
    """End the process without waiting for threads and without freeing memory.

    The interpreter takes a second to take torch apart, and waits for every thread.
    """
    atexit._run_exitfuncs()  # noqa: SLF001  # temporary folders, logs, a cluster
    for stream in (sys.stdout, sys.stderr):
        with contextlib.suppress(OSError, ValueError, AttributeError):
            stream.flush()
    os._exit(code)


@contextlib.contextmanager
def stopping(
    action: Callable[[], object] | None = None, timeout: float | None = None
) -> Iterator[StopRequest]:
    """Make stop requests set an event instead of interrupting the main thread, while it lasts.

    Off the main thread, nothing ever sets it.

    Args:
        action: Called when the event is set, on another thread.
        timeout: Time after which the main thread is interrupted all the same [s]; for ever if None.

    Raises:
        Interrupted: The timeout passed, or a second request came.
    """
    request = StopRequest(action, timeout)
    with _received(request):
        try:
            yield request
        finally:
            request.over.set()


@contextlib.contextmanager
def interruptible(*, ends_process: bool = False) -> Iterator[None]:
    """Make stop requests interrupt the main thread by `Interrupted`, while it lasts.

    Args:
        ends_process: The process ends after the block; until it has, signals stay handled.

    Raises:
        Interrupted: The process was asked to end.
    """
    with _received(None, ends_process=ends_process) as listener:
        try:
            yield
        except Exception as error:
            # Libraries make other errors of an interrupt, as while a module of theirs is imported.
            if listener is not None and listener.interrupted is not None:
                raise Interrupted(listener.interrupted) from error
            raise


@contextlib.contextmanager
def holding() -> Iterator[None]:
    """Defer interrupts until the block has ended, as while a process is being started.

    Raises:
        Interrupted: The process was asked to end meanwhile.
    """
    listener = _active
    if listener is None or threading.current_thread() is not threading.main_thread():
        yield
        return
    listener.held += 1
    try:
        yield
    finally:
        listener.held -= 1
    if listener.late and not listener.held:
        listener.late = False
        raise Interrupted(listener.interrupted or signal.SIGINT)


class SignalRelay:
    """A way from a signal handler to a thread that may take locks.

    Args:
        action: Called on the thread with each number that is posted.
    """

    def __init__(self, action: Callable[[int], object]) -> None:
        self._read, self._write = os.pipe()
        os.set_blocking(self._write, False)
        self._action = action
        self._thread = threading.Thread(target=self._run, name="signals", daemon=True)
        self._thread.start()

    def post(self, number: int) -> None:
        """Send a number above 0; fit for a signal handler."""
        with contextlib.suppress(BlockingIOError):  # enough are queued already
            os.write(self._write, bytes([number]))

    @property
    def descriptor(self) -> int:
        """The end of the pipe to write to."""
        return self._write

    def close(self) -> None:
        """Stop the thread."""
        os.set_blocking(self._write, True)
        os.write(self._write, bytes([_END]))
        if self._thread is not threading.current_thread():
            self._thread.join()
        self.abandon()

    def abandon(self) -> None:
        """Close the pipe in a process that has no such thread, after a fork."""
        for descriptor in (self._read, self._write):
            os.close(descriptor)

    def _run(self) -> None:
        while True:
            for number in os.read(self._read, 64):
                if number == _END:
                    return
                self._action(number)


class _Listener:
    """The handlers of this process, while requests have receivers."""

    def __init__(self) -> None:
        self.receivers: list[StopRequest | None] = []
        self._chosen: StopRequest | None = None
        self._count = 0
        self._last = -_SAME_S
        self._number: int | None = None
        self._again = False
        self.interrupted: int | None = None
        self.held = 0
        self.late = False
        self._closing = threading.Event()
        self._main = threading.get_ident()
        self._relay = SignalRelay(self._relayed)
        self._wakeup = signal.set_wakeup_fd(self._relay.descriptor, warn_on_full_buffer=False)
        self._before: dict[int, Any] = {}
        for number in _SIGNALS:
            # Shells start background jobs with Ctrl-C ignored; nohup means what it says.
            if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:
                self._before[number] = signal.signal(number, self._on_signal)
        self._report = sys.unraisablehook
        sys.unraisablehook = self._on_unraisable

    def add(self, receiver: StopRequest | None) -> None:
        """Set the receiver of the next request; None raises."""
        self.receivers.append(receiver)
        if receiver is not None and self._number is not None:
            receiver.request(self._number)  # who asked before did not ask in vain

    @property
    def asked(self) -> bool:
        """True after a request to end."""
        return self._number is not None

    def close(self) -> None:
        """Restore the handlers."""
        self._closing.set()
        self._restore()
        self._relay.close()

    def abandon(self) -> None:
        """Restore the handlers in a forked child."""
        self._restore()
        self._relay.abandon()

    def _restore(self) -> None:
        for number, before in self._before.items():
            if signal.getsignal(number) == self._on_signal:
                signal.signal(number, signal.SIG_DFL if before is None else before)
        signal.set_wakeup_fd(self._wakeup)
        if sys.unraisablehook == self._on_unraisable:
            sys.unraisablehook = self._report

    def _on_unraisable(self, lost: sys.UnraisableHookArgs) -> None:
        """Report an exception that a destructor or a weak reference swallowed; an interrupt comes again."""
        if not isinstance(lost.exc_value, Interrupted):
            self._report(lost)

    # On the main thread, anywhere: no locks ------------------------------------------------------

    def _on_signal(self, number: int, _frame: FrameType | None) -> None:
        if self._again:
            self._again = False
            if not _unwinding() and self.receivers[-1:] in ([None], [self._chosen]):
                self.interrupted = self._number or number
                if not self.held:
                    raise Interrupted(self.interrupted)
                self.late = True
            return
        now = time.monotonic()
        if now - self._last < _SAME_S:
            return
        self._last, self._number = now, number
        self._count += 1
        if self._count >= _EXIT_AT or not self.receivers:
            os._exit(128 + number)
        self._chosen = self.receivers[-1]
        if self._chosen is not None:
            self._chosen.signal = number
        self._relay.post(_HANDLED | number)
        if self._chosen is None or self._count >= _INSIST_AT:
            self.interrupted = number
            if not self.held:
                raise Interrupted(number)
            self.late = True

    # On the thread of the relay ------------------------------------------------------------------

    def _relayed(self, byte: int) -> None:
        if byte & _HANDLED:
            if self._chosen is not None:
                self._chosen.request(byte - _HANDLED)
                self._interrupt_after_timeout(self._chosen)
            else:
                self._raise_again()
        elif byte in self._before:
            self._await_handler(byte)

    def _interrupt_after_timeout(self, request: StopRequest) -> None:
        """Raise `Interrupted` in the main thread if a request leads to nothing within its time."""
        if request.timeout is None or request.over.wait(request.timeout):
            return
        request.timed_out = self._again = True
        signal.pthread_kill(self._main, signal.SIGINT)

    def _await_handler(self, number: int) -> None:
        """Wake the main thread, and end the process if it does not run the handler.

        Of two signals that come together the main thread may note both and continue waiting.
        """
        for _ in range(_LOOKS):
            if self._count or self._closing.wait(_DEAF_S / _LOOKS):
                return
            signal.pthread_kill(self._main, number)
        if self.receivers[-1:] != [None]:
            return
        with contextlib.suppress(OSError):
            os.write(2, f"\n{program_name()}: interrupted\n".encode())
        os._exit(128 + number)

    def _raise_again(self) -> None:
        """Raise a lost interrupt again, until the block has ended."""
        while not self._closing.wait(_LOST_S) and self.receivers:
            self._again = True
            signal.pthread_kill(self._main, signal.SIGINT)


def _unwinding() -> bool:
    """Return whether the main thread is cleaning up after an interrupt."""
    error = sys.exc_info()[1]
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return True
        error = error.__context__
    return False


_active: _Listener | None = None


@contextlib.contextmanager
def _received(
    receiver: StopRequest | None, *, ends_process: bool = False
) -> Iterator[_Listener | None]:
    global _active  # noqa: PLW0603  # the handlers of a process are one thing
    if threading.current_thread() is not threading.main_thread():
        yield None
        return
    if _active is None:
        _active = _Listener()
    listener = _active
    listener.add(receiver)
    try:
        yield listener
    finally:
        listener.receivers.remove(receiver)
        if not listener.receivers and not ends_process and listener is _active:
            _active = None
            listener.close()


def _forget() -> None:
    """Handle signals in a forked child as before; the thread and the pipe are the parent's."""
    global _active
    listener, _active = _active, None
    if listener is not None:
        listener.abandon()


os.register_at_fork(after_in_child=_forget)
