"""The two sides of a service connection."""

from __future__ import annotations

import contextlib
import socket
import time
from collections.abc import Callable

from gazelle_ros import net
from gazelle_ros.errors import (
    ProtocolError,
    RosError,
    RosTimeoutError,
    ServiceError,
    ServiceFailedError,
)
from gazelle_ros.limits import NetworkLimits
from gazelle_ros.loop import READ, EventLoop
from gazelle_ros.serial_queue import SerialQueue
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.dedicated import DedicatedReader
from gazelle_ros.tcpros.frames import LENGTH, FrameReader
from gazelle_ros.tcpros.outbound import AT_ONCE, wait_writable

_MOST_WAITING = 1000
_SEND_PATIENCE_S = 30.0
_FLAGS = AT_ONCE or 0
_LINGER_S = 0.1
"""A roscpp client loses an answer now and then if the connection ends right behind it; clients end
theirs when they have the answer, and this is how long they are given for that."""

Answer = Callable[[bytes, dict[str, str]], bytes]
"""From a request and the client's header to the whole answer; runs on a worker."""


class ServiceConnection:
    """The server's side: requests in, answers out, in order.

    Args:
        loop: Its event loop.
        sock: Connected, header exchanged, non-blocking.
        fields: The client's header; without ``persistent`` one call ends the connection.
        answer: Does the work.
        on_close: Called on the loop's thread when the connection is gone.
    """

    def __init__(
        self,
        loop: EventLoop,
        sock: socket.socket,
        fields: dict[str, str],
        answer: Answer,
        limits: NetworkLimits,
        on_close: Callable[[ServiceConnection], None],
    ) -> None:
        self._loop = loop
        self._sock = sock
        self.fields = fields
        self.peer = fields.get("callerid", "")
        self._answer = answer
        self._on_close = on_close
        self._persistent = headers.flag(fields, "persistent")
        self._reader = FrameReader(limits.message_bytes)
        self._queue = SerialQueue(loop, self._work, f"service call of {self.peer}")
        self._closed = False
        self._working = False
        self._dedicated = DedicatedReader(loop, self._read_next, self._return_socket)

    def start(self, reply: bytes, rest: bytes) -> None:
        """Send the header and take requests. Only on the loop's thread."""
        with contextlib.suppress(OSError):
            self._sock.send(reply)
        self._loop.watch(self._sock, READ, self._ready)
        if rest:
            try:
                self._take(self._reader.cut(rest))
            except ProtocolError:
                self.close()

    def close(self) -> None:
        """Close the connection. Only on the loop's thread."""
        if self._closed:
            return
        self._closed = True
        self._on_close(self)
        self._loop.unwatch(self._sock)
        with contextlib.suppress(OSError):
            self._sock.shutdown(
                socket.SHUT_RDWR
            )  # ends the waiting of a worker that sends or reads
        self._dedicated.stop()
        self._close_socket()

    def _close_socket(self) -> None:
        """Close the socket once no worker uses it; the last worker requests this when done."""
        if not (self._working or self._dedicated.active):
            self._loop.close(self._sock)

    def _ready(self, _events: int) -> None:
        try:
            self._take(self._reader.read(self._sock))
        except (OSError, ProtocolError):
            self.close()
            return
        if self._persistent and self._dedicated.is_wanted() and not self._closed:
            self._dedicated.begin(self._sock)

    def _read_next(self) -> bool:
        """Wait for requests and answer them; runs on a worker while there are many."""
        before = self._reader.received
        requests = self._reader.read(self._sock)
        if requests:
            self._queue.handle_all(requests)
        return self._reader.received > before

    def _return_socket(self, _sock: socket.socket, error: RosError | None) -> None:
        """Return the socket to the event loop."""
        if self._closed:
            self._close_socket()
        elif error is not None:
            self.close()
        else:
            self._loop.watch(self._sock, READ, self._ready)

    def _take(self, requests: list[bytes]) -> None:
        if not requests:
            return
        if not self._persistent:
            # One call is all there is; what else comes is not read.
            self._loop.unwatch(self._sock)
            requests = requests[:1]
        elif len(self._queue.items) > _MOST_WAITING:
            self.close()
            return
        self._queue.post_all(requests)

    def _work(self, request: bytes) -> None:
        self._working = True  # before it looks whether the connection is closed
        try:
            if not self._closed:
                self._send(self._answer(request, self.fields))
        finally:
            self._working = False
            if self._closed:
                self._loop.call_soon(self._close_socket)
            elif not self._persistent:
                self._loop.call_soon(self._linger)

    def _linger(self) -> None:
        """Wait for the client to close the connection, if it does so shortly."""
        if not self._closed:
            self._loop.watch(self._sock, READ, self._part)
            self._loop.call_later(_LINGER_S, self.close)

    def _part(self, _events: int) -> None:
        """Read after the client closed, or sent too much, lest that counts as a reset."""
        with contextlib.suppress(OSError):
            self._sock.recv(65536)
        self.close()

    def _send(self, data: bytes) -> None:
        try:
            sent = self._sock.send(data, _FLAGS)
        except (BlockingIOError, InterruptedError):
            sent = 0
        except OSError:
            self._loop.call_soon(self.close)
            return
        if sent < len(data):
            self._send_patiently(memoryview(data)[sent:])

    def _send_patiently(self, rest: memoryview) -> None:
        deadline = time.monotonic() + _SEND_PATIENCE_S
        try:
            while rest and not self._closed:
                try:
                    rest = rest[self._sock.send(rest, _FLAGS) :]
                except (BlockingIOError, InterruptedError):
                    if time.monotonic() > deadline:
                        raise ConnectionError("the client does not take its answer") from None
                    wait_writable(self._sock, 0.5)
        except OSError:
            self._loop.call_soon(self.close)


