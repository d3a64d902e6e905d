"""API of a node over XML-RPC (http://wiki.ros.org/ROS/Slave_API)."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any, Protocol

from gazelle_ros import apis
from gazelle_ros.apis import Api, Method, Triple
from gazelle_ros.parameters import NodeParameters
from gazelle_ros.publishing import Publication
from gazelle_ros.subscribing import Subscription

_TCPROS = "TCPROS"
_INPROC = "INTRAPROCESS"


class SlaveNode(Protocol):
    """Interface of a node that the API needs."""

    name: str
    uri: str
    host: str
    tcpros_port: int
    master_uri: str
    parameters: NodeParameters

    def publications(self) -> list[Publication]:
        """Return all topics published."""

    def publication(self, topic: str) -> Publication | None:
        """Return the publication on a topic, if any."""

    def subscriptions(self) -> list[Subscription]:
        """Return all topics subscribed to."""

    def subscription(self, topic: str) -> Subscription | None:
        """Return the subscription to a topic, if any."""

    def shutdown_requested(self, caller: str, reason: str) -> None:
        """Handle a request of the master or a tool to shut down."""


class SlaveApi:
    """The methods of one node; all run on the loop's thread."""

    def __init__(self, node: SlaveNode) -> None:
        self._node = node
        topic, key = ("topic", apis.graph_name), ("parameter_key", apis.parameter)
        self._api = Api(
            {
                "getPid": Method(self.get_pid, -1),
                "getName": Method(self.get_name, 0),
                "getMasterUri": Method(self.get_master_uri, 0),
                "getUri": Method(self.get_uri, ""),
                "getPublications": Method(self.get_publications, 0),
                "getSubscriptions": Method(self.get_subscriptions, 0),
                "getBusInfo": Method(self.get_bus_info, []),
                "getBusStats": Method(self.get_bus_stats, []),
                "shutdown": Method(self.shutdown, False, (("msg", apis.text),)),
                "paramUpdate": Method(self.param_update, -1, (key, ("value", apis.given))),
                "publisherUpdate": Method(
                    self.publisher_update, -1, (topic, ("publishers", apis.api_uris))
                ),
                "requestTopic": Method(
                    self.request_topic, [], (topic, ("protocols", apis.listing))
                ),
            }
        )

    def dispatch(self, method: str, params: list[Any]) -> list[Any]:
        """Call a method; see `gazelle_ros.apis.Api.dispatch`."""
        return self._api.dispatch(method, params)

    def prepare(self, method: str, params: list[Any]) -> Callable[[], list[Any]]:
        """Check the arguments of a call; see `gazelle_ros.apis.Api.prepare`."""
        return self._api.prepare(method, params)

    def get_pid(self, _caller: str) -> Triple:
        """Return the node's process."""
        return 1, "", os.getpid()

    def get_name(self, _caller: str) -> Triple:
        """Return the node's name."""
        return 1, "", self._node.name

    def get_uri(self, _caller: str) -> Triple:
        """Return the URI of the node."""
        return 1, "", self._node.uri

    def get_master_uri(self, _caller: str) -> Triple:
        """Return the master this node is registered with."""
        return 1, self._node.master_uri, self._node.master_uri

    def get_publications(self, _caller: str) -> Triple:
        """Return topics and types published."""
        found = [[p.topic, p.message_class._type] for p in self._node.publications()]
        return 1, "publications", found

    def get_subscriptions(self, _caller: str) -> Triple:
        """Return topics and types subscribed to."""
        found = [[s.topic, s.message_class._type] for s in self._node.subscriptions()]
        return 1, "subscriptions", found

    def get_bus_info(self, _caller: str) -> Triple:
        """Return all connections.

        Each is number, peer, direction, transport, topic, connected, description.
        """
        found: list[list[Any]] = []
        for publication in self._node.publications():
            found += _outgoing(publication)
        for subscription in self._node.subscriptions():
            found += _incoming(subscription)
        return 1, "bus info", found

    def get_bus_stats(self, _caller: str) -> Triple:
        """Return traffic of all connections."""
        published = [
            [
                publication.topic,
                publication.bytes,
                [[link.number, link.bytes, link.messages, True] for link in publication.remote]
                + [[link.number, 0, link.messages, True] for link in publication.local],
            ]
            for publication in self._node.publications()
        ]
        subscribed = [
            [
                subscription.topic,
                [
                    [link.number, link.bytes, link.messages, link.dropped, link.up]
                    for link in subscription.links.values()
                ]
                + [
                    [link.number, 0, link.messages, 0, True] for link in subscription.local.values()
                ],
            ]
            for subscription in self._node.subscriptions()
        ]
        return 1, "", [_bounded(published), _bounded(subscribed), []]

    def shutdown(self, caller: str, reason: str) -> Triple:
        """Handle a request of the master or a tool to shut down."""
        self._node.shutdown_requested(caller, reason)
        return 1, "shutdown", 0

    def param_update(self, _caller: str, key: str, value: Any) -> Triple:
        """Handle the change of a subscribed parameter."""
        if self._node.parameters.update(key, value):
            return 1, "", 0
        return -1, "not subscribed", 0

    def publisher_update(self, _caller: str, topic: str, publishers: Sequence[Any]) -> Triple:
        """Set the publishers of a topic."""
        subscription = self._node.subscription(topic)
        if subscription is not None:
            subscription.update([uri for uri in publishers if isinstance(uri, str)])
        return 1, "", 0

    def request_topic(self, _caller: str, topic: str, protocols: Sequence[Any]) -> Triple:
        """Return the address that a subscriber connects to."""
        if self._node.publication(topic) is None:
            return -1, f"Not a publisher of [{topic}]", []
        for protocol in protocols:
            if isinstance(protocol, list) and protocol and protocol[0] == _TCPROS:
                host, port = self._node.host, self._node.tcpros_port
                return 1, f"ready on {host}:{port}", [_TCPROS, host, port]
        return 0, "no supported protocol implementations", []


def _outgoing(publication: Publication) -> list[list[Any]]:
    topic = publication.topic
    found: list[list[Any]] = []
    for link in publication.remote:
        host, port = link.address
        text = _connection(link.port, host, port, link.descriptor)
        found.append([link.number, link.peer, "o", _TCPROS, topic, True, text])
    for local in publication.local:
        text = "connection within the process"
        found.append([local.number, local.peer, "o", _INPROC, topic, True, text])
    return found


def _incoming(subscription: Subscription) -> list[list[Any]]:
    topic = subscription.topic
    found: list[list[Any]] = []
    for link in subscription.links.values():
        host, port = link.endpoint
        text = _connection(link.port, host, port, link.descriptor)
        found.append([link.number, link.uri, "i", _TCPROS, topic, link.up, text])
    for uri, local in subscription.local.items():
        text = "connection within the process"
        found.append([local.number, uri, "i", _INPROC, topic, True, text])
    return found


def _connection(own_port: int, host: str, port: int, descriptor: int) -> str:
    """Return a connection in the form that rosnode searches for."""
    return f"TCPROS connection on port {own_port} to [{host}:{port} on socket {descriptor}]"


def _bounded(value: Any) -> Any:
    """Return counters in the range of XML-RPC: they stop at the largest 32-bit number."""
    if isinstance(value, list):
        return [_bounded(item) for item in value]
    if isinstance(value, int) and not isinstance(value, bool):
        return min(value, 2**31 - 1)
    return value
