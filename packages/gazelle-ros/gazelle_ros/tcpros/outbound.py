"""A publisher's side of one connection: a socket and the messages that wait for it."""

from __future__ import annotations

import contextlib
import select
import socket
import sys
import threading
from collections import deque
from collections.abc import Callable, Mapping

from gazelle_ros import net
from gazelle_ros.loop import READ, WRITE, EventLoop

_BATCH = 65536
_POLL_S = 0.5
AT_ONCE: int | None = socket.MSG_DONTWAIT if sys.platform == "linux" else None
"""Flag of calls that must not wait; None where not all calls support it, or there is none."""


class OutboundLink:
    """Sends frames to one subscriber.

    `send` tries the socket at once, from the thread that publishes. What the socket does not
    take waits: with a queue size, that many frames at most, the oldest dropped, while the
    event loop sends them; without, the publishing thread waits.

    Args:
        loop: Its event loop.
        sock: Connected, header exchanged, non-blocking.
        header: Header of the subscriber.
        address: Of the subscriber.
        queue_size: Most frames to keep; None to wait instead.
        on_close: Called on the loop's thread when the connection is gone.
    """

    def __init__(
        self,
        loop: EventLoop,
        sock: socket.socket,
        header: Mapping[str, str],
        address: net.Address,
        queue_size: int | None,
        on_close: Callable[[OutboundLink], None],
    ) -> None:
        self._loop = loop
        self._sock = sock
        # Where single calls may refuse to wait, the system itself waits best for a slow peer.
        sock.setblocking(AT_ONCE is not None)
        self._flags = AT_ONCE or 0
        self.header = header
        self.peer = header.get("callerid", "")
        self.address = address
        self.port: int = sock.getsockname()[1]
        self.descriptor = sock.fileno()
        self.queue_size = queue_size
        self._on_close = on_close
        self._lock = threading.Lock()
        self._current: memoryview | None = None
        self._queue: deque[bytes] = deque()
        self.closed = False
        self._ended = False
        self.messages = 0
        self.bytes = 0
        self.dropped = 0
        self.number = 0
        """Identity in bus info."""

    def start(self, first: bytes = b"") -> None:
        """Send the header, and notice when the subscriber goes. Only on the loop's thread."""
        if first:
            with self._lock:
                self._send_or_keep(first)
        if not self.closed:
            events = READ if self._current is None else READ | WRITE
            self._loop.watch(self._sock, events, self._ready)

    def send(self, data: bytes) -> None:
        """Send a frame, or keep it for later; see the class."""
        with self._lock:
            if self.closed:
                return
            self.messages += 1
            self.bytes += len(data)
            if self._current is not None:
                self._enqueue(data)
                return
            try:
                sent = self._sock.send(data, self._flags)
            except (BlockingIOError, InterruptedError):
                sent = 0
            except OSError:
                self._give_up()
                return
            if sent == len(data):
                return
            if self.queue_size is None:
                self._send_patiently(memoryview(data)[sent:])
            else:
                self._current = memoryview(data)[sent:]
                self._loop.call_soon(self._watch_writable)

    def close(self) -> None:
        """Close the connection. Only on the loop's thread."""
        if self._ended:
            return
        self._ended = self.closed = True
        self._loop.unwatch(self._sock)
        with contextlib.suppress(OSError):
            self._sock.shutdown(socket.SHUT_RDWR)  # wakes a thread that waits in `send`
        self._close_socket()
        self._on_close(self)

    def finish(self) -> None:
        """Close when what waits has been sent, or soon anyway. Only on the loop's thread."""
        if self._current is None and not self._queue:
            self.close()
            return
        self._loop.call_later(1.0, self.close)

    def _close_socket(self) -> None:
        if self._lock.acquire(blocking=False):
            self._loop.close(self._sock)
            self._lock.release()
        else:
            self._loop.call_later(0.05, self._close_socket)

    def _enqueue(self, data: bytes) -> None:
        self._queue.append(data)
        if self.queue_size is not None and len(self._queue) > max(1, self.queue_size):
            self._queue.popleft()
            self.dropped += 1

    def _send_or_keep(self, data: bytes) -> None:
        try:
            sent = self._sock.send(data, self._flags)
        except (BlockingIOError, InterruptedError):
            sent = 0
        except OSError:
            self._give_up()
            return
        if sent < len(data):
            self._current = memoryview(data)[sent:]

    def _send_patiently(self, rest: memoryview) -> None:
        """Wait for the subscriber, as a publisher without queue does."""
        while rest and not self.closed:
            try:
                if AT_ONCE is None and not wait_writable(self._sock, _POLL_S):
                    continue
                sent = self._sock.send(rest)
            except (BlockingIOError, InterruptedError):
                continue
            except (OSError, ValueError):
                self._give_up()
                return
            rest = rest[sent:]

    def _give_up(self) -> None:
        self.closed = True
        self._loop.call_soon(self.close)

    def _watch_writable(self) -> None:
        if not self.closed:
            self._loop.watch(self._sock, READ | WRITE, self._ready)

    def _ready(self, events: int) -> None:
        if events & READ and not self._receive():
            self.close()
            return
        if events & WRITE:
            with self._lock:
                self._flush()

    def _receive(self) -> bool:
        """Check the connection, on which subscribers send nothing more; False if it is closed."""
        try:
            return bool(self._sock.recv(4096, self._flags))
        except (BlockingIOError, InterruptedError):
            return True
        except OSError:
            return False

    def _flush(self) -> None:
        """Send what waits, many small frames at a time."""
        while True:
            if self._current is None:
                if not self._queue:
                    break
                self._current = memoryview(self._gather())
            try:
                sent = self._sock.send(self._current, self._flags)
            except (BlockingIOError, InterruptedError):
                return
            except OSError:
                self._give_up()
                return
            self._current = self._current[sent:] if sent < len(self._current) else None
        if not self.closed:
            self._loop.watch(self._sock, READ, self._ready)

    def _gather(self) -> bytes:
        first = self._queue.popleft()
        if not self._queue or len(first) >= _BATCH:
            return first
        parts, size = [first], len(first)
        while self._queue and size + len(self._queue[0]) <= _BATCH:
            parts.append(self._queue.popleft())
            size += len(parts[-1])
        return b"".join(parts)


def wait_writable(sock: socket.socket, seconds: float) -> bool:
    """Wait until the socket takes more; True if it does, or is closed."""
    if hasattr(select, "poll"):
        poll = select.poll()
        poll.register(sock, select.POLLOUT)
        return bool(poll.poll(seconds * 1000))
    return bool(select.select([], [sock], [], seconds)[1])
