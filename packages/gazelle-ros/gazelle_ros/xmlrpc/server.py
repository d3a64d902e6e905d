"""An XML-RPC server on the event loop."""

from __future__ import annotations

import functools
import socket
import time
from collections.abc import Callable
from typing import Any

from gazelle_ros import net
from gazelle_ros.errors import MarshalError
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.loop import READ, WRITE, EventLoop
from gazelle_ros.peer_reports import PEER_REPORTS
from gazelle_ros.xmlrpc.http import HttpError, HttpMessage, MessageReader, response
from gazelle_ros.xmlrpc.long_documents import LONG_BYTES, BackgroundTasks, is_long
from gazelle_ros.xmlrpc.reading import read_call
from gazelle_ros.xmlrpc.writing import write_fault, write_response

Dispatch = Callable[[str, list[Any]], Any]
Step = Callable[[], Any]
"""Does a call whose arguments are checked, and returns the value of the answer."""
Prepare = Callable[[str, list[Any]], Step]
"""Checks the arguments of a call, on any thread."""

_PATHS = frozenset({"/", "/RPC2"})
_BROWSER = frozenset({"origin", "sec-fetch-site"})
"""Headers that browsers put into what web pages send, and no ROS client knows."""
_CHUNK = 65536
_RETRY_ACCEPT = 0.2


class UnknownMethodError(Exception):
    """Error that a dispatcher raises for an unknown method."""

    def __init__(self, method: str) -> None:
        super().__init__(f'method "{method}" is not supported')


class XmlRpcServer:
    """Answers calls; `dispatch(method, params)` runs on the loop's thread and must be quick.

    Long requests are read, and long answers written, on another thread, so that no other waits.

    Args:
        loop: Its event loop.
        host: The name peers use; it decides the interface.
        port: 0 for any free one.
        dispatch: Returns the value of the answer; what it raises becomes a fault.
        limits: Limits for peers.
        prepare: Used instead of `dispatch`, where checking arguments may take long: it does
            that on any thread, and only what it returns runs on the loop's thread.

    Raises:
        OSError: The port is taken.
    """

    def __init__(
        self,
        loop: EventLoop,
        host: str,
        port: int,
        dispatch: Dispatch,
        limits: NetworkLimits = LIMITS,
        prepare: Prepare | None = None,
    ) -> None:
        self._loop = loop
        self._prepare = prepare or functools.partial(functools.partial, dispatch)
        self.aside = BackgroundTasks(loop)
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
        self._loop.close(self._listener)
        for connection in list(self._connections):
            connection.close()

    def _accept(self, _events: int) -> None:
        if not net.accept_all(self._listener, self._adopt):
            self._drop_idle(1)
            self._loop.unwatch(self._listener)
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
        idle.sort(key=lambda connection: connection.last_received)
        for connection in idle[:number]:
            connection.close()
        return min(number, len(idle))

    def forget(self, connection: _Connection) -> None:
        """Remove a closed connection."""
        self._connections.pop(connection, None)

    def prepared(self, body: bytes) -> Step:
        """Prepare the call of a document for the loop's thread; may take long, raises nothing."""
        try:
            return self._prepare_call(*read_call(body, self.limits))
        except Exception as error:  # noqa: BLE001  # a bad call must not end the server
            return functools.partial(_raise, error)

    def _prepare_call(self, method: str, params: list[Any]) -> Step:
        """Return the step of a call, or of several in one."""
        if method != "system.multicall":
            return self._prepare(method, params)
        calls = params[0] if len(params) == 1 and isinstance(params[0], list) else None
        if calls is None:
            raise MarshalError("system.multicall expects one array")
        steps = [self._prepare_one(call) for call in calls]
        return lambda: [_do_one(step) for step in steps]

    def _prepare_one(self, call: Any) -> Step:
        try:
            return self._prepare(*_inner_call(call))
        except Exception as error:  # noqa: BLE001  # each call of several fails for itself
            return functools.partial(_raise, error)


def _raise(error: Exception) -> None:
    raise error


def _do_one(step: Step) -> Any:
    """Run one of several calls, which fails by itself."""
    try:
        return [step()]
    except Exception as error:  # noqa: BLE001  # as above
        return {"faultCode": 1, "faultString": _fault_text(error)}


def _answered(value: Any) -> bytes:
    """Return the document of an answer; raises nothing, and may take long."""
    try:
        return write_response(value)
    except Exception as error:  # noqa: BLE001  # a bad value must not end the server
        return _failed(error)


