"""Services: the side that offers one, and the side that calls it."""

from __future__ import annotations

import contextlib
import socket
import threading
import time
from collections.abc import Callable, Mapping
from io import BytesIO
from typing import Any

from gazelle_ros import net
from gazelle_ros.base.deadlines import deadline_after
from gazelle_ros.errors import (
    ApiError,
    Md5MismatchError,
    NodeClosedError,
    RosTimeoutError,
    ServiceError,
    ServiceFailedError,
    ServiceNotFoundError,
    UnreachableError,
    report,
)
from gazelle_ros.node_base import NodeBase
from gazelle_ros.peer_reports import PEER_REPORTS
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.frames import frame
from gazelle_ros.tcpros.service_links import (
    ServiceChannel,
    ServiceConnection,
    bad_answer,
    good_answer,
)

Handler = Callable[[Any], Any]
_POLL_S = 0.1


class ServiceServer:
    """Service server, as `Node.serve` returns it: a handler answers the calls.

    The handler gets the request and returns a response: an object of the response class, or
    a dict, list or tuple of its fields, or the value of its only field. It may raise; the
    client then gets the text. A `ServiceError` (or a class of `refusals`) is an answer, any
    other exception is reported as well. Calls of different clients may run at the same time.

    Args:
        node: Its node.
        name: The service's resolved name.
        service_class: Its type.
        handler: See above.
        on_close: Called with itself when it is closed.

    Attributes:
        name: The service's resolved name.
        uri: The address clients connect to.
        refusals: Exceptions by which the handler says no.
    """

    def __init__(
        self,
        node: NodeBase,
        name: str,
        service_class: Any,
        handler: Handler,
        on_close: Callable[[ServiceServer], None],
    ) -> None:
        self._on_close = on_close
        self.node = node
        self.name = name
        self.service_class = service_class
        self.handler = handler
        self.refusals: tuple[type[Exception], ...] = (ServiceError,)
        self.on_error: Callable[[Exception], None] | None = None
        self.uri = net.uri_of(node.host, node.tcpros_port, "rosrpc")
        self._connections: set[ServiceConnection] = set()
        self._closed = False

    def close(self) -> None:
        """Close the service."""
        if not self._closed:
            self._closed = True
            self._on_close(self)

    @property
    def closed(self) -> bool:
        """True when the service is offered no longer."""
        return self._closed or self.node.closed

    def check(self, fields: Mapping[str, str]) -> None:
        """Check the header of a client.

        Raises:
            Md5MismatchError: It wants another type.
        """
        mine, theirs = self.service_class._md5sum, fields["md5sum"]
        if theirs not in {headers.ANY, mine}:
            raise Md5MismatchError(
                f"request from [{fields['callerid']}]: md5sums do not match: "
                f"[{theirs}] vs. [{mine}]"
            )

    # Connections; only on the loop's thread -------------------------------------------------------

    def adopt(self, sock: socket.socket, fields: dict[str, str], rest: bytes) -> None:
        """Add the connection of a client.

        Raises:
            Md5MismatchError: It wants another type.
        """
        self.check(fields)
        net.ignore_delay(sock)
        connection = ServiceConnection(
            self.node.loop, sock, fields, self.answer, self.node.limits, self._forget
        )
        self._connections.add(connection)
        reply = {
            "callerid": self.node.name,
            "md5sum": self.service_class._md5sum,
            "service": self.name,
            "type": self.service_class._type,
        }
        connection.start(headers.encode(reply), rest)

    def drop_all(self) -> None:
        """Close all connections."""
        for connection in list(self._connections):
            connection.close()

    def _forget(self, connection: ServiceConnection) -> None:
        self._connections.discard(connection)

    # Calls; on a worker --------------------------------------------------------------------

    def answer(self, data: bytes, fields: dict[str, str]) -> bytes:
        """Return the answer to a request, both in their wire format."""
        try:
            request = self.service_class._request_class()
            try:
                request.deserialize(data)
            except Exception as error:  # noqa: BLE001  # whatever the bytes lead to
                peer = fields.get("callerid", "an unnamed client")
                PEER_REPORTS.complain(f"service {self.name}", peer, error)
                return bad_answer(f"error processing request: {error}")
            if hasattr(type(request), "_connection_header"):
                request._connection_header = fields
            response = self._respond(request)
            buffer = BytesIO()
            response.serialize(buffer)
            return good_answer(buffer.getvalue())
        except self.refusals as error:
            return bad_answer(f"service cannot process request: {_text(error)}")
        except Exception as error:  # noqa: BLE001  # reported to the client
            if self.on_error is None:
                report(f"service {self.name}", error)
            else:
                self.on_error(error)
            return bad_answer(f"error processing request: {error}")

    def _respond(self, request: Any) -> Any:
        result = self.handler(request)
        if result is None:
            raise ServiceError("service handler returned None")
        return as_message(result, self.service_class._response_class)


def _text(error: Exception) -> str:
    return str(error.message) if isinstance(error, ServiceError) else str(error)


def as_message(value: Any, message_class: Any) -> Any:
    """Convert the return value of a handler to a message.

    Raises:
        ServiceError: It does not fit the class.
    """
    if getattr(value, "_type", None) == message_class._type:
        return value
    try:
        if isinstance(value, Mapping):
            return message_class(**value)
        if isinstance(value, (list, tuple)):
            return message_class(*value)
        return message_class(value)
    except (TypeError, AttributeError) as error:
        expected = message_class._type
        raise ServiceError(
            f"handler returned invalid value: {error}; expected a {expected}"
        ) from None


