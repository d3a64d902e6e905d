"""The services of one client: those it calls and those it offers."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from gazelle_ros.base.errors import RosError
from gazelle_ros.errors import ServiceError
from gazelle_ros.messages import load_service
from gazelle_ros.node import Node
from gazelle_ros.rosbridge.values import fill_message, json_values
from gazelle_ros.services import ServiceServer
from gazelle_ros.time import Time
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.services import service_type

MOST_CALLS = 100
"""Calls of one client that may wait for their answers at a time."""

Send = Callable[[dict[str, Any]], None]


def call_service(node: Node, service: str, arguments: Any, timeout: float | None) -> dict[str, Any]:
    """Call a service with JSON values; waits for the answer.

    Args:
        node: Calls.
        service: Its name.
        arguments: An object with the request's fields, or a list of them in their order.
        timeout: Seconds of wall time; None to wait for ever.

    Raises:
        RosError: There is no such service, the values do not fit, or it failed.
    """
    with GraphInspector(node.name.lstrip("/"), node.master_uri, "/") as graph:
        kind: Any = load_service(service_type(graph, node.resolve(service)))
    request = kind._request_class()
    now = Time(nsecs=node.clock.now())
    fill_message(request, _named(arguments, request), now)
    client = node.client(service, kind)
    try:
        return json_values(client.call(request, timeout))
    finally:
        client.close()


def _named(arguments: Any, request: Any) -> Any:
    """Return a request's values by name; a list has them in order."""
    if arguments is None:
        return {}
    if not isinstance(arguments, list):
        return arguments
    names = [name for name in request.__slots__ if name != "_connection_header"]
    if len(arguments) > len(names):
        raise RosError(f"{request._type} has {len(names)} fields, but got {len(arguments)} values")
    return dict(zip(names, arguments, strict=False))


@dataclass(slots=True)
class PendingRequest:
    """A request that a client has to answer."""

    done: threading.Event = field(default_factory=threading.Event)
    response: Any = None
    error: str = ""

    def finish(self, response: Any = None, error: str = "") -> None:
        """Finish the request with its answer."""
        self.response, self.error = response, error
        self.done.set()


class OfferedService:
    """A service that a client answers.

    Args:
        node: Serves.
        name: Of the service.
        kind: Its type.
        send: Sends something to the client.
    """

    _numbers = itertools.count(1)

    def __init__(self, node: Node, name: str, kind: str, send: Send) -> None:
        self._class: Any = load_service(kind)
        self._node, self._name, self._send = node, name, send
        self._lock = threading.Lock()
        self._pending: dict[str, PendingRequest] = {}
        self._closed = ""
        self._server: ServiceServer = node.serve(name, self._class, self._answer)

    def respond(self, identifier: Any, values: Any, *, result: bool) -> None:
        """Set the client's answer to a request.

        Raises:
            RosError: There is no such request, or the values are no answer; the caller gets an
                error then.
        """
        with self._lock:
            pending = self._pending.pop(identifier, None)
        if pending is None:
            raise RosError(f"{self._name} has no request with the id {identifier!r}")
        if not result:
            pending.finish(error=str(values) if values else "the service failed")
            return
        response = self._class._response_class()
        try:
            fill_message(response, values or {}, Time(nsecs=self._node.clock.now()))
        except RosError as error:
            pending.finish(error=f"the answer does not fit {self._class._type}: {error.message}")
            raise
        pending.finish(response)

    def close(self, why: str) -> None:
        """Close the service; waiting callers get an error."""
        with self._lock:
            self._closed = why
            waiting = list(self._pending.values())
            self._pending.clear()
        for pending in waiting:
            pending.finish(error=why)
        self._server.close()

    def _answer(self, request: Any) -> Any:
        """Call the client, and wait for its answer; on a worker thread."""
        identifier = f"service_request:{self._name}:{next(self._numbers)}"
        pending = PendingRequest()
        with self._lock:
            if self._closed:
                raise ServiceError(self._closed)
            self._pending[identifier] = pending
        self._send({
            "op": "call_service",
            "id": identifier,
            "service": self._name,
            "args": json_values(request),
        })  # fmt: skip
        pending.done.wait()
        if pending.error:
            raise ServiceError(pending.error)
        return pending.response


class ServicePool:
    """The services that clients of a server offer; one of each name.

    Args:
        node: The server's.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._lock = threading.Lock()
        self._offered: dict[str, tuple[object, OfferedService]] = {}

    def offer(self, owner: object, name: str, kind: str, send: Send) -> bool:
        """Register a client's service; returns whether the name was registered before.

        Raises:
            RosError: There is no such type.
        """
        load_service(kind)
        with self._lock:
            before = self._offered.pop(name, None)
            if before is not None:
                before[1].close(f"{name} was advertised again")
            self._offered[name] = owner, OfferedService(self._node, name, kind, send)
        return before is not None

    def withdraw(self, owner: object, name: str) -> bool:
        """Unregister a client's service; false if it was not registered."""
        with self._lock:
            known = self._offered.get(name)
            if known is None or known[0] is not owner:
                return False
            del self._offered[name]
        known[1].close(f"{name} was unadvertised while it was called")
        return True

    def respond(
        self, owner: object, name: str, identifier: Any, values: Any, *, result: bool
    ) -> None:
        """Set an answer; see `OfferedService.respond`."""
        known = self._offered.get(name)
        if known is None or known[0] is not owner:
            raise RosError(f"Service {name} has not been advertised via rosbridge")
        known[1].respond(identifier, values, result=result)

    def withdraw_all(self, owner: object) -> None:
        """Unregister all services of a client."""
        with self._lock:
            names = [name for name, (who, _) in self._offered.items() if who is owner]
        for name in names:
            self.withdraw(owner, name)
