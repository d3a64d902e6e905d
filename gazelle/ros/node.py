"""A ROS 1 node: publishes, subscribes, serves, calls, and knows parameters.

Several nodes may live in one process; messages between them go over as objects, without a
socket.
"""

from __future__ import annotations

import contextlib
import itertools
import socket
import threading
import time
from collections.abc import Callable, Mapping
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

from gazelle.ros import loop as loops
from gazelle.ros import names, net
from gazelle.ros.errors import (
    ApiError,
    InvalidNameError,
    MasterUnreachableError,
    Md5MismatchError,
    NodeClosedError,
    ProtocolError,
    RosError,
    RosTimeoutError,
    UnreachableError,
    report,
)
from gazelle.ros.limits import LIMITS, Limits
from gazelle.ros.master.proxy import MasterProxy
from gazelle.ros.parameters import Parameters
from gazelle.ros.publishing import PeerHook, Publication, Publisher
from gazelle.ros.raw import raw_class
from gazelle.ros.registration import Registrar
from gazelle.ros.services import Handler, ServiceClient, ServiceServer, wait_for_service
from gazelle.ros.slave import SlaveApi
from gazelle.ros.subscribing import Callback, Subscriber, Subscription
from gazelle.ros.tcpros import headers
from gazelle.ros.tcpros.server import TcprosServer
from gazelle.ros.xmlrpc.client import AsyncClient
from gazelle.ros.xmlrpc.server import XmlRpcServer

if TYPE_CHECKING:
    from gazelle.ros.clock import Clock

_REQUIRED: Any = object()
_neighbours: dict[str, Node] = {}
"""The nodes of this process by their URI."""


