"""Waiting for sockets: epoll where there is one, else what the system has.

`selectors` does the same for any system, but costs as much time for each message as decoding
a small one.
"""

from __future__ import annotations

import select
import selectors
import socket
from collections.abc import Callable, Iterable
from typing import Protocol

READ = selectors.EVENT_READ
WRITE = selectors.EVENT_WRITE

Handler = Callable[[int], None]
Ready = Iterable[tuple[int, int]]


class Poller(Protocol):
    """Says which sockets are ready."""

    handlers: dict[int, Handler]
    """By file descriptor."""

    def watch(self, sock: socket.socket, events: int, handler: Handler) -> None:
        """Wait for `events` on `sock`; 0 ends it."""

    def poll(self, timeout: float | None) -> Ready:
        """Wait; returns file descriptors and their events, as `happened` translates."""

    def close(self) -> None:
        """Release the system's resources."""


class SelectorPoller:
    """For any system."""

    def __init__(self) -> None:
        self.handlers: dict[int, Handler] = {}
        self._selector = selectors.DefaultSelector()

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
        return [(key.fd, events) for key, events in self._selector.select(timeout)]

    def close(self) -> None:
        """See `Poller`."""
        self._selector.close()


class EpollPoller:
    """For Linux."""

    def __init__(self) -> None:
        self.handlers: dict[int, Handler] = {}
        self._epoll = select.epoll()

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
            timeout = (int(timeout * 1000) + 1) / 1000 if timeout > 0 else 0
        ready = self._epoll.poll(timeout)
        if len(ready) == 1 and ready[0][1] == select.EPOLLIN:
            return ready  # READ has the same number
        return [(number, _happened(mask)) for number, mask in ready]

    def close(self) -> None:
        """See `Poller`."""
        self._epoll.close()


def _happened(mask: int) -> int:
    """Errors and hang-ups wake whoever reads, and whoever writes."""
    return (READ if mask & ~select.EPOLLOUT else 0) | (WRITE if mask & ~select.EPOLLIN else 0)


def make() -> Poller:
    """The best poller there is."""
    return EpollPoller() if hasattr(select, "epoll") else SelectorPoller()
