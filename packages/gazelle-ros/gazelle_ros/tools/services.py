"""Services with their types, and calls to them."""

from __future__ import annotations

import time
from typing import Any

from gazelle_ros import names, net
from gazelle_ros.errors import ServiceError
from gazelle_ros.limits import LIMITS
from gazelle_ros.messages import MessageException, load_service
from gazelle_ros.messages.yaml import fill_message_args, get_printable_message_args
from gazelle_ros.msgs import std_msgs
from gazelle_ros.node import Node
from gazelle_ros.tcpros import headers
from gazelle_ros.tcpros.service_links import ServiceChannel
from gazelle_ros.time import Time
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import keep_text_fields
from gazelle_ros.tools.graph import GraphInspector

_PATIENCE_S = 5.0


def list_services(graph: GraphInspector, space: str | None = None) -> list[tuple[str, list[str]]]:
    """Return services and their nodes, sorted; those of a namespace, or all."""
    found = sorted(graph.services())
    if space is None:
        return found
    name = graph.resolve(space)
    below = names.as_namespace(name)
    return [each for each in found if each[0] == name or each[0].startswith(below)]


def service_node(graph: GraphInspector, service: str) -> str:
    """Return the node that provides a service.

    Raises:
        ToolError: None does.
    """
    name = graph.resolve(service)
    known = dict(graph.services())
    if not known.get(name):
        raise graph.unknown("service", name, known)
    return known[name][0]


def service_uri(graph: GraphInspector, service: str) -> str:
    """Return the address of a service.

    Raises:
        ToolError: It has no provider.
    """
    name = graph.resolve(service)
    uri = graph.service_uri(name)
    if uri is None:
        raise graph.unknown("service", name, dict(graph.services()))
    return uri


def probe(graph: GraphInspector, service: str) -> dict[str, str]:
    """Return the header of a service.

    Raises:
        ToolError: It has no provider, or it does not answer.
    """
    name = graph.resolve(service)
    uri = service_uri(graph, name)
    host, port, _ = net.split_uri(uri, "rosrpc")
    fields = {"callerid": graph.caller, "service": name, "md5sum": headers.ANY, "probe": "1"}
    try:
        channel = ServiceChannel(host, port, fields, LIMITS, time.monotonic() + _PATIENCE_S)
    except (ServiceError, TimeoutError) as error:
        raise ToolError(f"service {name} at {uri} does not answer: {error}") from None
    channel.close()
    return channel.header


def service_type(graph: GraphInspector, service: str) -> str:
    """Return the type of a service.

    Raises:
        ToolError: It has no provider, or it does not answer.
    """
    return probe(graph, service).get("type", "")


def services_of_type(graph: GraphInspector, kind: str) -> list[str]:
    """Return the services of a type; those that do not answer are left out."""
    found = []
    for name, _ in graph.services():
        try:
            if service_type(graph, name) == kind:
                found.append(name)
        except ToolError:
            continue
    return found


def service_arguments(graph: GraphInspector, service: str) -> str:
    """Return the fields of a service's request, separated by spaces.

    Raises:
        ToolError: It has no provider, or it does not answer.
    """
    request = load_service(service_type(graph, service))._request_class
    return get_printable_message_args(request())


def service_info(graph: GraphInspector, service: str) -> str:
    """Return node, address, type and arguments of a service.

    Raises:
        ToolError: It has no provider, or it does not answer.
    """
    lines = [
        f"Node: {service_node(graph, service)}",
        f"URI: {service_uri(graph, service)}",
        f"Type: {service_type(graph, service)}",
        f"Args: {service_arguments(graph, service)}",
    ]
    return "\n".join(lines) + "\n"


class ServiceCaller:
    """Calls one service with values that users write.

    Args:
        graph: The graph.
        node: Node of the calls.
        service: The service's name.

    Raises:
        ToolError: It has no provider, or it does not answer.
    """

    def __init__(self, graph: GraphInspector, node: Node, service: str) -> None:
        self._node = node
        self._class: Any = load_service(service_type(graph, service))
        self._client = node.client(graph.resolve(service), self._class)

    @property
    def takes_values(self) -> bool:
        """True if the request has fields."""
        return bool(self._class._request_class.__slots__)

    def request(self, arguments: list[Any]) -> Any:
        """Return a request from values.

        Raises:
            ToolError: They do not fit its fields.
        """
        made = self._class._request_class()
        now = Time(nsecs=self._node.clock.now())
        keys = {"now": now, "auto": std_msgs.msg.Header(stamp=now)}
        try:
            fill_message_args(made, keep_text_fields(made, arguments), keys=keys)
        except (MessageException, ValueError) as error:
            given = "\n".join(f" * {each} (type {type(each).__name__})" for each in arguments)
            known = get_printable_message_args(made)
            raise ToolError(
                f"Incompatible arguments to call service:\n{error}\n"
                f"Provided arguments are:\n{given}\n\nService arguments are: [{known}]"
            ) from None
        return made

    def call(self, request: Any) -> Any:
        """Call the service; returns the response.

        Raises:
            ServiceError: The call failed.
            ToolError: A field has a value of the wrong type.
        """
        try:
            return self._client.call(request)
        except MessageException as error:
            raise ToolError(f"the request cannot be sent: {error}") from None
