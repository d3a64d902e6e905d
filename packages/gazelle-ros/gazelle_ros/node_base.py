"""Common base of the parts of a node."""

from __future__ import annotations

import itertools
import os
import threading
from abc import ABC, abstractmethod
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.deadlines import wait_of
from gazelle_ros.clock import TimeSource
from gazelle_ros.errors import (
    ApiError,
    InvalidNameError,
    MasterUnreachableError,
    NodeClosedError,
    report,
)
from gazelle_ros.limits import NetworkLimits
from gazelle_ros.loop import EventLoop
from gazelle_ros.master.proxy import MasterProxy
from gazelle_ros.parameters import NodeParameters
from gazelle_ros.xmlrpc.async_client import AsyncClient

_nodes: dict[str, NodeBase] = {}
"""The nodes of this process by their URI."""
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_nodes.clear)


def nodes_here() -> list[NodeBase]:
    """Return the nodes of this process that are open."""
    return [node for node in list(_nodes.values()) if not node.closed]


def node_here(uri: str) -> NodeBase | None:
    """Return the node of this process at that URI, if it is open."""
    node = _nodes.get(uri)
    return None if node is None or node.closed else node


class NodeBase(ABC):
    """Identity, event loop and master of a node.

    Attributes:
        name: The node's global name.
        namespace: With slashes at both ends.
        uri: Of the node's XML-RPC server.
        host: The name other nodes reach this one by.
        tcpros_port: Port for topics and services.
        master: The API of the master.
        parameters: The parameter server as this node sees it.
        clock: Source of the time.
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
    limits: NetworkLimits
    share_messages: bool
    clock: TimeSource
    parameters: NodeParameters

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._numbers = itertools.count(1)
        self._closing = False
        self._closer: threading.Thread | None = None
        self._closed = threading.Event()

    def resolve(self, name: str) -> str:
        """Return the global name of `name` for this node, remapped."""
        return names.resolve(name, self.name, self.remappings)

    @property
    def closed(self) -> bool:
        """True when the node is closed, or closing."""
        return self._closing

    def wait_closed(self, timeout: float | None = None) -> bool:
        """Wait until the node is closed; False if it is not within `timeout` seconds."""
        return self._closed.wait(None if timeout is None else wait_of(timeout))

    def next_number(self) -> int:
        """Return a number for a new connection."""
        return next(self._numbers)

    def _name(self, name: str) -> str:
        if not name:
            raise InvalidNameError("a topic or service needs a name")
        return names.check(self.resolve(names.check(name)))

    def _enter_process(self) -> None:
        """Register the node for the other nodes of this process."""
        _nodes[self.uri] = self

    def _leave_process(self) -> None:
        """Undo `_enter_process`."""
        _nodes.pop(self.uri, None)

    def _check_open(self) -> None:
        if self._closing:
            raise NodeClosedError(f"the node {self.name} is closed")

    def _call_master(self, method: str, *params: Any) -> Any:
        """Call the master; while it does not answer, the registrar continues trying."""
        try:
            return self.master.call(method, *params)
        except (MasterUnreachableError, ApiError) as error:
            report(f"{method} of {self.name}", error)
            self._handle_lost_master()
            return None

    @abstractmethod
    def _handle_lost_master(self) -> None:
        """Handle a missing answer of the master: check it, and register again when it answers."""
