"""A ROS 1 node: publishes, subscribes, serves, calls, and knows parameters.

Several nodes may live in one process; messages between them go over as objects, without a
socket.
"""

from __future__ import annotations

import contextlib
import socket
import threading
from collections.abc import Callable, Mapping
from typing import Any

from gazelle_ros import loop as loops
from gazelle_ros import names, net, statistics
from gazelle_ros.base.closing import Closeable
from gazelle_ros.clock import TimeSource
from gazelle_ros.clock_topic import node_clock
from gazelle_ros.errors import (
    InvalidNameError,
    ProtocolError,
    RosError,
    report,
)
from gazelle_ros.limits import LIMITS, NetworkLimits
from gazelle_ros.master.proxy import MasterProxy
from gazelle_ros.parameters import NodeParameters
from gazelle_ros.registration import Registrar
from gazelle_ros.serving import ServiceNode
from gazelle_ros.slave import SlaveApi
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.server import TcprosServer
from gazelle_ros.topics import TopicNode
from gazelle_ros.xmlrpc.async_client import AsyncClient
from gazelle_ros.xmlrpc.server import XmlRpcServer

_CLOSING_S = 5.0
"""Time that the main thread waits for another that closes the node already."""
_REQUIRED: Any = object()


class Node(TopicNode, ServiceNode, Closeable):
    """A node on a ROS 1 graph.

    Args:
        name: Base name; a global name is taken as it is.
        namespace: Namespace of the node.
        master_uri: Of the master; by default `ROS_MASTER_URI`, else this machine's port 11311.
        host: The name other nodes reach this one by; it decides the interface. By default
            `ROS_HOSTNAME`, else `ROS_IP`, else loopback.
        anonymous: Append process and time, so that many may run.
        remappings: From old names to new ones, as on a command line.
        clock: Source of the time for this node; by default wall time, or simulated time from
            ``/clock`` if the parameter ``/use_sim_time`` is set.
        share_messages: Give subscribers in this process the published object itself when
            there is no other subscriber; otherwise every subscriber gets a copy.
        limits: Limits for peers.

    Attributes:
        name: The node's global name.
        namespace: With slashes at both ends.
        uri: Of the node's XML-RPC server.
        master: The API of the master.
        parameters: The parameter server as this node sees it.
        clock: Source of the time.
        statistics: Measures subscriptions, if the graph wants that.
        on_shutdown: Called with a reason when the master or a tool ends the node.
        on_new_master: Called when the node has registered with a master that took the place of
            the one before; what that one knew is to be set again.

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
        clock: TimeSource | None = None,
        share_messages: bool = True,
        limits: NetworkLimits = LIMITS,
    ) -> None:
        super().__init__()
        self.name = _full_name(name, names.as_namespace(namespace), anonymous=anonymous)
        self.namespace = names.namespace_of(self.name)
        self.remappings = names.resolve_remappings(remappings or {}, self.name)
        self.master_uri = master_uri or net.default_master_uri()
        self.host = net.usable_host(host) if host else net.default_host()
        self.share_messages = share_messages
        self.limits = limits
        self.on_shutdown: list[Callable[[str], None]] = []
        self.on_new_master: list[Callable[[], None]] = []
        self.master = MasterProxy(self.master_uri, self.name, limits=limits)
        self.parameters = NodeParameters(self)
        self.loop = loops.acquire()
        self._open()
        try:
            self._start(clock)
        except BaseException:
            self.close()
            raise

    def _open(self) -> None:
        """Open the ports and make sure there is a master."""
        opened: list[Callable[[], None]] = []
        try:
            self.calls = AsyncClient(self.loop, limits=self.limits, lost=self._lost)
            slave = SlaveApi(self)
            self._server = XmlRpcServer(
                self.loop, self.host, 0, slave.dispatch, self.limits, slave.prepare
            )
            opened.append(self._server.close)
            self._tcpros = TcprosServer(self.loop, self.host, self._route, self.limits)
            opened.append(lambda: self.loop.run(self._tcpros.close))
            self.uri = self._server.uri
            self.tcpros_port = self._tcpros.port
            self.master.greet()
        except BaseException as error:
            for close in opened:
                close()
            loops.release(self.loop)
            if isinstance(error, OSError) and not isinstance(error, RosError):
                raise RosError(f"cannot listen on {self.host}: {error}") from None
            raise
        self._enter_process()
        self._registrar = Registrar(self)
        self.loop.call_soon(self._registrar.start)

    def _start(self, clock: TimeSource | None) -> None:
        """Read the parameters for the behaviour of nodes."""
        self.clock = node_clock(self) if clock is None else clock
        if self.parameters.get("/enable_statistics", False) is True:
            kind = statistics.message_class()
            publisher = self.advertise(statistics.TOPIC, kind, queue_size=100)
            self.statistics = statistics.Statistics(self, publisher)

    # Parameters ----------------------------------------------------------------------------

    def get_param(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return the value of a parameter; see `NodeParameters.get`."""
        if default is _REQUIRED:
            return self.parameters.get(name)
        return self.parameters.get(name, default)

    def set_param(self, name: str, value: Any) -> None:
        """Set a parameter or, with a dict, a whole namespace."""
        self.parameters.set(name, value)

    def has_param(self, name: str) -> bool:
        """Return True if a parameter is set."""
        return self.parameters.has(name)

    def delete_param(self, name: str) -> None:
        """Remove a parameter or namespace."""
        self.parameters.delete(name)

    def search_param(self, name: str) -> str | None:
        """Return the name of the nearest parameter of that name."""
        return self.parameters.search(name)

    def param_names(self) -> list[str]:
        """Return all keys that hold a value."""
        return self.parameters.names()

    # The end -------------------------------------------------------------------------------

    def close(self) -> None:
        """Unregister everything, close everything. Not to be called on the event loop."""
        me = threading.current_thread()
        with self._lock:
            first, self._closing = not self._closing, True
            if first:
                self._closer = me
        if not first:
            if me is threading.main_thread() and me is not self._closer:
                # The process may end after this, and with it the thread that is at it.
                self._closed.wait(_CLOSING_S)
            return
        # What re-registers must be quiet before anything is unregistered.
        self.loop.run(self._close_calls)
        self._unregister_all()
        self.loop.run(self._close_links)
        self._server.close()
        self.master.close()
        for client in list(self._clients):
            client.close()
        self._leave_process()
        self._closed.set()
        loops.release(self.loop)

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

    def _close_calls(self) -> None:
        self._registrar.stop()
        self.calls.close()

    def _close_links(self) -> None:
        for subscription in self.subscriptions():
            subscription.close()
        for publication in self.publications():
            publication.close()
        for service in self.services():
            service.drop_all()
        self._tcpros.close()
        self.calls.close()

    def shutdown_requested(self, caller: str, reason: str) -> None:
        """Handle a request of the master or a tool to shut down."""
        text = f"{caller}: {reason}" if reason else caller

        def end() -> None:
            for hook in list(self.on_shutdown):
                try:
                    hook(text)
                except Exception as error:  # noqa: BLE001  # the others shall run too
                    report("a shutdown hook", error)
            self.close()

        self.loop.submit(end)

    # Inner -----------------------------------------------------------------------------------

    def _lost(self, uri: str) -> None:
        """Handle a closed connection to a peer without a pending call."""
        if uri == self.master_uri and not self._closing:
            self._registrar.alert()

    def _handle_lost_master(self) -> None:
        self.loop.call_soon(self._registrar.alert)

    def _route(
        self, sock: socket.socket, address: net.Address, fields: dict[str, str], rest: bytes
    ) -> None:
        """Pass a TCPROS connection to the topic or service of its header."""
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
            known = [[p.topic, p.message_class._type] for p in self.publications()]
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
