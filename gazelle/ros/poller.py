"""Waiting for sockets: epoll where there is one, else what the system has.

`selectors` does the same for any system, but costs as much time for each message as decoding
a small one.
"""

from __future__ import annotations

import contextlib
import io
import os
import select
import selectors
import socket
import sys
from collections.abc import Callable, Sequence
from typing import Protocol

READ = selectors.EVENT_READ
WRITE = selectors.EVENT_WRITE

_ONE = (1).to_bytes(8, sys.byteorder)

Handler = Callable[[int], None]
Ready = Sequence[tuple[int, int]]


class Poller(Protocol):
    """Says which sockets are ready."""

    handlers: dict[int, Handler]
    """By file descriptor."""

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """Wait for `events` on `sock`; 0 ends it."""

    def poll(self, timeout: float | None) -> Ready:
        """Wait; returns file descriptors and their events, as `happened` translates.

        There may be numbers among them that have no handler.
        """

    def ring(self) -> None:
        """End the wait, or the next one, of another thread."""

    def close(self) -> None:
        """Release the system's resources."""


class SelectorPoller:
    """For any system."""

    def __init__(self) -> None:
        self.handlers: dict[int, Handler] = {}
        self._selector = selectors.DefaultSelector()
        self._bell, self._button = socket.socketpair()
        self._bell.setblocking(False)
        self._button.setblocking(False)
        self.watch(self._bell, READ, self._answer_bell)

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """See `Poller`."""
        number = sock.fileno()
        if number not in self.handlers:
            if events:
                self._selector.register(number, events)
                self.handlers[number] = handler
        elif events:
            self._selector.modify(number, events)
            self.handlers[number] = handler
        else:
            self._selector.unregister(number)
            del self.handlers[number]

    def poll(self, timeout: float | None) -> Ready:
        """See `Poller`."""
        wait = timeout if timeout is None or timeout > 0 else 0
        return [(key.fd, events) for key, events in self._selector.select(wait)]

    def ring(self) -> None:
        """See `Poller`."""
        with contextlib.suppress(OSError):
            self._button.send(b"\0")

    def close(self) -> None:
        """See `Poller`."""
        self._selector.close()
        self._bell.close()
        self._button.close()

    def _answer_bell(self, _events: int) -> None:
        with contextlib.suppress(BlockingIOError):
            self._bell.recv(4096)


class EpollPoller:
    """For Linux.

    Its bell is a counter of the system's that is never read: each ring is a new edge. A thread
    that waits for it is woken in half the time that a lock takes.
    """

    def __init__(self) -> None:
        self.handlers: dict[int, Handler] = {}
        self._epoll = select.epoll()
        counter = os.eventfd(0, os.EFD_CLOEXEC | os.EFD_NONBLOCK)
        self._bell = io.FileIO(counter, "wb")
        self._epoll.register(counter, select.EPOLLIN | select.EPOLLET)

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """See `Poller`."""
        number = sock.fileno()
        mask = (select.EPOLLIN if events & READ else 0) | (select.EPOLLOUT if events & WRITE else 0)
        if number not in self.handlers:
            if events:
                self._epoll.register(number, mask)
                self.handlers[number] = handler
        elif events:
            self._epoll.modify(number, mask)
            self.handlers[number] = handler
        else:
            self._epoll.unregister(number)
            del self.handlers[number]

    def poll(self, timeout: float | None) -> Ready:
        """See `Poller`."""
        if timeout is not None:
            # The system counts whole milliseconds; a bit too late is better than spinning.
            timeout = timeout + 0.001 if timeout > 0 else 0
        ready = self._epoll.poll(timeout)
        if len(ready) == 1 and ready[0][1] == READ:
            return ready  # READ has the same number
        return [(number, _happened(mask)) for number, mask in ready]

    def ring(self) -> None:
        """See `Poller`."""
        with contextlib.suppress(OSError, ValueError):
            self._bell.write(_ONE)

    def close(self) -> None:
        """See `Poller`."""
        self._epoll.close()
        self._bell.close()


def _happened(mask: int) -> int:
    """Errors and hang-ups wake whoever reads, and whoever writes."""
    return (READ if mask & ~select.EPOLLOUT else 0) | (WRITE if mask & ~select.EPOLLIN else 0)


def make() -> Poller:
    """The best poller there is."""
    usable = hasattr(select, "epoll") and hasattr(os, "eventfd")
    return EpollPoller() if usable else SelectorPoller()
