"""A subscriber's side of one connection: find the publisher, connect, read, and come back."""

from __future__ import annotations

import contextlib
import socket
from typing import Any, Protocol

from gazelle_ros import net
from gazelle_ros.errors import Md5MismatchError, ProtocolError, RosError, report
from gazelle_ros.limits import NetworkLimits
from gazelle_ros.loop import READ, WRITE, EventLoop, TimerHandle
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.dedicated import DedicatedReader
from gazelle_ros.tcpros.frames import FrameReader
from gazelle_ros.xmlrpc.async_client import AsyncClient

_FIRST_RETRY_S = 0.1
_LAST_RETRY_S = 8.0


class Receiver(Protocol):
    """Interface of a subscription that an inbound link needs."""

    topic: str
    limits: NetworkLimits

    def request_header(self) -> dict[str, str]:
        """Return the header to send to a publisher."""

    def check_header(self, header: dict[str, str]) -> None:
        """Raise RosError if the publisher's header does not fit."""

    def receive(self, link: InboundLink, frames: list[bytes], *, now: bool) -> bool:
        """Receive whole messages; may pause the link.

        Args:
            link: Connection of the messages.
            frames: The messages.
            now: Handle them on this thread if possible, which need not be back soon.

        Returns:
            Whether the handlers keep up.
        """

    def connected(self, link: InboundLink) -> None:
        """Handle a connected link."""

    def disconnected(self, link: InboundLink) -> None:
        """Handle a disconnected link."""


