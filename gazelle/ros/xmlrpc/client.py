"""XML-RPC clients: one that waits for the answer, one that lives on the event loop."""

from __future__ import annotations

import contextlib
import select
import socket
import threading
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from gazelle.ros import net
from gazelle.ros.errors import (
    ProtocolError,
    RefusedConnectionError,
    RosError,
    SilentPeerError,
    UnreachableError,
)
from gazelle.ros.limits import LIMITS, Limits
from gazelle.ros.loop import READ, WRITE, EventLoop, Timer, give_way
from gazelle.ros.xmlrpc.http import Message, MessageReader, request
from gazelle.ros.xmlrpc.reading import read_response
from gazelle.ros.xmlrpc.writing import write_call

Done = Callable[[Any, RosError | None], None]

_CHUNK = 65536
_MOST_IDLE = 4
_MOST_QUEUED = 10_000


def _value(message: Message, limits: Limits) -> Any:
    status = message.first[1]
    if status != "200":
        raise ProtocolError(f"HTTP status {status}")
    return read_response(message.body, limits)


class BlockingClient:
    """Calls a server and waits; usable from many threads; keeps connections open.

    Args:
        uri: Of the server.
        timeout: Seconds to wait for an answer.
    """

    def __init__(self, uri: str, timeout: float = 30.0, limits: Limits = LIMITS) -> None:
        self.uri = uri
        self.timeout = timeout
        self._limits = limits
        self._host, self._port, self._path = net.split_uri(uri)
        self._idle: list[socket.socket] = []
        self._lock = threading.Lock()
        self._closed = False

    def call(self, method: str, *params: Any) -> Any:
        """The value of the answer.

        Raises:
            MarshalError: A parameter cannot be sent, or the answer is no XML-RPC.
            FaultError: The server answered with a fault.
            UnreachableError: There is no answer.
            SilentPeerError: There is none, but somebody listens.
        """
        document = write_call(method, params)
        data = request(f"{self._host}:{self._port}", self._path, document)
        give_way()
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
        return self._call_anew(data)

    def close(self) -> None:
        """Close the idle connections."""
        with self._lock:
            self._closed = True
            idle, self._idle = self._idle, []
        for sock in idle:
            sock.close()

    def _call_anew(self, data: bytes) -> Any:
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
        """An idle connection that is still open."""
        while True:
            with self._lock:
                sock = self._idle.pop() if self._idle else None
            if sock is None or not _readable(sock):
                return sock
            sock.close()  # readable without a question: closed, or out of step

    def _receive(self, sock: socket.socket) -> Message | None:
        reader = MessageReader(self._limits, response=True)
        while True:
            data = sock.recv(_CHUNK)
            if not data:
                return reader.end()
            reader.feed(data)
            message = reader.next()
            if message is not None:
                return message

    def _finish(self, sock: socket.socket, message: Message) -> Any:
        keep = False
        if message.keep_alive:
            with self._lock:
                keep = not self._closed and len(self._idle) < _MOST_IDLE
                if keep:
                    self._idle.append(sock)
        if not keep:
            sock.close()
        return _value(message, self._limits)


def _readable(sock: socket.socket) -> bool:
    if hasattr(select, "poll"):
        poll = select.poll()
        poll.register(sock, select.POLLIN)
        return bool(poll.poll(0))
    return bool(select.select([sock], [], [], 0)[0])


class AsyncClient:
    """Calls servers from the leader, in order for each server; keeps connections open.

    Args:
        loop: Where it lives.
        timeout: Seconds to wait for an answer.
        limits: What servers may demand.
        lost: Called with a server's URI when it closes a connection that was idle.
    """

    def __init__(
        self,
        loop: EventLoop,
        timeout: float = 30.0,
        limits: Limits = LIMITS,
        lost: Callable[[str], None] | None = None,
    ) -> None:
        self.loop = loop
        self.timeout = timeout
        self.limits = limits
        self.lost = lost
        self._peers: dict[str, _Peer] = {}

    def call(self, uri: str, method: str, params: Sequence[Any], done: Done | None = None) -> None:
        """Call; `done(value, error)` runs on the leader. Only for the leader."""
        try:
            document = write_call(method, params)
            peer = self._peers.get(uri)
            if peer is None:
                peer = self._peers[uri] = _Peer(self, uri)
            peer.call(document, done)
        except RosError as error:
            if done is not None:
                failure = error
                self.loop.call_soon(lambda: done(None, failure))

    def forget(self, uri: str) -> None:
        """Close what is open to that server."""
        peer = self._peers.pop(uri, None)
        if peer is not None:
            peer.close()

    def retire(self, peer: _Peer) -> None:
        """A peer has nothing to do and no connection."""
        if self._peers.get(peer.uri) is peer:
            del self._peers[peer.uri]

    def close(self) -> None:
        """Close everything. Only for the leader."""
        peers, self._peers = self._peers, {}
        for peer in peers.values():
            peer.close()


