"""rosapi: the graph and its parameters as services (http://wiki.ros.org/rosapi)."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from typing import Any
from urllib.parse import urlsplit

from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import ParameterNotFoundError, ServiceError
from gazelle_ros.messages import load_service
from gazelle_ros.node import Node
from gazelle_ros.rosbridge.settings import BridgeSettings
from gazelle_ros.rosbridge.type_details import definition_text, message_details, service_details
from gazelle_ros.time import Time
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.graph import UNKNOWN_TYPE, GraphInspector
from gazelle_ros.tools.listing import topics_of_type
from gazelle_ros.tools.services import service_type, services_of_type

_ACTION_TOPICS = {"cancel", "feedback", "goal", "result", "status"}


class RosApi(Closeable):
    """Serves ``/rosapi/...``.

    Args:
        node: Serves.
        settings: Settings with the visible patterns.
    """

    def __init__(self, node: Node, settings: BridgeSettings) -> None:
        self._node, self._settings = node, settings
        self._graph = GraphInspector(node.name.lstrip("/"), node.master_uri, "/")
        self._servers = [
            node.serve(f"/rosapi/{name}", load_service(f"rosapi/{kind}"), handler)
            for name, (kind, handler) in self._services().items()
        ]

    def close(self) -> None:
        """Serve no more."""
        for server in self._servers:
            server.close()
        self._graph.close()

    def _services(self) -> dict[str, tuple[str, Callable[[Any], Any]]]:
        """Return names, types and handlers.

        A handler returns the fields of the response, in order.
        """
        return {
            "topics": ("Topics", lambda _: self._topics()),
            "topics_and_raw_types": ("TopicsAndRawTypes", lambda _: self._raw_types()),
            "topics_for_type": ("TopicsForType", lambda r: [self._topics_for(r.type)]),
            "topic_type": ("TopicType", lambda r: [self._topic_type(r.topic)]),
            "publishers": ("Publishers", lambda r: [self._users(0, r.topic)]),
            "subscribers": ("Subscribers", lambda r: [self._users(1, r.topic)]),
            "services": ("Services", lambda _: [self._service_names()]),
            "services_for_type": ("ServicesForType", lambda r: [self._services_for(r.type)]),
            "service_type": ("ServiceType", lambda r: [self._service_type(r.service)]),
            "service_providers": ("ServiceProviders", lambda r: [self._providers(r.service)]),
            "service_node": ("ServiceNode", lambda r: [self._service_node(r.service)]),
            "service_host": ("ServiceHost", lambda r: [self._service_host(r.service)]),
            "nodes": ("Nodes", lambda _: [self._graph.nodes()]),
            "node_details": ("NodeDetails", lambda r: self._node_details(r.node)),
            "action_servers": ("GetActionServers", lambda _: [self._action_servers()]),
            "message_details": ("MessageDetails", lambda r: [message_details(r.type)]),
            "service_request_details": (
                "ServiceRequestDetails", lambda r: [service_details(r.type, "request")]
            ),
            "service_response_details": (
                "ServiceResponseDetails", lambda r: [service_details(r.type, "response")]
            ),
            "set_param": ("SetParam", self._set_param),
            "get_param": ("GetParam", self._get_param),
            "has_param": ("HasParam", lambda r: [self._has_param(r.name)]),
            "search_param": ("SearchParam", lambda r: [self._search_param(r.name)]),
            "delete_param": ("DeleteParam", self._delete_param),
            "get_param_names": ("GetParamNames", lambda _: [self._param_names()]),
            "get_time": ("GetTime", lambda _: [Time(nsecs=self._node.clock.now())]),
        }  # fmt: skip

    # Topics --------------------------------------------------------------------------------

    def _topics(self) -> list[list[str]]:
        """Return names of all topics in use, and their types."""
        published, subscribed = self._graph.uses()
        types = {name: kind for name, kind, _ in (*published, *subscribed)}
        found = [each for each in types.items() if self._settings.may_use_topic(each[0])]
        return [[name for name, _ in found], ["" if k == UNKNOWN_TYPE else k for _, k in found]]

    def _raw_types(self) -> list[list[str]]:
        names, types = self._topics()
        return [names, types, [definition_text(kind) for kind in types]]

    def _topics_for(self, kind: str) -> list[str]:
        return list(filter(self._settings.may_use_topic, topics_of_type(self._graph, kind)))

    def _topic_type(self, topic: str) -> str:
        if not self._settings.may_use_topic(topic):
            return ""
        return self._graph.types().get(self._graph.resolve(topic), "")

    def _users(self, part: int, topic: str) -> list[str]:
        """Return the nodes that publish a topic (0) or subscribe to it (1)."""
        if not self._settings.may_use_topic(topic):
            return []
        state = self._graph.master.system_state()
        return state[part].get(self._graph.resolve(topic), [])

    def _action_servers(self) -> list[str]:
        """Return the namespaces with all five topics of an action."""
        parts: dict[str, set[str]] = {}
        for name in self._topics()[0]:
            space, _, last = name.rpartition("/")
            parts.setdefault(space, set()).add(last)
        return sorted(space for space, names in parts.items() if space and names >= _ACTION_TOPICS)

    # Services and nodes ----------------------------------------------------------------------

    def _service_names(self) -> list[str]:
        names = (name for name, _ in self._graph.services())
        return sorted(filter(self._settings.may_use_service, names))

    def _services_for(self, kind: str) -> list[str]:
        return list(filter(self._settings.may_use_service, services_of_type(self._graph, kind)))

    def _service_type(self, service: str) -> str:
        if not self._settings.may_use_service(service):
            return ""
        try:
            return service_type(self._graph, service)
        except ToolError:
            return ""

    def _providers(self, kind: str) -> list[str]:
        """Return the nodes that offer services of a type."""
        matching = self._services_for(kind)
        return [
            node for name, nodes in self._graph.services() if name in matching for node in nodes
        ]

    def _service_node(self, service: str) -> str:
        nodes = dict(self._graph.services()).get(self._graph.resolve(service), [])
        return nodes[0] if nodes else ""

    def _service_host(self, service: str) -> str:
        uri = self._graph.service_uri(self._graph.resolve(service))
        return urlsplit(uri or "").hostname or ""

    def _node_details(self, node: str) -> list[list[str]]:
        """Return a node's subscriptions, publications and services."""
        published, subscribed, served = self._graph.master.system_state()
        return [
            _of(node, subscribed.items()),
            _of(node, published.items()),
            _of(node, served.items()),
        ]

    # Parameters ----------------------------------------------------------------------------

    def _set_param(self, request: Any) -> list[Any]:
        if not self._settings.may_use_parameter(request.name):
            return []
        try:
            value = json.loads(request.value)
        except ValueError:
            raise ServiceError(
                f"the value of {request.name} is not valid JSON; a string needs quotes: "
                f"{json.dumps(request.value[:40])}"
            ) from None
        self._node.set_param(request.name, value)
        return []

    def _get_param(self, request: Any) -> list[str]:
        """Return the value as JSON; the default where there is none."""
        if not self._settings.may_use_parameter(request.name):
            return [""]
        try:
            value = self._node.get_param(request.name)
        except ParameterNotFoundError:
            value = _default(request.default)
        return [json.dumps(value, default=str)]

    def _has_param(self, name: str) -> bool:
        return self._settings.may_use_parameter(name) and self._node.has_param(name)

    def _search_param(self, name: str) -> str:
        if not self._settings.may_use_parameter(name):
            return ""
        return self._node.search_param(name) or ""

    def _delete_param(self, request: Any) -> list[Any]:
        if self._has_param(request.name):
            self._node.delete_param(request.name)
        return []

    def _param_names(self) -> list[str]:
        return list(filter(self._settings.may_use_parameter, self._node.param_names()))


def _of(node: str, uses: Iterable[tuple[str, list[str]]]) -> list[str]:
    return sorted(name for name, nodes in uses if node in nodes)


def _default(text: str) -> Any:
    """Return JSON, or else the text itself; None if it is empty."""
    try:
        return json.loads(text) if text else None
    except ValueError:
        return text