class InboundLink:
    """The connection to one publisher, kept up until it is closed. Only on the loop's thread.

    Args:
        loop: Its event loop.
        calls: For the question which port the publisher listens on.
        receiver: Gets the messages.
        caller: Name of the subscribing node.
        uri: Of the publishing node.
    """

    is_local = False

    def __init__(
        self, loop: EventLoop, calls: AsyncClient, receiver: Receiver, caller: str, uri: str
    ) -> None:
        self.uri = uri
        self.header: dict[str, str] = {}
        self.peer = ""
        self.endpoint: tuple[str, int] = ("", 0)
        self.port = 0
        self.descriptor = 0
        self.closed = False
        self.up = False
        self.latching = False
        self.messages = 0
        self.latched: Any = None
        """The last message, if the topic is latched."""
        self.bytes = 0
        self.handled = 0
        """Bytes of the messages that the callbacks are done with, or busy with."""
        self.lost = 0
        """Bytes of the messages that were dropped."""
        self.dropped = 0
        self.number = 0
        """Identity in bus info."""
        self._loop = loop
        self._calls = calls
        self._receiver = receiver
        self._caller = caller
        self._sock: socket.socket | None = None
        self._reader = FrameReader(receiver.limits.header_bytes)
        self._outgoing = b""
        self._retry_s = _FIRST_RETRY_S
        self._timer: TimerHandle | None = None
        self.paused = False
        self._complained = ""
        self._dedicated = DedicatedReader(loop, self._read_next, self._return_socket)

    def open(self) -> None:
        """Open the link: request the publisher's address."""
        if self.closed:
            return
        protocols = [["TCPROS"]]
        params = (self._caller, self._receiver.topic, protocols)
        self._calls.call(self.uri, "requestTopic", params, self._answered)

    def close(self) -> None:
        """Close it for good."""
        self.closed = True
        if self._timer is not None:
            self._timer.cancel()
        self._drop()

    def pause(self) -> None:
        """Read no more for now; the publisher will notice when the buffers are full."""
        if not self.paused and self._sock is not None:
            self.paused = True
            if not self._dedicated.active:
                self._loop.unwatch(self._sock)

    def resume(self) -> None:
        """Read again."""
        if self.paused and self._sock is not None:
            self.paused = False
            if not self._dedicated.active:
                self._loop.watch(self._sock, READ, self._ready)

    def _answered(self, value: Any, error: RosError | None) -> None:
        if self.closed or self._sock is not None:
            return
        if error is not None:
            self._try_again(error)
            return
        try:
            self.endpoint = self._read_answer(value)
        except (TypeError, ValueError, OverflowError):
            self._try_again(ProtocolError(f"requestTopic of {self.uri} answered {value!r}"))
        except ProtocolError as refusal:
            self._try_again(refusal)
        else:
            self._find()

    def _read_answer(self, value: Any) -> tuple[str, int]:
        """Return host and port from the answer to requestTopic."""
        code, text, choice = value
        if code != 1:
            raise ProtocolError(f"{self.uri} refuses {self._receiver.topic}: {text}")
        protocol, host, port = choice
        if protocol != "TCPROS" or not 0 < int(port) < 65536:
            raise ProtocolError(f"{self.uri} offers {choice!r}")
        return str(host), int(port)

    def _find(self) -> None:
        host = self.endpoint[0]
        address = net.known_address(host)
        if address is not None:
            self._connect(address)
            return

        def look_up() -> None:
            try:
                found = net.find_address(host)
            except OSError as error:
                failure = ProtocolError(f"{self.uri} names a host that is not known: {error}")
                self._loop.call_soon(lambda: self._try_again(failure))
            else:
                self._loop.call_soon(lambda: self._connect(found))

        self._loop.submit(look_up)

    def _connect(self, address: str) -> None:
        if self.closed or self._sock is not None:
            return
        try:
            sock = net.start_connect(address, self.endpoint[1])
        except OSError as error:
            self._try_again(ProtocolError(f"cannot connect to {self.endpoint}: {error}"))
            return
        net.keep_alive(sock)
        self._sock = sock
        # A worker may still be busy with a message of the connection before.
        self._dedicated = DedicatedReader(self._loop, self._read_next, self._return_socket)
        self.paused = False
        self._reader = FrameReader(self._receiver.limits.header_bytes)
        self._outgoing = headers.encode(self._receiver.request_header())
        self._timer = self._loop.call_later(self._receiver.limits.handshake_seconds, self._expire)
        self._loop.watch(sock, READ | WRITE, self._ready)

    def _ready(self, events: int) -> None:
        sock = self._sock
        if sock is None:
            return
        try:
            if events & WRITE and self._outgoing:
                self._write_header(sock)
            if events & READ:
                frames = self._reader.read(sock)
                if frames and not self.up:
                    frames = self._greet(frames)
                if frames:
                    self.messages += len(frames)
                    keeps_up = self._receiver.receive(self, frames, now=False)
                    if self._dedicated.is_wanted() and keeps_up and not self.paused:
                        self._dedicated.begin(sock)
        except OSError as error:
            self._try_again(ProtocolError(f"the connection to {self.uri} broke: {error}"))
        except RosError as error:
            self._try_again(error)

    def _read_next(self) -> bool:
        """Wait for messages and handle them; runs on a worker while there are many."""
        sock, reader = self._sock, self._reader
        if sock is None:
            return False
        before = reader.received
        frames = reader.read(sock)
        if not frames:
            return reader.received > before
        self.messages += len(frames)
        return self._receiver.receive(self, frames, now=True) and not self.paused

    def _return_socket(self, sock: socket.socket, error: RosError | None) -> None:
        """Return the socket to the event loop."""
        if sock is not self._sock:  # the link has left it
            self._loop.close(sock)
        elif error is not None:
            self._try_again(error)
        elif not self.paused:
            self._loop.watch(sock, READ, self._ready)

    def _write_header(self, sock: socket.socket) -> None:
        with contextlib.suppress(BlockingIOError):
            sent = sock.send(self._outgoing)
            self._outgoing = self._outgoing[sent:]
        if not self._outgoing:
            self._loop.watch(sock, READ, self._ready)

    def _greet(self, frames: list[bytes]) -> list[bytes]:
        """Check the first frame, the publisher's header."""
        header = headers.decode(frames[0])
        self._receiver.check_header(header)
        self.header = header
        self.latching = headers.flag(header, "latching")
        self.peer = header.get("callerid", self.uri)
        self.up = True
        if self._sock is not None:
            self.port = self._sock.getsockname()[1]
            self.descriptor = self._sock.fileno()
        self._reader.limit = self._receiver.limits.message_bytes
        self._retry_s = _FIRST_RETRY_S
        self._complained = ""
        if self._timer is not None:
            self._timer.cancel()
        self._receiver.connected(self)
        # What was cut under the header's limit is complete, so within the message's too.
        return frames[1:]

    def _expire(self) -> None:
        self._try_again(ProtocolError(f"{self.uri} does not answer the connection header"))

    def _try_again(self, error: RosError) -> None:
        """Close this connection, and try another one later."""
        if self.closed:
            return
        self._drop()
        if isinstance(error, Md5MismatchError) and error.message != self._complained:
            self._complained = error.message
            report(f"subscriber of {self._receiver.topic}", error)
        if self._timer is not None:
            self._timer.cancel()
        self._timer = self._loop.call_later(self._retry_s, self.open)
        self._retry_s = min(_LAST_RETRY_S, self._retry_s * 2)

    def _drop(self) -> None:
        sock, self._sock = self._sock, None
        if sock is not None and self._dedicated.active:
            self._dedicated.stop()
            with contextlib.suppress(OSError):  # the peer was faster
                sock.shutdown(socket.SHUT_RDWR)
        elif sock is not None:
            self._loop.close(sock)
        self.latched = None
        if self.up:
            self.up = False
            self._receiver.disconnected(self)