class _Peer:
    """One server: a queue of calls, and the connection they go over one after another."""

    def __init__(self, client: AsyncClient, uri: str) -> None:
        self.uri = uri
        self._client = client
        self._loop = client.loop
        self._host, self._port, self._path = net.split_uri(uri)
        self._queue: deque[tuple[bytes, Done | None]] = deque()
        self._sock: socket.socket | None = None
        self._reader = MessageReader(client.limits, response=True)
        self._outgoing = memoryview(b"")
        self._busy = False
        self._fresh = True
        self._deadline: Timer | None = None

    def call(self, document: bytes, done: Done | None) -> None:
        if len(self._queue) >= _MOST_QUEUED:
            raise UnreachableError(f"{self.uri} leaves {_MOST_QUEUED} calls unanswered")
        self._queue.append((document, done))
        if not self._busy:
            self._next()

    def close(self) -> None:
        self._queue.clear()
        self._busy = False
        if self._deadline is not None:
            self._deadline.cancel()
        self._drop()

    def _next(self) -> None:
        self._busy = bool(self._queue)
        if not self._busy:
            if self._sock is None:
                self._client.retire(self)
            return
        self._deadline = self._loop.call_later(self._client.timeout, self._expire)
        if self._sock is None:
            self._fresh = True
            self._find()
        else:
            self._fresh = False
            self._send()

    def _find(self) -> None:
        address = net.known_address(self._host)
        if address is not None:
            self._connect(address)
            return

        def look_up() -> None:
            try:
                found = net.find_address(self._host)
            except OSError as error:
                text = f"{self.uri} does not answer: {error}"
                self._loop.call_soon(lambda: self._fail(UnreachableError(text)))
            else:
                self._loop.call_soon(lambda: self._connect(found))

        self._loop.submit(look_up)

    def _connect(self, address: str) -> None:
        if not self._busy or self._sock is not None:
            return
        try:
            self._sock = net.start_connect(address, self._port)
        except OSError as error:
            self._fail(UnreachableError(f"{self.uri} does not answer: {error}"))
            return
        net.ignore_delay(self._sock)
        self._reader = MessageReader(self._client.limits, response=True)
        self._send()

    def _send(self) -> None:
        host = f"{self._host}:{self._port}"
        self._outgoing = memoryview(request(host, self._path, self._queue[0][0]))
        if self._sock is not None:
            self._loop.watch(self._sock, READ | WRITE, self._ready)

    def _ready(self, events: int) -> None:
        try:
            if events & WRITE:
                self._write()
            if events & READ and self._sock is not None:
                self._read()
        except OSError as error:
            self._break(f"{self.uri} does not answer: {error}")

    def _write(self) -> None:
        if self._sock is None:
            return
        error = self._sock.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
        if error:
            raise OSError(error, "connection failed")
        with contextlib.suppress(BlockingIOError):
            sent = self._sock.send(self._outgoing)
            self._outgoing = self._outgoing[sent:]
        if not self._outgoing:
            self._loop.watch(self._sock, READ, self._ready)

    def _read(self) -> None:
        if self._sock is None:
            return
        try:
            data = self._sock.recv(_CHUNK)
        except BlockingIOError:
            return
        try:
            if data:
                self._reader.feed(data)
                message = self._reader.next()
            else:
                message = self._reader.end()
                if message is None:
                    self._break(f"{self.uri} closed the connection instead of answering")
                    return
        except ProtocolError as error:
            self._fail(error)
            return
        if message is not None:
            self._finish(message)

    def _finish(self, message: Message) -> None:
        if not self._busy:
            self._drop()  # an answer without a question
            self._client.retire(self)
            return
        if not message.keep_alive:
            self._drop()
        value, failure = None, None
        try:
            value = _value(message, self._client.limits)
        except RosError as error:
            failure = error
        self._conclude(value, failure)

    def _break(self, text: str) -> None:
        """The connection is gone; a call over an old one is tried again over a new one."""
        stale = self._busy and not self._fresh and not self._reader
        self._drop()
        if not self._busy:
            self._client.retire(self)
            if self._client.lost is not None:
                self._client.lost(self.uri)
        elif stale:
            self._fresh = True
            self._find()
        else:
            self._fail(UnreachableError(text))

    def _expire(self) -> None:
        self._fail(UnreachableError(f"{self.uri} does not answer in time"))

    def _fail(self, error: RosError) -> None:
        if self._busy:
            self._drop()
            self._conclude(None, error)

    def _conclude(self, value: Any, error: RosError | None) -> None:
        if self._deadline is not None:
            self._deadline.cancel()
        done = self._queue.popleft()[1]
        try:
            if done is not None:
                done(value, error)
        finally:
            self._next()

    def _drop(self) -> None:
        if self._sock is not None:
            self._loop.watch(self._sock, 0, self._ready)
            self._sock.close()
            self._sock = None