class ServiceClient:
    """Service client, as `Node.client` returns it.

    Args:
        node: Its node.
        name: The service's resolved name.
        service_class: Its type.
        find_near: Finds a service of this process by host, port and name.
        on_close: Called with itself when it is closed.
        persistent: Keep the connection between calls; it is remade when it breaks.
    """

    def __init__(
        self,
        node: NodeBase,
        name: str,
        service_class: Any,
        find_near: Callable[[str, int, str], ServiceServer | None],
        on_close: Callable[[ServiceClient], None] | None = None,
        *,
        persistent: bool,
    ) -> None:
        self._find_near = find_near
        self._on_close = on_close
        self.node = node
        self.name = name
        self.service_class = service_class
        self.persistent = persistent
        self.fields: dict[str, str] = {}
        """More fields for the connection header."""
        self._channel: ServiceChannel | LocalServiceChannel | None = None
        self._lock = threading.RLock()
        self._closed = False

    def call(self, request: Any, timeout: float | None = None) -> Any:
        """Call the service and wait for its response.

        Args:
            request: An object of the request class.
            timeout: Seconds of wall time; None to wait for ever.

        Raises:
            ServiceNotFoundError: It has no provider.
            ServiceFailedError: The server failed; the message is its text.
            ServiceError: The connection broke or was refused.
            RosTimeoutError: No answer in time.
            NodeClosedError: The client is closed.
        """
        if self._closed:
            raise NodeClosedError(f"the client of {self.name} is closed")
        deadline = None if timeout is None else deadline_after(timeout)
        data = frame(request)
        if self.persistent:
            with self._lock:
                body = self._call_persistent(data, deadline)
        else:
            channel = self._connect(deadline)
            try:
                body = channel.call(data, deadline)
            finally:
                channel.close()
        response = self.service_class._response_class()
        response.deserialize(body)
        return response

    def close(self) -> None:
        """Close the connection."""
        self._closed = True
        channel, self._channel = self._channel, None
        if channel is not None:
            channel.close()
        if self._on_close is not None:
            self._on_close(self)

    def _call_persistent(self, data: bytes, deadline: float | None) -> bytes:
        channel = self._channel
        if deadline is not None and not isinstance(channel, ServiceChannel):
            channel = None  # a handler on this thread cannot be left behind
        if channel is not None and channel.is_stale():
            channel.close()
            channel = self._channel = None
        if channel is None:
            channel = self._channel = self._connect(deadline)
        healthy = False
        try:
            body = channel.call(data, deadline)
            healthy = True
        except ServiceError as error:
            healthy = type(error) is not ServiceError
            raise
        finally:
            if not healthy:
                channel.close()
                self._channel = None
        return body

    def _connect(self, deadline: float | None) -> ServiceChannel | LocalServiceChannel:
        host, port = find_service(self.node, self.name)
        fields = {
            "callerid": self.node.name,
            "service": self.name,
            "md5sum": self.service_class._md5sum,
            "type": self.service_class._type,
            **self.fields,
        }
        if self.persistent:
            fields["persistent"] = "1"
        # Who sets a limit of time may have to leave the handler behind, on a thread of its own.
        server = self._find_near(host, port, self.name) if deadline is None else None
        if server is not None:
            return LocalServiceChannel(server, fields)
        return ServiceChannel(host, port, fields, self.node.limits, deadline)


class LocalServiceChannel:
    """A way to a service of this process: the calling thread runs the handler itself.

    Request and response are serialised all the same, so that the two sides share nothing and
    wrong types are found. What the handler does is as if it ran elsewhere: the caller waits.

    Raises:
        ServiceError: The types differ.
    """

    def __init__(self, server: ServiceServer, fields: dict[str, str]) -> None:
        self._server = server
        self._fields = fields
        try:
            server.check(fields)
        except Md5MismatchError as error:
            raise ServiceError(f"unable to connect to service: {error.message}") from None

    def is_stale(self) -> bool:
        """Return True if the service is closed."""
        return self._server.closed

    def call(self, request: bytes, _deadline: float | None) -> bytes:
        """Handle a framed request; returns the body of the response.

        Raises:
            ServiceFailedError: The handler failed.
        """
        answer = self._server.answer(request[4:], self._fields)
        if answer[0] != 1:
            raise ServiceFailedError(answer[5:].decode(errors="replace"))
        return answer[5:]

    def close(self) -> None:
        """Do nothing: there is nothing to close."""


def find_service(node: NodeBase, name: str) -> tuple[str, int]:
    """Return host and port of a service.

    Raises:
        ServiceNotFoundError: It has no provider.
        MasterUnreachableError: The master does not answer.
    """
    try:
        uri = node.master.lookup_service(name)
    except ApiError:
        raise ServiceNotFoundError(f"service [{name}] unavailable") from None
    host, port, _ = net.split_uri(uri, "rosrpc")
    return host, port


def wait_for_service(node: NodeBase, name: str, timeout: float | None) -> None:
    """Wait until the service answers.

    Raises:
        RosTimeoutError: It does not within `timeout` seconds of wall time.
    """
    deadline = None if timeout is None else deadline_after(timeout)
    fields = {"callerid": node.name, "service": name, "md5sum": headers.ANY, "probe": "1"}
    while True:
        with contextlib.suppress(ServiceError, UnreachableError, RosTimeoutError):
            host, port = find_service(node, name)
            limit = time.monotonic() + 2.0 if deadline is None else deadline
            ServiceChannel(host, port, fields, node.limits, limit).close()
            return
        if deadline is not None and time.monotonic() + _POLL_S > deadline:
            raise RosTimeoutError(f"timeout exceeded while waiting for service {name}")
        if node.wait_closed(_POLL_S):
            raise NodeClosedError("the node was closed while it waited for a service")
