"""An XML-RPC client that waits for the answer."""

from __future__ import annotations

import contextlib
import select
import socket
import threading
from typing import Any

from gazelle_ros import net
from gazelle_ros.base.deadlines import LONGEST_WAIT
from gazelle_ros.base.real_numbers import finite
from gazelle_ros.errors import (
    NoTimeError,
    ProtocolError,
    RefusedConnectionError,
    SilentPeerError,
    UnreachableError,
)
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.xmlrpc.http import HttpMessage, MessageReader, request
from gazelle_ros.xmlrpc.reading import read_response
from gazelle_ros.xmlrpc.writing import write_call

_CHUNK = 65536
_MOST_IDLE = 4


def value_of_answer(message: HttpMessage, limits: NetworkLimits) -> Any:
    """Return the value of an answer.

    Raises:
        ProtocolError: Its HTTP status is no success.
        FaultError: It is a fault.
        MarshalError: It is not XML-RPC.
    """
    status = message.first[1]
    if status != "200":
        raise ProtocolError(f"HTTP status {status}")
    return read_response(message.body, limits)


class BlockingClient:
    """Calls a server and waits; usable from many threads; keeps connections open.

    Args:
        uri: Of the server.
        timeout: Seconds to wait for an answer.

    Raises:
        NoTimeError: The timeout is not above 0, or longer than anything waits.
    """

    def __init__(self, uri: str, timeout: float = 30.0, limits: NetworkLimits = LIMITS) -> None:
        if (finite(timeout, LONGEST_WAIT) or 0.0) <= 0.0:
            raise NoTimeError(
                f"timeout must be above 0 and at most {LONGEST_WAIT:g} s, not {timeout!r:.60}"
            )
        self.uri = uri
        self.timeout = timeout
        self._limits = limits
        self._host, self._port, self._path = net.split_uri(uri)
        self._idle: list[socket.socket] = []
        self._lock = threading.Lock()
        self._closed = False

    def call(self, method: str, *params: Any) -> Any:
        """Call a method; returns the value of the answer.

        Raises:
            MarshalError: A parameter cannot be sent, or the answer is not XML-RPC.
            FaultError: The server answered with a fault.
            UnreachableError: There is no answer.
            SilentPeerError: There is none, but there is a server.
        """
        document = write_call(method, params)
        data = request(f"{self._host}:{self._port}", self._path, document)
        while True:
            sock = self._take()
            if sock is None:
                break
            # The server may have closed a connection that was idle; then it saw nothing.
            with contextlib.suppress(OSError):
                sock.sendall(data)
                message = self._receive(sock)
                if message is not None:
                    return self._finish(sock, message)
            sock.close()
        return self._call_again(data)

    def close(self) -> None:
        """Close the idle connections."""
        with self._lock:
            self._closed = True
            idle, self._idle = self._idle, []
        for sock in idle:
            sock.close()

    def _call_again(self, data: bytes) -> Any:
        sock = None
        try:
            sock = net.connect(self._host, self._port, self.timeout)
            net.ignore_delay(sock)
            sock.sendall(data)
            message = self._receive(sock)
            if message is None:
                raise ConnectionResetError("it closed the connection instead of answering")  # noqa: TRY301
        except OSError as error:
            kind: type[UnreachableError] = UnreachableError
            if sock is not None:
                sock.close()
                kind = SilentPeerError if isinstance(error, TimeoutError) else kind
            elif isinstance(error, ConnectionRefusedError):
                kind = RefusedConnectionError
            raise kind(f"{self.uri} does not answer: {error}") from None
        except BaseException:
            if sock is not None:
                sock.close()
            raise
        return self._finish(sock, message)

    def _take(self) -> socket.socket | None:
        """Return an idle connection that is still open."""
        while True:
            with self._lock:
                sock = self._idle.pop() if self._idle else None
            if sock is None or not _readable(sock):
                return sock
            sock.close()  # readable without a question: closed, or out of step

    def _receive(self, sock: socket.socket) -> HttpMessage | None:
        reader = MessageReader(self._limits, response=True)
        while True:
            data = sock.recv(_CHUNK)
            if not data:
                return reader.end()
            reader.feed(data)
            message = reader.next()
            if message is not None:
                return message

    def _finish(self, sock: socket.socket, message: HttpMessage) -> Any:
        keep = False
        if message.keep_alive:
            with self._lock:
                keep = not self._closed and len(self._idle) < _MOST_IDLE
                if keep:
                    self._idle.append(sock)
        if not keep:
            sock.close()
        return value_of_answer(message, self._limits)


def _readable(sock: socket.socket) -> bool:
    if hasattr(select, "poll"):
        poll = select.poll()
        poll.register(sock, select.POLLIN)
        return bool(poll.poll(0))
    return bool(select.select([sock], [], [], 0)[0])
