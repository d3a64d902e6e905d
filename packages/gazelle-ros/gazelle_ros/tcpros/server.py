"""The TCPROS port of a node: takes connections, reads their headers, hands them on."""

from __future__ import annotations

import contextlib
import socket
from collections.abc import Callable

from gazelle_ros import net
from gazelle_ros.errors import ProtocolError, RosError
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.loop import READ, EventLoop
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.frames import LENGTH

_RETRY_ACCEPT = 0.2

Route = Callable[[socket.socket, net.Address, dict[str, str], bytes], None]
"""Takes over a socket, its peer's address and header, and what came after the header.

Raises RosError to refuse; the peer gets the text."""


class TcprosServer:
    """Accepts connections for the topics and services of one node."""

    def __init__(
        self, loop: EventLoop, host: str, route: Route, limits: NetworkLimits = LIMITS
    ) -> None:
        self._loop = loop
        self._route = route
        self.limits = limits
        self.host = host
        self._listener = net.listen(host)
        self.port: int = self._listener.getsockname()[1]
        self._greeting: dict[_Greeting, None] = {}
        self._closed = False
        loop.run(lambda: loop.watch(self._listener, READ, self._accept))

    def close(self) -> None:
        """Stop listening. Only on the loop's thread."""
        if self._closed:
            return
        self._closed = True
        self._loop.close(self._listener)
        for greeting in list(self._greeting):
            greeting.close()

    def _accept(self, _events: int) -> None:
        if not net.accept_all(self._listener, self._adopt):
            self._loop.unwatch(self._listener)
            self._loop.call_later(_RETRY_ACCEPT, self._listen_again)

    def _listen_again(self) -> None:
        if not self._closed:
            self._loop.watch(self._listener, READ, self._accept)

    def _adopt(self, sock: socket.socket, address: net.Address) -> None:
        if len(self._greeting) >= self.limits.connections:
            sock.close()
            return
        net.keep_alive(sock)
        self._greeting[_Greeting(self, self._loop, sock, address)] = None

    def forget(self, greeting: _Greeting) -> None:
        """Remove a connection that is past its header, or closed."""
        self._greeting.pop(greeting, None)

    def dispatch(self, greeting: _Greeting, body: bytes, rest: bytes) -> None:
        """Pass a connection to the target of its header."""
        try:
            self._route(greeting.sock, greeting.address, headers.decode(body), rest)
        except RosError as error:
            refuse(greeting.sock, error.message)
            self._loop.close(greeting.sock)


class _Greeting:
    """A connection with an incomplete header."""

    def __init__(
        self, server: TcprosServer, loop: EventLoop, sock: socket.socket, address: net.Address
    ) -> None:
        self.sock = sock
        self.address = address
        self._server = server
        self._loop = loop
        self._data = bytearray()
        self._timer = loop.call_later(server.limits.handshake_seconds, self.close)
        loop.watch(sock, READ, self._ready)

    def close(self) -> None:
        """Drop the connection."""
        self._leave()
        self._loop.close(self.sock)

    def _leave(self) -> None:
        self._timer.cancel()
        self._loop.unwatch(self.sock)
        self._server.forget(self)

    def _ready(self, _events: int) -> None:
        try:
            data = self.sock.recv(65536)
        except (BlockingIOError, InterruptedError):
            return
        except OSError:
            data = b""
        if not data:
            self.close()
            return
        self._data += data
        if len(self._data) < 4:
            return
        length: int = LENGTH.unpack_from(self._data)[0]
        if length > self._server.limits.header_bytes:
            refuse(self.sock, "the connection header is too long")
            self.close()
            return
        if len(self._data) >= 4 + length:
            self._leave()
            body = bytes(self._data[4 : 4 + length])
            self._server.dispatch(self, body, bytes(self._data[4 + length :]))


def refuse(sock: socket.socket, text: str) -> None:
    """Send the peer the reason for the disconnection."""
    with contextlib.suppress(OSError, ProtocolError):
        sock.send(headers.encode({"error": text}))