def good_answer(body: bytes) -> bytes:
    """Encode a response for the wire."""
    return b"\x01" + LENGTH.pack(len(body)) + body


def bad_answer(text: str) -> bytes:
    """Encode a failure for the wire."""
    body = text.encode(errors="replace")
    return b"\x00" + LENGTH.pack(len(body)) + body


class ServiceChannel:
    """The client's side: a blocking connection to a service.

    Raises:
        ServiceError: No connection, or the server refuses; the text says why.
        RosTimeoutError: It took too long.
    """

    def __init__(
        self,
        host: str,
        port: int,
        fields: dict[str, str],
        limits: NetworkLimits,
        deadline: float | None,
    ) -> None:
        self._limits = limits
        self._sock = self._connect(host, port, deadline)
        try:
            self.header = self._greet(fields, deadline)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the connection."""
        self._sock.close()

    def is_stale(self) -> bool:
        """Return True if the server closed the connection, or sent something unexpected."""
        self._sock.settimeout(0.0)
        try:
            self._sock.recv(1, socket.MSG_PEEK)
        except (BlockingIOError, InterruptedError):
            return False
        except OSError:
            return True
        return True

    def call(self, request: bytes, deadline: float | None) -> bytes:
        """Send a framed request, return the body of the response.

        Raises:
            ServiceFailedError: The server says it failed.
            ServiceError: The connection broke, or its data is invalid.
            RosTimeoutError: No answer in time.
        """
        try:
            self._allow(deadline)
            self._sock.sendall(request)
            head = self._read(5, deadline)
            (length,) = LENGTH.unpack_from(head, 1)
            if length > self._limits.message_bytes:
                raise ServiceError(f"a response of {length} bytes exceeds the limit")
            body = self._read(length, deadline) if length else b""
        except TimeoutError:
            raise RosTimeoutError("the service does not answer in time") from None
        except OSError as error:
            raise ServiceError(f"transport error completing service call: {error}") from None
        if head[0] != 1:
            raise ServiceFailedError(body.decode(errors="replace"))
        return body

    @staticmethod
    def _connect(host: str, port: int, deadline: float | None) -> socket.socket:
        timeout = None if deadline is None else max(0.001, deadline - time.monotonic())
        try:
            sock = net.connect(host, port, timeout)
        except TimeoutError:
            raise RosTimeoutError("the service does not take the connection in time") from None
        except OSError as error:
            raise ServiceError(f"unable to connect to service: {error}") from None
        net.ignore_delay(sock)
        return sock

    def _greet(self, fields: dict[str, str], deadline: float | None) -> dict[str, str]:
        try:
            self._allow(deadline)
            self._sock.sendall(headers.encode(fields))
            (length,) = LENGTH.unpack(self._read(4, deadline))
            if length > self._limits.header_bytes:
                raise ServiceError("unable to connect to service: its header is too long")
            reply = headers.decode(self._read(length, deadline))
        except TimeoutError:
            raise RosTimeoutError("the service does not answer in time") from None
        except (OSError, ProtocolError) as error:
            raise ServiceError(f"unable to connect to service: {error}") from None
        if "error" in reply:
            raise ServiceError(f"unable to connect to service: {reply['error']}")
        return reply

    def _allow(self, deadline: float | None) -> None:
        if deadline is None:
            self._sock.settimeout(None)
            return
        left = deadline - time.monotonic()
        if left <= 0:
            raise TimeoutError
        self._sock.settimeout(left)

    def _read(self, size: int, deadline: float | None) -> bytes:
        data = self._sock.recv(size)
        if len(data) == size:
            return data
        parts, have = [data], len(data)
        while have < size:
            if not parts[-1]:
                raise ConnectionResetError("the server closed the connection")
            self._allow(deadline)
            parts.append(self._sock.recv(min(size - have, 1 << 22)))
            have += len(parts[-1])
        return b"".join(parts)
