"""The graph as tools see it: topics, nodes, services, their types and addresses."""

from __future__ import annotations

import os
from collections.abc import Iterable

from gazelle_ros import names, net
from gazelle_ros.base.closing import Closeable
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.errors import ApiError
from gazelle_ros.master.proxy import GREETING_S, MasterProxy
from gazelle_ros.tools.errors import ToolError

Uses = list[tuple[str, str, list[str]]]
"""Topic, type, and the nodes that publish it, or subscribe to it."""
UNKNOWN_TYPE = "unknown type"


class GraphInspector(Closeable):
    """A tool's access to a master.

    Args:
        tool: Name of the tool, such as ``rostopic``.
        master_uri: By default `ROS_MASTER_URI`, else this machine.
        namespace: Namespace of relative names; by default `ROS_NAMESPACE`.
    """

    def __init__(
        self, tool: str, master_uri: str | None = None, namespace: str | None = None
    ) -> None:
        self.master_uri = master_uri or net.default_master_uri()
        space = os.environ.get("ROS_NAMESPACE", "/") if namespace is None else namespace
        self.caller = names.canonical(names.as_namespace(space) + tool)
        self.master = MasterProxy(self.master_uri, self.caller, GREETING_S)
        self._uris: dict[str, str | None] = {}

    def resolve(self, name: str) -> str:
        """Return the global name of a user's name."""
        return names.resolve(name, self.caller)

    def types(self) -> dict[str, str]:
        """Return the types of topics."""
        return dict(self.master.topic_types())

    def uses(self) -> tuple[Uses, Uses]:
        """Return publications and subscriptions, in the master's order."""
        publishers, subscribers, _ = self.master.system_state()
        types = self.types()

        def typed(state: dict[str, list[str]]) -> Uses:
            return [(name, types.get(name, UNKNOWN_TYPE), nodes) for name, nodes in state.items()]

        return typed(publishers), typed(subscribers)

    def services(self) -> list[tuple[str, list[str]]]:
        """Return services and their providers."""
        return list(self.master.system_state()[2].items())

    def nodes(self, namespace: str | None = None) -> list[str]:
        """Return names of all nodes, sorted; or of those in a namespace."""
        state = self.master.system_state()
        found = {node for part in state for nodes in part.values() for node in nodes}
        if namespace is None:
            return sorted(found)
        space = names.as_namespace(self.resolve(namespace))
        return sorted(node for node in found if node.startswith(space))

    def node_uri(self, node: str, *, fresh: bool = False) -> str | None:
        """Return the address of a node; None if there is no such node."""
        if fresh or node not in self._uris:
            try:
                self._uris[node] = self.master.lookup_node(node)
            except ApiError:
                self._uris[node] = None
        return self._uris[node]

    def service_uri(self, service: str) -> str | None:
        """Return the address of a service; None if no node offers it."""
        try:
            return self.master.lookup_service(service)
        except ApiError:
            return None

    def unknown(self, what: str, name: str, known: Iterable[str]) -> ToolError:
        """Return the error for a name that is not on the graph."""
        return ToolError(f"there is no {what} {name}", hint=did_you_mean(name, known))

    def close(self) -> None:
        """Close the connections."""
        self.master.close()
