"""An XML-RPC client that lives on the event loop."""

from __future__ import annotations

import contextlib
import socket
from collections import deque
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros import net
from gazelle_ros.errors import ProtocolError, RosError, UnreachableError
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.loop import READ, WRITE, EventLoop, TimerHandle
from gazelle_ros.xmlrpc.client import value_of_answer
from gazelle_ros.xmlrpc.http import HttpMessage, MessageReader, request
from gazelle_ros.xmlrpc.long_documents import BackgroundTasks, is_long
from gazelle_ros.xmlrpc.writing import write_call

Done = Callable[[Any, RosError | None], None]

_CHUNK = 65536
_MOST_QUEUED = 10_000


class AsyncClient:
    """Calls servers from the loop's thread, in order for each server; keeps connections open.

    Args:
        loop: Its event loop.
        timeout: Seconds to wait for an answer.
        limits: Limits for servers.
        lost: Called with a server's URI when it closes a connection that was idle.
    """

    def __init__(
        self,
        loop: EventLoop,
        timeout: float = 30.0,
        limits: NetworkLimits = LIMITS,
        lost: Callable[[str], None] | None = None,
    ) -> None:
        self.loop = loop
        self.timeout = timeout
        self.limits = limits
        self.lost = lost
        self._peers: dict[str, _Peer] = {}
        self._aside = BackgroundTasks(loop)

    def call(self, uri: str, method: str, params: Sequence[Any], done: Done | None = None) -> None:
        """Call; `done(value, error)` runs on the loop's thread. Only on the loop's thread."""
        try:
            document = None if is_long(params) else write_call(method, params)
            peer = self._peers.get(uri)
            if peer is None:
                peer = self._peers[uri] = _Peer(self, uri)
            call = peer.call(document, done)
            if document is None:
                self._aside.post(lambda: self._write(peer, call, method, params))
        except RosError as error:
            if done is not None:
                failure = error
                self.loop.call_soon(lambda: done(None, failure))

    def _write(self, peer: _Peer, call: _Call, method: str, params: Sequence[Any]) -> None:
        """Write a long document, beside the loop."""
        try:
            call.document = write_call(method, params)
        except RosError as error:
            call.failure = error
        self.loop.call_soon(peer.go_on)

    def forget(self, uri: str) -> None:
        """Close open connections to that server."""
        peer = self._peers.pop(uri, None)
        if peer is not None:
            peer.close()

    def retire(self, peer: _Peer) -> None:
        """Remove an idle peer without a connection."""
        if self._peers.get(peer.uri) is peer:
            del self._peers[peer.uri]

    def close(self) -> None:
        """Close everything. Only on the loop's thread."""
        peers, self._peers = self._peers, {}
        for peer in peers.values():
            peer.close()


class _Call:
    """A call that waits for its turn.

    Attributes:
        document: None while it is being written.
        done: Gets the answer.
        failure: Reason why the document could not be written.
    """

    __slots__ = ("document", "done", "failure")

    def __init__(self, document: bytes | None, done: Done | None) -> None:
        self.document = document
        self.done = done
        self.failure: RosError | None = None


class _Peer:
    """One server: a queue of calls, and the connection they go over one after another."""

    def __init__(self, client: AsyncClient, uri: str) -> None:
        self.uri = uri
        self._client = client
        self._loop = client.loop
        self._host, self._port, self._path = net.split_uri(uri)
        self._queue: deque[_Call] = deque()
        self._sock: socket.socket | None = None
        self._reader = MessageReader(client.limits, response=True)
        self._outgoing = memoryview(b"")
        self._busy = False
        self._fresh = True
        self._deadline: TimerHandle | None = None

    def call(self, document: bytes | None, done: Done | None) -> _Call:
        if len(self._queue) >= _MOST_QUEUED:
            raise UnreachableError(f"{self.uri} leaves {_MOST_QUEUED} calls unanswered")
        call = _Call(document, done)
        self._queue.append(call)
        self.go_on()
        return call

    def go_on(self) -> None:
        """Send the next call, if it may be its turn."""
        if not self._busy:
            self._next()

    def close(self) -> None:
        self._queue.clear()
        self._busy = False
        if self._deadline is not None:
            self._deadline.cancel()
        self._drop()

    def _next(self) -> None:
        first = self._queue[0] if self._queue else None
        self._busy = first is not None and (first.document or first.failure) is not None
        if not self._busy:
            if self._sock is None and first is None:
                self._client.retire(self)
            return
        if first is not None and first.failure is not None:
            self._conclude(None, first.failure)
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
        document = self._queue[0].document or b""
        self._outgoing = memoryview(request(host, self._path, document))
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

    def _finish(self, message: HttpMessage) -> None:
        if not self._busy:
            self._drop()  # an answer without a question
            self._client.retire(self)
            return
        if not message.keep_alive:
            self._drop()
        value, failure = None, None
        try:
            value = value_of_answer(message, self._client.limits)
        except RosError as error:
            failure = error
        self._conclude(value, failure)

    def _break(self, text: str) -> None:
        """Handle a broken connection; a call over an old one is repeated over a new one."""
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
        done = self._queue.popleft().done
        try:
            if done is not None:
                done(value, error)
        finally:
            self._next()

    def _drop(self) -> None:
        if self._sock is not None:
            self._loop.close(self._sock)
            self._sock = None
