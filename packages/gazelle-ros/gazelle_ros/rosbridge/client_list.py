"""Clients of a rosbridge server, published as topics."""

from __future__ import annotations

from typing import Any

from gazelle_ros.msgs import rosbridge_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time


class ClientList:
    """Connected clients, latched on ``client_count`` and ``connected_clients``.

    Args:
        node: Publishes.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._clients: dict[Any, tuple[str, int]] = {}
        self._count_class = std_msgs.msg.Int32
        self._list_class = rosbridge_msgs.msg.ConnectedClients
        self._client_class = rosbridge_msgs.msg.ConnectedClient
        self._counts = node.advertise("client_count", self._count_class, latch=True)
        self._lists = node.advertise("connected_clients", self._list_class, latch=True)
        self._publish()

    @property
    def count(self) -> int:
        """Number of clients."""
        return len(self._clients)

    def add(self, connection: Any) -> None:
        """Add a connection."""
        address = connection.remote_address
        self._clients[connection] = str(address[0]) if address else "", self._node.clock.now()
        self._publish()

    def remove(self, connection: Any) -> None:
        """Remove a connection."""
        self._clients.pop(connection, None)
        self._publish()

    def _publish(self) -> None:
        self._counts.publish(self._count_class(len(self._clients)))
        self._lists.publish(
            self._list_class([
                self._client_class(address, Time(nsecs=since))
                for address, since in self._clients.values()
            ])
        )  # fmt: skip