def _failed(error: Exception, peer: str = "a caller") -> bytes:
    if not isinstance(error, (MarshalError, UnknownMethodError)):
        PEER_REPORTS.complain("an XML-RPC call", peer, error)
    return write_fault(1, _fault_text(error))


def _inner_call(call: Any) -> tuple[str, list[Any]]:
    method, params = call["methodName"], call["params"]
    if method == "system.multicall" or not isinstance(params, list):
        raise MarshalError("not a call that system.multicall takes")
    return str(method), params


def _fault_text(error: Exception) -> str:
    """Return a fault's text, in the form of Python's own XML-RPC server."""
    own = isinstance(error, (MarshalError, UnknownMethodError))
    return f"{Exception if own else type(error)}:{error}"


def _peer_of(sock: socket.socket) -> str:
    """Return the host at the other end."""
    try:
        return str(sock.getpeername()[0])
    except OSError:  # it has gone already
        return "a caller"


class _Connection:
    """One client's connection."""

    def __init__(self, server: XmlRpcServer, loop: EventLoop, sock: socket.socket) -> None:
        self._server = server
        self._loop = loop
        self._sock = sock
        self._peer = _peer_of(sock)
        self._reader = MessageReader(server.limits)
        self._outgoing = bytearray()
        self._closing = False
        self._working = False
        """True if a long document is read or written for it."""
        self._events = READ
        self.last_received = time.monotonic()
        loop.watch(sock, READ, self._ready)

    @property
    def idle(self) -> bool:
        """True if no request and no answer is under way."""
        if self._working:
            return False
        silent = time.monotonic() - self.last_received > self._server.limits.idle_seconds
        return not self._outgoing and (silent or not self._reader)

    def close(self) -> None:
        if self._sock.fileno() >= 0:
            self._loop.close(self._sock)
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
        """Read available data; False if there is nothing more to do."""
        try:
            data = self._sock.recv(_CHUNK)
        except (BlockingIOError, InterruptedError):
            return False
        if not data:
            self.close()
            return False
        self.last_received = time.monotonic()
        if not self._closing:
            self._reader.feed(data)
        return True

    def _serve(self) -> None:
        """Answer every whole request, but none before the client read the last answer."""
        while not (self._closing or self._working or self._outgoing) and self._answer_next():
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
        return self._exchange(message)

    def _exchange(self, message: HttpMessage) -> bool:
        """Answer a request; False if that continues beside the loop."""
        if message.first[0] != "POST":
            self._put(message, b"POST only", 501)
        elif message.headers.keys() & _BROWSER:
            self._put(message, b"Web pages may not call; use rosbridge", 403)
        elif message.first[1] not in _PATHS:
            self._put(message, b"No such page", 404)
        elif len(message.body) > LONG_BYTES:
            self._aside(lambda: self._read_long(message))
        else:
            self._do(message, self._server.prepared(message.body))
        return not self._working

    def _aside(self, task: Callable[[], None]) -> None:
        """Run a slow task beside the loop; nothing more is read until it is done."""
        self._working = True
        self._wait_for(0)
        self._server.aside.post(task)

    def _read_long(self, message: HttpMessage) -> None:
        step = self._server.prepared(message.body)
        message.body = b""
        self._loop.call_soon(lambda: self._do_later(message, step))

    def _do_later(self, message: HttpMessage, step: Step) -> None:
        if self._sock.fileno() >= 0:
            self._working = False
            self._do(message, step)
            self._go_on()

    def _do(self, message: HttpMessage, step: Step) -> None:
        try:
            value = step()
        except Exception as error:  # noqa: BLE001  # a bad call must not end the server
            self._put(message, _failed(error, self._peer))
            return
        if is_long(value):
            self._aside(lambda: self._write_long(message, value))
        else:
            self._put(message, _answered(value))

    def _write_long(self, message: HttpMessage, value: Any) -> None:
        body = _answered(value)
        self._loop.call_soon(lambda: self._put_later(message, body))

    def _put_later(self, message: HttpMessage, body: bytes) -> None:
        if self._sock.fileno() >= 0:
            self._working = False
            self._put(message, body)
            self._go_on()

    def _go_on(self) -> None:
        """Send what there is, and answer what came meanwhile."""
        if self._working:
            return
        try:
            self._flush()
            self._serve()
        except OSError:
            self.close()

    def _put(self, message: HttpMessage, body: bytes, status: int = 200) -> None:
        self._closing = not message.keep_alive
        kind = "text/xml" if status == 200 else "text/plain"
        self._outgoing += response(status, body, keep_alive=message.keep_alive, kind=kind)

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
