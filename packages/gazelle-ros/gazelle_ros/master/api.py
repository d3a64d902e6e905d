"""The methods of the master (http://wiki.ros.org/ROS/Master_API) and parameter server."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

from gazelle_ros import apis, names
from gazelle_ros.apis import Api, BadArgumentError, Method, Triple
from gazelle_ros.master.parameters import ParameterTree, changes
from gazelle_ros.master.registrations import NodeEntry, Registrations, Roles

CALLER = "/master"
"""Name by which the master calls nodes."""

Notify = Callable[[str, str, Sequence[Any]], None]
"""Calls `method(*params)` of the node at a URI, later, without an answer."""


class MasterApi:
    """API of the master, as nodes call it.

    Args:
        notify: Calls a node without waiting for it.
        shutdown: Called on a request to end.
    """

    def __init__(self, notify: Notify, shutdown: Callable[[str], None]) -> None:
        self.uri = ""
        self.registrations = Registrations()
        self.parameters = ParameterTree()
        self._notify = notify
        self._shutdown = shutdown
        self._api = Api(self._methods())

    def dispatch(self, method: str, params: list[Any]) -> list[Any]:
        """Call a method; see `gazelle_ros.apis.Api.dispatch`."""
        return self._api.dispatch(method, params)

    def prepare(self, method: str, params: list[Any]) -> Callable[[], list[Any]]:
        """Check the arguments of a call; see `gazelle_ros.apis.Api.prepare`."""
        return self._api.prepare(method, params)

    def _methods(self) -> dict[str, Method]:
        topic, kind = ("topic", apis.graph_name), ("topic_type", apis.message_type)
        service, address = ("service", apis.graph_name), ("service_api", apis.api_uri)
        caller = ("caller_api", apis.api_uri)
        key, value = ("key", apis.parameter), ("value", apis.carriable)
        return {
            "getPid": Method(self.get_pid, -1),
            "getUri": Method(self.get_uri, ""),
            "shutdown": Method(self.shutdown, 0, (("msg", apis.text),)),
            "registerPublisher": Method(self.register_publisher, [], (topic, kind, caller)),
            "unregisterPublisher": Method(self.unregister_publisher, 0, (topic, caller)),
            "registerSubscriber": Method(self.register_subscriber, [], (topic, kind, caller)),
            "unregisterSubscriber": Method(self.unregister_subscriber, 0, (topic, caller)),
            "registerService": Method(self.register_service, 0, (service, address, caller)),
            "unregisterService": Method(self.unregister_service, 0, (service, address)),
            "lookupService": Method(self.lookup_service, "", (service,)),
            "lookupNode": Method(self.lookup_node, "", (("node", apis.graph_name),)),
            "getPublishedTopics": Method(
                self.get_published_topics, 0, (("subgraph", apis.subgraph),)
            ),
            "getTopicTypes": Method(self.get_topic_types, []),
            "getSystemState": Method(self.get_system_state, [[], [], []]),
            "setParam": Method(self.set_param, 0, (key, value)),
            "getParam": Method(self.get_param, 0, (key,)),
            "hasParam": Method(self.has_param, False, (key,)),
            "deleteParam": Method(self.delete_param, 0, (key,)),
            "searchParam": Method(self.search_param, 0, (("key", apis.key),)),
            "getParamNames": Method(self.get_param_names, []),
            "subscribeParam": Method(self.subscribe_param, 0, (caller, key)),
            "unsubscribeParam": Method(self.unsubscribe_param, 0, (caller, key)),
        }

    # The master itself -------------------------------------------------------------------

    def get_pid(self, _caller: str) -> Triple:
        """Return the process the master runs in."""
        return 1, "", os.getpid()

    def get_uri(self, _caller: str) -> Triple:
        """Return the master's URI."""
        return 1, "", self.uri

    def shutdown(self, _caller: str, reason: str) -> Triple:
        """Stop the master."""
        self._shutdown(reason)
        return 1, "shutdown", 0

    # Topics ------------------------------------------------------------------------------

    def register_publisher(self, caller: str, topic: str, kind: str, uri: str) -> Triple:
        """Register `caller` as a publisher of `topic`, and notify subscribers; returns their URIs.

        Returns subscriber URIs.
        """
        entry = self._enter(caller, uri)
        self.registrations.publishers.add(topic, entry)
        self.registrations.note_publisher_type(topic, kind)
        self._notify_subscribers(topic)
        subscribers = self.registrations.subscriber_uris(topic)
        return 1, f"Registered [{caller}] as publisher of [{topic}]", subscribers

    def unregister_publisher(self, caller: str, topic: str, uri: str) -> Triple:
        """Unregister `caller` as a publisher of `topic`, and notify all subscribers."""
        triple = self._give_up(self.registrations.publishers, caller, topic, uri)
        if triple[2]:
            self._notify_subscribers(topic)
        return triple

    def register_subscriber(self, caller: str, topic: str, kind: str, uri: str) -> Triple:
        """Register `caller` as a subscriber of `topic`; returns publisher URIs."""
        entry = self._enter(caller, uri)
        self.registrations.subscribers.add(topic, entry)
        self.registrations.note_subscriber_type(topic, kind)
        return 1, f"Subscribed to [{topic}]", self.registrations.publisher_uris(topic)

    def unregister_subscriber(self, caller: str, topic: str, uri: str) -> Triple:
        """Unregister `caller` as a subscriber of `topic`."""
        return self._give_up(self.registrations.subscribers, caller, topic, uri)

    def get_published_topics(self, _caller: str, space: str) -> Triple:
        """Return topics with publishers in a namespace, and their types."""
        types = self.registrations.topic_types
        found = [
            [topic, types.get(topic, names.ANY_TYPE)]
            for topic in self.registrations.publishers.topics()
            if topic.startswith(space)
        ]
        return 1, "current topics", found

    def get_topic_types(self, _caller: str) -> Triple:
        """Return all topics that ever had a type."""
        types = self.registrations.topic_types
        return 1, "current system state", [[topic, kind] for topic, kind in types.items()]

    def get_system_state(self, _caller: str) -> Triple:
        """Return publishers, subscribers, services."""
        known = self.registrations
        services = [[name, [node]] for name, (node, _) in known.services.items()]
        state = [known.publishers.state(), known.subscribers.state(), services]
        return 1, "current system state", state

    # Services and nodes ------------------------------------------------------------------

    def register_service(self, caller: str, service: str, address: str, uri: str) -> Triple:
        """Register `caller` as the provider of `service`, in place of any other."""
        self.registrations.serve(service, address, self._enter(caller, uri))
        return 1, f"Registered [{caller}] as provider of [{service}]", 1

    def unregister_service(self, caller: str, service: str, address: str) -> Triple:
        """Unregister `caller` as the provider of `service`, if it still was under that address."""
        entry = self.registrations.nodes.get(caller)
        if entry is None:
            return 1, f"[{caller}] is not a registered node", 0
        if not self.registrations.stop_serving(service, address, entry):
            text = f"[{address}] is no longer the current service api handle for [{service}]"
            return 1, text, 0
        return 1, f"Unregistered [{caller}] as provider of [{service}]", 1

    def lookup_service(self, _caller: str, service: str) -> Triple:
        """Return the address of a service."""
        found = self.registrations.services.get(service)
        if found is None:
            return -1, "no provider", ""
        return 1, f"rosrpc URI: [{found[1]}]", found[1]

    def lookup_node(self, _caller: str, node: str) -> Triple:
        """Return the URI of a node."""
        entry = self.registrations.nodes.get(node)
        if entry is None:
            return -1, f"unknown node [{node}]", ""
        return 1, "node api", entry.uri

    # Parameters --------------------------------------------------------------------------

    def set_param(self, caller: str, key: str, value: Any) -> Triple:
        """Set a parameter or, with a dict, a whole namespace."""
        try:
            self.parameters.set(key, value)
        except TypeError as error:
            raise BadArgumentError(str(error)) from None
        self._notify_parameter(caller, key, value)
        return 1, f"parameter {key} set", 0

    def get_param(self, _caller: str, key: str) -> Triple:
        """Return the value of a parameter or namespace."""
        try:
            return 1, f"Parameter [{key}]", self.parameters.get(key)
        except KeyError:
            return -1, f"Parameter [{key}] is not set", 0

    def has_param(self, _caller: str, key: str) -> Triple:
        """Return True if it is set."""
        return 1, key, self.parameters.has(key)

    def delete_param(self, caller: str, key: str) -> Triple:
        """Remove a parameter or namespace."""
        try:
            self.parameters.delete(key)
        except KeyError:
            return -1, f"parameter [{key}] is not set", 0
        self._notify_parameter(caller, key, {})
        return 1, f"parameter {key} deleted", 0

    def search_param(self, caller: str, key: str) -> Triple:
        """Return the nearest parameter of that name, from the caller's namespace upwards."""
        if not names.is_global(caller):
            raise ValueError("namespace must be global")
        found = self.parameters.search(caller, key)
        if found is None:
            return -1, f"Cannot find parameter [{key}] in an upwards search", ""
        return 1, f"Found [{found}]", found

    def get_param_names(self, _caller: str) -> Triple:
        """Return all keys that hold a value."""
        return 1, "Parameter names", self.parameters.names()

    def subscribe_param(self, caller: str, uri: str, key: str) -> Triple:
        """Subscribe `caller` to changes of `key`; returns its value now, or an empty dict."""
        self.registrations.subscribe_parameter(key, self._enter(caller, uri))
        value = self.parameters.get(key) if self.parameters.has(key) else {}
        return 1, f"Subscribed to parameter [{key}]", value

    def unsubscribe_param(self, caller: str, uri: str, key: str) -> Triple:
        """Unsubscribe `caller` from changes of `key`."""
        entry = self.registrations.find(caller, uri)
        if entry is not None and self.registrations.unsubscribe_parameter(key, entry):
            self.registrations.leave_if_empty(entry)
        return 1, f"Unsubscribe to parameter [{key}]", 1

    # Inner -------------------------------------------------------------------------------

    def _enter(self, name: str, uri: str) -> NodeEntry:
        """Return the node's entry; a former node of that name is requested to shut down."""
        former_topics: list[str] = []
        known = self.registrations.nodes.get(name)
        if known is not None and known.uri != uri:
            former_topics = [topic for role, topic in known.topics if role == "pub"]
        entry, replaced = self.registrations.enter(name, uri)
        if replaced is not None:
            reason = f"[{name}] Reason: new node registered with same name"
            self._notify(replaced.uri, "shutdown", (CALLER, reason))
            for topic in former_topics:
                self._notify_subscribers(topic)
        return entry

    def _give_up(self, roles: Roles, caller: str, topic: str, uri: str) -> Triple:
        entry = self.registrations.nodes.get(caller)
        if entry is None:
            return 1, f"[{caller}] is not a registered node", 0
        if entry.uri != uri or not roles.remove(topic, entry):
            return 1, f"[{caller}] is not a known provider of [{topic}]", 0
        self.registrations.leave_if_empty(entry)
        return 1, f"Unregistered [{caller}] as provider of [{topic}]", 1

    def _notify_subscribers(self, topic: str) -> None:
        publishers = self.registrations.publisher_uris(topic)
        for uri in self.registrations.subscriber_uris(topic):
            self._notify(uri, "publisherUpdate", (CALLER, topic, publishers))

    def _notify_parameter(self, caller: str, key: str, value: Any) -> None:
        """Notify all subscribers of a parameter, except the caller itself."""
        subscribers = self.registrations.parameter_subscribers
        if not subscribers:
            return
        for watched, changed, now in changes(self.parameters, list(subscribers), key, value):
            for name in list(subscribers.get(watched, ())):
                node = self.registrations.nodes.get(name)
                if node is not None and name != caller:
                    self._notify(node.uri, "paramUpdate", (CALLER, changed, now))