class Node:
    """A node on a ROS 1 graph.

    Args:
        name: Base name; a global name is taken as it is.
        namespace: Where the node stands.
        master_uri: Of the master; by default `ROS_MASTER_URI`, else this machine's port 11311.
        host: The name other nodes reach this one by; it decides the interface. By default
            `ROS_HOSTNAME`, else `ROS_IP`, else loopback.
        anonymous: Append process and time, so that many may run.
        remappings: From old names to new ones, as on a command line.
        clock: What time it is for this node; by default wall time, or simulated time from
            ``/clock`` if the parameter ``/use_sim_time`` is set.
        share_messages: Give subscribers in this process the published object itself when
            nobody else listens; otherwise every subscriber gets a copy.
        limits: What peers may demand.

    Attributes:
        name: The node's global name.
        namespace: With slashes at both ends.
        uri: Of the node's XML-RPC server.
        master: The API of the master.
        parameters: The parameter server as this node sees it.
        on_shutdown: Called with a reason when the master or a tool ends the node.

    Raises:
        InvalidNameError: A name is not legal.
        MasterUnreachableError: There is no master.
    """

    def __init__(
        self,
        name: str,
        *,
        namespace: str = "/",
        master_uri: str | None = None,
        host: str | None = None,
        anonymous: bool = False,
        remappings: Mapping[str, str] | None = None,
        clock: Clock | None = None,
        share_messages: bool = True,
        limits: Limits = LIMITS,
    ) -> None:
        self.namespace = names.as_namespace(namespace)
        self.name = _full_name(name, self.namespace, anonymous=anonymous)
        self.namespace = names.namespace_of(self.name)
        self.remappings = names.resolve_remappings(remappings or {}, self.name)
        self.master_uri = master_uri or net.default_master_uri()
        self.host = host or net.default_host()
        self.share_messages = share_messages
        self.limits = limits
        self.on_shutdown: list[Callable[[str], None]] = []
        self.master = MasterProxy(self.master_uri, self.name, limits=limits)
        self.parameters = Parameters(self)
        self._lock = threading.RLock()
        self._publications: dict[str, Publication] = {}
        self._subscriptions: dict[str, Subscription] = {}
        self._services: dict[str, ServiceServer] = {}
        self._clients: set[ServiceClient] = set()
        self._numbers = itertools.count(1)
        self._closing = False
        self._closed = threading.Event()
        self.loop = loops.acquire()
        self._open()
        self.clock: Clock = clock if clock is not None else self._find_clock()

    def _open(self) -> None:
        """Open the ports and make sure there is a master."""
        opened: list[Callable[[], None]] = []
        try:
            self.calls = AsyncClient(self.loop, limits=self.limits, lost=self._lost)
            slave = SlaveApi(self)
            self._server = XmlRpcServer(self.loop, self.host, 0, slave.dispatch, self.limits)
            opened.append(self._server.close)
            self._tcpros = TcprosServer(self.loop, self.host, self._route, self.limits)
            opened.append(lambda: self.loop.run(self._tcpros.close))
            self.uri = self._server.uri
            self.tcpros_port = self._tcpros.port
            self.master.get_pid()
        except BaseException as error:
            for close in opened:
                close()
            loops.release(self.loop)
            if isinstance(error, OSError):
                raise RosError(f"cannot listen on {self.host}: {error}") from None
            raise
        _neighbours[self.uri] = self
        self._registrar = Registrar(self)
        self.loop.call_soon(self._registrar.start)

    def _find_clock(self) -> Clock:
        from gazelle.ros.clock import node_clock

        try:
            return node_clock(self)
        except BaseException:
            self.close()
            raise

    # Names ---------------------------------------------------------------------------------

    def resolve(self, name: str) -> str:
        """The global name that `name` means to this node, remapped."""
        return names.resolve(name, self.name, self.remappings)

    # Topics --------------------------------------------------------------------------------

    def advertise(
        self,
        topic: str,
        message_class: Any,
        queue_size: int | None = 10,
        *,
        latch: bool = False,
        tcp_nodelay: bool = False,
        on_connect: PeerHook | None = None,
        on_disconnect: PeerHook | None = None,
    ) -> Publisher:
        """Publish on a topic.

        Args:
            topic: Any name; it is resolved for the node.
            message_class: Of the messages.
            queue_size: Messages kept for a subscriber that is slow, the oldest dropped;
                None to wait for slow subscribers.
            latch: Send the last message to everybody who connects later.
            tcp_nodelay: Do not let the system collect small packets.
            on_connect: Called with the name of each subscriber that connects.
            on_disconnect: Called with the name of each that goes.

        Raises:
            InvalidNameError: The name is not legal.
            Md5MismatchError: This node publishes another type there already.
        """
        name = self._name(topic)
        with self._lock:
            self._check_open()
            publication = self._publications.get(name)
            fresh = publication is None
            if publication is None:
                publication = Publication(self, name, message_class)
            _check_same(publication.message_class, message_class, name)
            publisher = Publisher(publication, on_connect, on_disconnect)
            publication.publishers.append(publisher)
            publication.queue_size = _wider(publication.queue_size, queue_size, fresh=fresh)
            publication.latching |= latch
            publication.tcp_nodelay |= tcp_nodelay
            self._publications[name] = publication
        if fresh:
            self._ask("registerPublisher", name, message_class._type, self.uri)  # noqa: SLF001  # genpy's name
        return publisher

    def subscribe(
        self,
        topic: str,
        message_class: Any,
        callback: Callback,
        queue_size: int | None = None,
        *,
        tcp_nodelay: bool = False,
        raw: bool = False,
    ) -> Subscriber:
        """Get the messages of a topic, one after another, on a worker thread.

        Args:
            topic: Any name; it is resolved for the node.
            message_class: Of the messages; `gazelle.ros.raw.RawMessage` takes any.
            callback: Called with each message; what it raises is reported and changes nothing.
            queue_size: Messages kept while callbacks are slow, the oldest dropped; None to
                keep all and let the publisher wait.
            tcp_nodelay: Ask publishers not to let the system collect small packets.
            raw: Do not decode; the callback gets a `RawMessage`.

        Raises:
            InvalidNameError: The name is not legal.
            Md5MismatchError: This node subscribes to another type there already.
        """
        name = self._name(topic)
        kind = raw_class(message_class) if raw else message_class
        with self._lock:
            self._check_open()
            subscription = self._subscriptions.get(name)
            fresh = subscription is None
            if subscription is None:
                subscription = Subscription(self, name, kind)
            _check_same(subscription.message_class, kind, name)
            subscriber = Subscriber(subscription, callback, queue_size)
            subscription.add(subscriber, tcp_nodelay=tcp_nodelay)
            self._subscriptions[name] = subscription
        if fresh:
            self._register_subscription(subscription)
        return subscriber

    def _register_subscription(self, subscription: Subscription) -> None:
        kind = subscription.message_class._type  # noqa: SLF001  # genpy's name
        uris = self._ask("registerSubscriber", subscription.topic, kind, self.uri)

        def begin() -> None:
            # An update from the master is newer than its answer, whichever came first.
            if not subscription.updated:
                subscription.update([uri for uri in uris if isinstance(uri, str)])

        if isinstance(uris, list):
            self.loop.call_soon(begin)

    def wait_for_message(self, topic: str, message_class: Any, timeout: float | None = None) -> Any:
        """The next message of a topic.

        Raises:
            RosTimeoutError: None came within `timeout` seconds of wall time.
            NodeClosedError: The node was closed meanwhile.
        """
        found: list[Any] = []
        event = threading.Event()

        def keep(message: Any) -> None:
            found.append(message)
            event.set()

        deadline = None if timeout is None else time.monotonic() + timeout
        subscriber = self.subscribe(topic, message_class, keep)
        try:
            while not event.wait(0.5 if deadline is None else _left(deadline, 0.5)):
                if self._closed.is_set():
                    raise NodeClosedError("the node was closed while it waited for a message")
                if deadline is not None and time.monotonic() >= deadline:
                    raise RosTimeoutError(
                        f"timeout exceeded while waiting for message on topic {subscriber.name}"
                    )
        finally:
            subscriber.close()
        return found[0]

    # Services ------------------------------------------------------------------------------

    def serve(self, name: str, service_class: Any, handler: Handler) -> ServiceServer:
        """Offer a service; the last node that offers a name gets the calls.

        Args:
            name: Any name; it is resolved for the node.
            service_class: Its type.
            handler: From request to response; see `ServiceServer`.

        Raises:
            InvalidNameError: The name is not legal, or served by this node already.
        """
        resolved = self._name(name)
        with self._lock:
            self._check_open()
            if resolved in self._services:
                raise InvalidNameError(f"this node serves {resolved} already")
            server = self._services[resolved] = ServiceServer(
                self, resolved, service_class, handler
            )
        self._ask("registerService", resolved, server.uri, self.uri)
        return server

    def client(self, name: str, service_class: Any, *, persistent: bool = False) -> ServiceClient:
        """Something that calls a service.

        Args:
            name: Any name; it is resolved for the node.
            service_class: Its type.
            persistent: Keep one connection for all calls.
        """
        client = ServiceClient(self, self._name(name), service_class, persistent=persistent)
        with self._lock:
            self._check_open()
            self._clients.add(client)
        return client

    def wait_for_service(self, name: str, timeout: float | None = None) -> None:
        """Wait until a service answers.

        Raises:
            RosTimeoutError: It does not within `timeout` seconds of wall time.
        """
        wait_for_service(self, self._name(name), timeout)

    # Parameters ----------------------------------------------------------------------------

    def get_param(self, name: str, default: Any = _REQUIRED) -> Any:
        """The value of a parameter; see `Parameters.get`."""
        if default is _REQUIRED:
            return self.parameters.get(name)
        return self.parameters.get(name, default)

    def set_param(self, name: str, value: Any) -> None:
        """Set a parameter or, with a dict, a whole namespace."""
        self.parameters.set(name, value)

    def has_param(self, name: str) -> bool:
        """True if a parameter is set."""
        return self.parameters.has(name)

    def delete_param(self, name: str) -> None:
        """Remove a parameter or namespace."""
        self.parameters.delete(name)

    def search_param(self, name: str) -> str | None:
        """Name of the nearest parameter of that name."""
        return self.parameters.search(name)

    def param_names(self) -> list[str]:
        """All keys that hold a value."""
        return self.parameters.names()

    # The end -------------------------------------------------------------------------------

    @property
    def closed(self) -> bool:
        """True when the node is closed, or closing."""
        return self._closing

    def wait_closed(self, timeout: float | None = None) -> bool:
        """Wait until the node is closed; False if it is not within `timeout` seconds."""
        return self._closed.wait(timeout)

    def close(self) -> None:
        """Unregister everything, close everything. Not to be called on the event loop."""
        with self._lock:
            if self._closing:
                return
            self._closing = True
        self._unregister_all()
        self.loop.run(self._close_links)
        self._server.close()
        self.master.close()
        for client in list(self._clients):
            client.close()
        _neighbours.pop(self.uri, None)
        self._closed.set()
        loops.release(self.loop)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _unregister_all(self) -> None:
        calls: list[tuple[str, ...]] = []
        with self._lock:
            calls += [("unregisterSubscriber", topic, self.uri) for topic in self._subscriptions]
            calls += [("unregisterPublisher", topic, self.uri) for topic in self._publications]
            calls += [("unregisterService", s.name, s.uri) for s in self._services.values()]
        if self._registrar.lost:
            return
        with contextlib.suppress(RosError):
            for method, *params in calls:
                self.master.call_raw(method, *params)

    def _close_links(self) -> None:
        self._registrar.stop()
        for subscription in self.subscriptions():
            subscription.close()
        for publication in self.publications():
            publication.close()
        for service in self.services():
            service.drop_all()
        self._tcpros.close()
        self.calls.close()

    def asked_to_end(self, caller: str, reason: str) -> None:
        """The master or a tool wants this node to end."""
        text = f"{caller}: {reason}" if reason else caller

        def end() -> None:
            for hook in list(self.on_shutdown):
                try:
                    hook(text)
                except Exception as error:  # noqa: BLE001  # the others shall run too
                    report("a shutdown hook", error)
            self.close()

        self.loop.submit(end)

    # For the parts of the node -------------------------------------------------------------

    def publication(self, topic: str) -> Publication | None:
        """What this node publishes on a topic."""
        return self._publications.get(topic)

    def subscription(self, topic: str) -> Subscription | None:
        """What this node subscribes to on a topic."""
        return self._subscriptions.get(topic)

    def publications(self) -> list[Publication]:
        """All of them."""
        return list(self._publications.values())

    def subscriptions(self) -> list[Subscription]:
        """All of them."""
        return list(self._subscriptions.values())

    def services(self) -> list[ServiceServer]:
        """All services this node offers."""
        return list(self._services.values())

    def next_number(self) -> int:
        """A number for a new connection."""
        return next(self._numbers)

    @staticmethod
    def neighbour(uri: str) -> Node | None:
        """The node of this process at that URI."""
        node = _neighbours.get(uri)
        return None if node is None or node.closed else node

    def unadvertise(self, publication: Publication, publisher: Publisher) -> None:
        """A publisher is closed."""
        with self._lock:
            if self._closing:
                return
            publication.publishers.remove(publisher)
            if publication.publishers:
                return
            self._publications.pop(publication.topic, None)
        self._ask("unregisterPublisher", publication.topic, self.uri)
        self.loop.run(publication.close)

    def unsubscribe(self, subscription: Subscription, subscriber: Subscriber) -> None:
        """A subscriber is closed."""
        with self._lock:
            subscription.remove(subscriber)
            if subscription.subscribers or self._closing:
                return
            self._subscriptions.pop(subscription.topic, None)
        self._ask("unregisterSubscriber", subscription.topic, self.uri)
        self.loop.run(subscription.close)

    def unserve(self, server: ServiceServer) -> None:
        """A service is closed."""
        with self._lock:
            if self._closing:
                return
            self._services.pop(server.name, None)
        self._ask("unregisterService", server.name, server.uri)
        self.loop.run(server.drop_all)

    def forget_client(self, client: ServiceClient) -> None:
        """A client is closed."""
        with self._lock:
            self._clients.discard(client)

    def _name(self, name: str) -> str:
        if not name:
            raise InvalidNameError("a topic or service needs a name")
        return names.check(self.resolve(names.check(name)))

    def _check_open(self) -> None:
        if self._closing:
            raise NodeClosedError(f"the node {self.name} is closed")

    def _ask(self, method: str, *params: Any) -> Any:
        """Call the master; while it does not answer, the registrar goes on trying."""
        try:
            return self.master.call(method, *params)
        except (MasterUnreachableError, ApiError) as error:
            report(f"{method} of {self.name}", error)
            self.loop.call_soon(self._registrar.alert)
            return None

    def _lost(self, uri: str) -> None:
        """A connection to a peer closed while nothing was asked."""
        if uri == self.master_uri and not self._closing:
            self._registrar.alert()

    def _route(
        self, sock: socket.socket, address: net.Address, fields: dict[str, str], rest: bytes
    ) -> None:
        """Give a TCPROS connection to the topic or service its header names."""
        if "service" in fields:
            headers.require(fields, "callerid", "md5sum")
            server = self._services.get(fields["service"])
            if server is None:
                raise ProtocolError(f"[{self.name}] is not a provider of  [{fields['service']}]")
            server.adopt(sock, fields, rest)
            return
        if "topic" not in fields:
            raise ProtocolError("no topic or service name detected")
        headers.require(fields, "callerid", "md5sum")
        publication = self._publications.get(fields["topic"])
        if publication is None:
            known = [[p.topic, p.message_class._type] for p in self.publications()]  # noqa: SLF001  # genpy's name
            raise ProtocolError(
                f"[{self.name}] is not a publisher of [{fields['topic']}]. Topics are {known}"
            )
        publication.check(fields["callerid"], fields)
        publication.adopt(sock, address, fields)


def _full_name(name: str, namespace: str, *, anonymous: bool) -> str:
    names.check(name)
    if names.is_private(name):
        raise InvalidNameError("a node's name cannot begin with '~'")
    full = names.canonical(name if names.is_global(name) else namespace + name)
    return names.anonymous(full) if anonymous else full


def _check_same(known: Any, wanted: Any, topic: str) -> None:
    mine, theirs = known._md5sum, wanted._md5sum  # noqa: SLF001  # genpy's names
    if headers.ANY not in {mine, theirs} and mine != theirs:
        raise Md5MismatchError(
            f"this node uses {topic} with the type {known._type} already, not {wanted._type}"  # noqa: SLF001
        )


def _wider(known: int | None, wanted: int | None, *, fresh: bool) -> int | None:
    """The larger of two queue sizes; None is without bound."""
    if fresh:
        return wanted
    return None if known is None or wanted is None else max(known, wanted)


def _left(deadline: float, most: float) -> float:
    return min(most, max(0.0, deadline - time.monotonic()))
