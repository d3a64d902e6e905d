"""Access to the graph before `init_node`: call the master, set parameters, call services."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, cast

from gazelle_ros import net
from gazelle_ros.compat.rospy import names
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.limits import LIMITS
from gazelle_ros.master.proxy import MasterProxy
from gazelle_ros.parameters import NodeParameters

if TYPE_CHECKING:
    from gazelle_ros.node import Node
    from gazelle_ros.services import ServiceServer


class Guest:
    """A user without a node: as much of `Node` as parameters and service calls need."""

    def __init__(self) -> None:
        self.name = names._own_name()  # noqa: SLF001  # a module of the same package
        self.master_uri = master_uri()
        self.master = MasterProxy(self.master_uri, self.name)
        self.limits = LIMITS
        self.parameters = NodeParameters(cast("Node", self))
        self.uri = "http://127.0.0.1:0/"
        """Address without a server: a guest gets no changes."""

    def resolve(self, name: str) -> str:
        """Return the global name of a name."""
        return names.resolve_name(name)

    def wait_closed(self, timeout: float | None = None) -> bool:
        """Wait for a duration: guests are never closed."""
        return process.shutdown.wait(timeout)

    @staticmethod
    def neighbour_service(host: str, port: int, name: str) -> ServiceServer | None:
        """Return the server of a service in this process, if it is here."""
        from gazelle_ros.node import Node

        return Node.neighbour_service(host, port, name)

    def forget_client(self, client: Any) -> None:
        """Do nothing: guests do not keep their clients."""


_guests: dict[str, Guest] = {}
_lock = threading.Lock()


def master_uri() -> str:
    """Return the URI of this process's master: the command line's, or ROS_MASTER_URI."""
    return names.get_mappings().get("__master") or net.default_master_uri()


def user() -> Node:
    """Return the node, or a guest while there is none."""
    if process.node is not None:
        return process.node
    uri = master_uri()
    with _lock:
        guest = _guests.get(uri)
        if guest is None:
            guest = _guests[uri] = Guest()
    return cast("Node", guest)
