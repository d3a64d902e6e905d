"""An XML-RPC server on the event loop."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable
from typing import Any

from gazelle.ros import net
from gazelle.ros.errors import MarshalError, report
from gazelle.ros.limits import LIMITS, Limits
from gazelle.ros.loop import READ, WRITE, EventLoop
from gazelle.ros.xmlrpc.http import HttpError, Message, MessageReader, response
from gazelle.ros.xmlrpc.reading import read_call
from gazelle.ros.xmlrpc.writing import write_fault, write_response

Dispatch = Callable[[str, list[Any]], Any]

_PATHS = frozenset({"/", "/RPC2"})
_CHUNK = 65536
_RETRY_ACCEPT = 0.2


class UnknownMethodError(Exception):
    """What a dispatcher raises for a method it does not have."""

    def __init__(self, method: str) -> None:
        super().__init__(f'method "{method}" is not supported')


class XmlRpcServer:
    """Answers calls; `dispatch(method, params)` runs on the leader and must be quick.

    Args:
        loop: Where it lives.
        host: The name peers use; it decides the interface.
        port: 0 for any free one.
        dispatch: Returns the value of the answer; what it raises becomes a fault.
        limits: What peers may demand.

    Raises:
        OSError: The port is taken.
    """

    def __init__(
        self,
        loop: EventLoop,
        host: str,
        port: int,
        dispatch: Dispatch,
        limits: Limits = LIMITS,
    ) -> None:
        self._loop = loop
        self._dispatch = dispatch
        self.limits = limits
        self._connections: dict[_Connection, None] = {}
        self._listener = net.listen(host, port)
        self.port: int = self._listener.getsockname()[1]
        self.uri = net.uri_of(host, self.port)
        self._closed = False
        loop.run(lambda: loop.watch(self._listener, READ, self._accept))

    def close(self) -> None:
        """Stop listening and drop all connections."""
        if not self._closed:
            self._closed = True
            self._loop.run(self._close)

    def _close(self) -> None:
        self._loop.watch(self._listener, 0, self._accept)
        self._listener.close()
        for connection in list(self._connections):
            connection.close()

    def _accept(self, _events: int) -> None:
        if not net.accept_all(self._listener, self._adopt):
            self._drop_idle(1)
            self._loop.watch(self._listener, 0, self._accept)
            self._loop.call_later(_RETRY_ACCEPT, self._listen_again)

    def _listen_again(self) -> None:
        if not self._closed:
            self._loop.watch(self._listener, READ, self._accept)

    def _adopt(self, sock: socket.socket, _address: net.Address) -> None:
        if len(self._connections) >= self.limits.connections and not self._drop_idle(1):
            sock.close()
            return
        net.ignore_delay(sock)
        net.keep_alive(sock)
        self._connections[_Connection(self, self._loop, sock)] = None

    def _drop_idle(self, number: int) -> int:
        """Close the connections that were silent longest."""
        idle = [connection for connection in self._connections if connection.idle]
        idle.sort(key=lambda connection: connection.last_heard)
        for connection in idle[:number]:
            connection.close()
        return min(number, len(idle))

    def forget(self, connection: _Connection) -> None:
        """A connection closed."""
        self._connections.pop(connection, None)

    def answer(self, message: Message) -> tuple[int, bytes]:
        """Status and body that answer a request."""
        if message.first[0] != "POST":
            return 501, b"POST only"
        if message.first[1] not in _PATHS:
            return 404, b"No such page"
        return 200, self._answer_call(message.body)

    def _answer_call(self, body: bytes) -> bytes:
        try:
            method, params = read_call(body, self.limits)
            return write_response(self.call(method, params))
        except Exception as error:  # noqa: BLE001  # a bad call must not end the server
            if not isinstance(error, (MarshalError, UnknownMethodError)):
                report("an XML-RPC call", error)
            return write_fault(1, _fault_text(error))

    def call(self, method: str, params: list[Any]) -> Any:
        """Do a call, or several in one."""
        if method != "system.multicall":
            return self._dispatch(method, params)
        calls = params[0] if len(params) == 1 and isinstance(params[0], list) else None
        if calls is None:
            raise MarshalError("system.multicall expects one array")
        return [self._call_one(call) for call in calls]

    def _call_one(self, call: Any) -> Any:
        try:
            return [self._dispatch(*_inner_call(call))]
        except Exception as error:  # noqa: BLE001  # each call of several fails for itself
            return {"faultCode": 1, "faultString": _fault_text(error)}


def _inner_call(call: Any) -> tuple[str, list[Any]]:
    method, params = call["methodName"], call["params"]
    if method == "system.multicall" or not isinstance(params, list):
        raise MarshalError("not a call that system.multicall takes")
    return str(method), params


def _fault_text(error: Exception) -> str:
    """A fault's text, in the form Python's own XML-RPC server has."""
    own = isinstance(error, (MarshalError, UnknownMethodError))
    return f"{Exception if own else type(error)}:{error}"


class _Connection:
    """One client's connection."""

    def __init__(self, server: XmlRpcServer, loop: EventLoop, sock: socket.socket) -> None:
        self._server = server
        self._loop = loop
        self._sock = sock
        self._reader = MessageReader(server.limits)
        self._outgoing = bytearray()
        self._closing = False
        self._events = READ
        self.last_heard = time.monotonic()
        loop.watch(sock, READ, self._ready)

    @property
    def idle(self) -> bool:
        """True if no request and no answer is under way."""
        silent = time.monotonic() - self.last_heard > self._server.limits.idle_seconds
        return not self._outgoing and (silent or not self._reader)

    def close(self) -> None:
        if self._sock.fileno() >= 0:
            self._loop.watch(self._sock, 0, self._ready)
            self._sock.close()
            self._server.forget(self)

    def _ready(self, events: int) -> None:
        try:
            if events & READ and not self._read():
                return
            if self._outgoing:
                self._flush()
            self._serve()
        except OSError:
            self.close()

    def _read(self) -> bool:
        """Take in what there is; False if there is nothing more to do."""
        try:
            data = self._sock.recv(_CHUNK)
        except (BlockingIOError, InterruptedError):
            return False
        if not data:
            self.close()
            return False
        self.last_heard = time.monotonic()
        if not self._closing:
            self._reader.feed(data)
        return True

    def _serve(self) -> None:
        """Answer every whole request, but none before the client took the last answer."""
        while not self._closing and not self._outgoing and self._answer_next():
            self._flush()

    def _answer_next(self) -> bool:
        try:
            message = self._reader.next()
        except HttpError as error:
            self._closing = True
            text = error.message.encode()
            self._outgoing += response(error.status, text, keep_alive=False, kind="text/plain")
            return True
        if message is None:
            if self._reader.expects_continue:
                self._reader.expects_continue = False
                self._outgoing += b"HTTP/1.1 100 Continue\r\n\r\n"
                return True
            return False
        status, body = self._server.answer(message)
        self._closing = not message.keep_alive
        kind = "text/xml" if status == 200 else "text/plain"
        self._outgoing += response(status, body, keep_alive=message.keep_alive, kind=kind)
        return True

    def _flush(self) -> None:
        try:
            while self._outgoing:
                sent = self._sock.send(self._outgoing)
                del self._outgoing[:sent]
        except (BlockingIOError, InterruptedError):
            self._wait_for(WRITE)  # nothing more is read until the client reads
            return
        if self._closing:
            self.close()
        else:
            self._wait_for(READ)

    def _wait_for(self, events: int) -> None:
        if events != self._events:
            self._events = events
            self._loop.watch(self._sock, events, self._ready)
