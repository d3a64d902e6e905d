"""The services of a node."""

from __future__ import annotations

from typing import Any

from gazelle_ros.errors import InvalidNameError
from gazelle_ros.node_base import NodeBase, nodes_here
from gazelle_ros.services import Handler, ServiceClient, ServiceServer, wait_for_service


class ServiceNode(NodeBase):
    """The part of a node that offers and calls services."""

    def __init__(self) -> None:
        super().__init__()
        self._services: dict[str, ServiceServer] = {}
        self._clients: set[ServiceClient] = set()

    def serve(self, name: str, service_class: Any, handler: Handler) -> ServiceServer:
        """Serve a service; the last node that serves a name gets the calls.

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
                self, resolved, service_class, handler, self._unserve
            )
        self._call_master("registerService", resolved, server.uri, self.uri)
        return server

    def client(self, name: str, service_class: Any, *, persistent: bool = False) -> ServiceClient:
        """Return a client of a service.

        Args:
            name: Any name; it is resolved for the node.
            service_class: Its type.
            persistent: Keep one connection for all calls.
        """
        client = ServiceClient(
            self,
            self._name(name),
            service_class,
            self.neighbour_service,
            self._forget_client,
            persistent=persistent,
        )
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

    @staticmethod
    def neighbour_service(host: str, port: int, name: str) -> ServiceServer | None:
        """Return the service of that name, if a node of this process serves it there."""
        for node in nodes_here():
            if node.tcpros_port == port and node.host == host and isinstance(node, ServiceNode):
                return node.service(name)
        return None

    # For the parts of the node -------------------------------------------------------------

    def services(self) -> list[ServiceServer]:
        """Return all services this node offers."""
        return list(self._services.values())

    def service(self, name: str) -> ServiceServer | None:
        """Return the service of that name."""
        return self._services.get(name)

    def _unserve(self, server: ServiceServer) -> None:
        """Remove a closed service."""
        with self._lock:
            if self._closing:
                return
            self._services.pop(server.name, None)
        self._call_master("unregisterService", server.name, server.uri)
        self.loop.run(server.drop_all)

    def _forget_client(self, client: ServiceClient) -> None:
        """Remove a closed client."""
        with self._lock:
            self._clients.discard(client)
