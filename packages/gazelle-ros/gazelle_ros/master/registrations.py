"""Registrations of publishers, subscribers and services; bookkeeping without a network."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle_ros.names import ANY_TYPE


@dataclass(slots=True)
class NodeEntry:
    """A node, and its registrations at the master."""

    name: str
    uri: str
    topics: dict[tuple[str, str], None] = field(default_factory=dict)
    """Pairs of role (``pub``, ``sub``) and topic."""
    services: dict[str, None] = field(default_factory=dict)
    parameters: dict[str, None] = field(default_factory=dict)

    def is_empty(self) -> bool:
        """Return True if nothing is registered any more."""
        return not (self.topics or self.services or self.parameters)


class Roles:
    """The nodes that have one role, by topic, in the order they came."""

    def __init__(self, role: str) -> None:
        self.role = role
        self._nodes: dict[str, dict[str, None]] = {}

    def __contains__(self, topic: str) -> bool:
        return topic in self._nodes

    def add(self, topic: str, node: NodeEntry) -> None:
        """Add `node` to the role for `topic`."""
        self._nodes.setdefault(topic, {})[node.name] = None
        node.topics[self.role, topic] = None

    def remove(self, topic: str, node: NodeEntry) -> bool:
        """Remove `node` from the role for `topic`; False if it did not have it."""
        names = self._nodes.get(topic)
        if names is None or node.name not in names:
            return False
        del names[node.name]
        if not names:
            del self._nodes[topic]
        node.topics.pop((self.role, topic), None)
        return True

    def names(self, topic: str) -> list[str]:
        """Return the nodes with the role for `topic`."""
        return list(self._nodes.get(topic, ()))

    def state(self) -> list[list[object]]:
        """Return all roles in the form of getSystemState."""
        return [[topic, list(names)] for topic, names in self._nodes.items()]

    def topics(self) -> list[str]:
        """Return the topics with a node in the role."""
        return list(self._nodes)


class Registrations:
    """Everything nodes registered.

    A node is dropped when it has nothing registered any more. A node that appears under a
    new URI replaces the old one of that name, with all its registrations.
    """

    def __init__(self) -> None:
        self.nodes: dict[str, NodeEntry] = {}
        self.publishers = Roles("pub")
        self.subscribers = Roles("sub")
        self.topic_types: dict[str, str] = {}
        self.services: dict[str, tuple[str, str]] = {}
        """Name to the node that serves it (the last one that said so) and its address."""
        self.parameter_subscribers: dict[str, dict[str, None]] = {}

    def enter(self, name: str, uri: str) -> tuple[NodeEntry, NodeEntry | None]:
        """Return the entry of a node, and the entry it replaced if the name had another URI."""
        entry = self.nodes.get(name)
        if entry is not None and entry.uri == uri:
            return entry, None
        if entry is not None:
            self._expel(entry)
        fresh = self.nodes[name] = NodeEntry(name, uri)
        return fresh, entry

    def find(self, name: str, uri: str) -> NodeEntry | None:
        """Return the node if it is known under that URI."""
        entry = self.nodes.get(name)
        return entry if entry is not None and entry.uri == uri else None

    def leave_if_empty(self, entry: NodeEntry) -> None:
        """Remove a node without registrations."""
        if entry.is_empty() and self.nodes.get(entry.name) is entry:
            del self.nodes[entry.name]

    def uris(self, names: list[str]) -> list[str]:
        """Return the URIs of the nodes of these names."""
        return [self.nodes[name].uri for name in names if name in self.nodes]

    def publisher_uris(self, topic: str) -> list[str]:
        """Return the URIs of the publishers of a topic."""
        return self.uris(self.publishers.names(topic))

    def subscriber_uris(self, topic: str) -> list[str]:
        """Return the URIs of the subscribers of a topic."""
        return self.uris(self.subscribers.names(topic))

    def note_publisher_type(self, topic: str, kind: str) -> None:
        """Set the type of the last publisher that names one."""
        if kind != ANY_TYPE or topic not in self.topic_types:
            self.topic_types[topic] = kind

    def note_subscriber_type(self, topic: str, kind: str) -> None:
        """Set a subscriber's type, unless the topic has one."""
        if kind != ANY_TYPE:
            self.topic_types.setdefault(topic, kind)

    def serve(self, service: str, address: str, entry: NodeEntry) -> None:
        """Set `entry` as the provider of `service`."""
        self.services[service] = (entry.name, address)
        entry.services[service] = None

    def stop_serving(self, service: str, address: str, entry: NodeEntry) -> bool:
        """Undo `serve`; False if another node or address took over."""
        current = self.services.get(service) == (entry.name, address)
        if current:
            del self.services[service]
        if self.services.get(service, ("", ""))[0] != entry.name:
            entry.services.pop(service, None)
        self.leave_if_empty(entry)
        return current

    def subscribe_parameter(self, key: str, entry: NodeEntry) -> None:
        """Subscribe `entry` to changes of `key`."""
        self.parameter_subscribers.setdefault(key, {})[entry.name] = None
        entry.parameters[key] = None

    def unsubscribe_parameter(self, key: str, entry: NodeEntry) -> bool:
        """Undo `subscribe_parameter`; False if there was nothing to undo."""
        names = self.parameter_subscribers.get(key)
        if names is None or entry.name not in names:
            return False
        del names[entry.name]
        if not names:
            del self.parameter_subscribers[key]
        entry.parameters.pop(key, None)
        return True

    def _expel(self, entry: NodeEntry) -> None:
        roles = {"pub": self.publishers, "sub": self.subscribers}
        for role, topic in list(entry.topics):
            roles[role].remove(topic, entry)
        for service in entry.services:
            if self.services.get(service, ("", ""))[0] == entry.name:
                del self.services[service]
        for key in list(entry.parameters):
            self.unsubscribe_parameter(key, entry)
        del self.nodes[entry.name]
