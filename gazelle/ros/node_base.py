"""What the parts of a node share."""

from __future__ import annotations

import itertools
import threading
from typing import TYPE_CHECKING, Any

from gazelle.ros import names
from gazelle.ros.errors import (
    ApiError,
    InvalidNameError,
    MasterUnreachableError,
    NodeClosedError,
    report,
)
from gazelle.ros.limits import Limits
from gazelle.ros.loop import EventLoop
from gazelle.ros.master.proxy import MasterProxy

if TYPE_CHECKING:
    from gazelle.ros.clock import Clock
    from gazelle.ros.registration import Registrar
    from gazelle.ros.statistics import Statistics
    from gazelle.ros.xmlrpc.async_client import AsyncClient


class NodeBase:
    """Identity, event loop and master of a node.

    Attributes:
        name: The node's global name.
        namespace: With slashes at both ends.
        uri: Of the node's XML-RPC server.
        host: The name other nodes reach this one by.
        tcpros_port: Where topics and services connect to.
        master: The API of the master.
    """

    name: str
    namespace: str
    remappings: dict[str, str]
    uri: str
    host: str
    tcpros_port: int
    master_uri: str
    master: MasterProxy
    calls: AsyncClient
    loop: EventLoop
    limits: Limits
    share_messages: bool
    clock: Clock
    statistics: Statistics | None = None
    _registrar: Registrar

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._numbers = itertools.count(1)
        self._closing = False
        self._closer: threading.Thread | None = None
        self._closed = threading.Event()

    def resolve(self, name: str) -> str:
        """The global name that `name` means to this node, remapped."""
        return names.resolve(name, self.name, self.remappings)

    @property
    def closed(self) -> bool:
        """True when the node is closed, or closing."""
        return self._closing

    def wait_closed(self, timeout: float | None = None) -> bool:
        """Wait until the node is closed; False if it is not within `timeout` seconds."""
        return self._closed.wait(timeout)

    def next_number(self) -> int:
        """A number for a new connection."""
        return next(self._numbers)

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
