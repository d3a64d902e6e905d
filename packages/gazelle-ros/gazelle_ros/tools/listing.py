"""Topics with their types, publishers and subscribers."""

from __future__ import annotations

from typing import TextIO
from urllib.parse import urlsplit

from gazelle_ros import names
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.messages import load_message
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import parse_path, type_at
from gazelle_ros.tools.graph import UNKNOWN_TYPE, GraphInspector, Uses


def list_topics(
    graph: GraphInspector,
    out: TextIO,
    space: str | None = None,
    *,
    verbose: bool = False,
    publishers: bool = True,
    subscribers: bool = True,
    by_host: bool = False,
) -> None:
    """Write the topics of a namespace, or all.

    Args:
        graph: The graph.
        out: Gets the text.
        space: A namespace, or a topic.
        verbose: Write types and numbers of nodes too.
        publishers: List what is published.
        subscribers: List what is subscribed to.
        by_host: Group by the machines of the nodes.
    """
    published, subscribed = graph.uses()
    if space:
        topic = graph.resolve(space)
        published, subscribed = _below(published, topic), _below(subscribed, topic)
    flags = {"publishers": publishers, "subscribers": subscribers, "verbose": verbose}
    if not by_host:
        _write_topics(out, published, subscribed, "", **flags)
        return
    hosts_out, hosts_in = _by_host(graph, published), _by_host(graph, subscribed)
    for host in sorted({*hosts_out, *hosts_in}):
        outgoing, incoming = hosts_out.get(host, []), hosts_in.get(host, [])
        if (outgoing and publishers) or (incoming and subscribers):
            out.write(f"Host [{host}]:\n")
            _write_topics(out, outgoing, incoming, "  ", **flags)


def _below(uses: Uses, topic: str) -> Uses:
    space = names.as_namespace(topic)
    return [each for each in uses if each[0] == topic or each[0].startswith(space)]


def _by_host(graph: GraphInspector, uses: Uses) -> dict[str, Uses]:
    found: dict[str, dict[str, tuple[str, str, list[str]]]] = {}
    for topic, kind, nodes in uses:
        for node in nodes:
            host = urlsplit(graph.node_uri(node) or "").hostname or "unknown"
            entry = found.setdefault(host, {}).setdefault(topic, (topic, kind, []))
            entry[2].append(node)
    return {host: list(topics.values()) for host, topics in found.items()}


def _write_topics(
    out: TextIO,
    published: Uses,
    subscribed: Uses,
    indent: str,
    *,
    publishers: bool,
    subscribers: bool,
    verbose: bool,
) -> None:
    if not verbose:
        topics = {topic for topic, _, _ in published if publishers}
        topics |= {topic for topic, _, _ in subscribed if subscribers}
        out.write("\n".join(indent + topic for topic in sorted(topics)) + "\n")
        return
    if publishers:
        out.write(f"\n{indent}Published topics:\n")
        _write_uses(out, published, indent, "publisher")
    if subscribers:
        out.write(f"{indent}\n{indent}Subscribed topics:\n")
        _write_uses(out, subscribed, indent, "subscriber")
    out.write("\n")


def _write_uses(out: TextIO, uses: Uses, indent: str, role: str) -> None:
    for topic, kind, nodes in uses:
        plural = "s" if len(nodes) > 1 else ""
        out.write(f"{indent} * {topic} [{kind}] {max(1, len(nodes))} {role}{plural}\n")


def topic_info(graph: GraphInspector, topic: str) -> str:
    """Return type, publishers and subscribers of a topic.

    Raises:
        ToolError: It is unused.
    """
    name = graph.resolve(topic)
    uses = graph.uses()
    if not any(each[0] == name for part in uses for each in part):
        known = {each[0] for part in uses for each in part}
        raise graph.unknown("topic", name, known)
    lines = [f"Type: {graph.types().get(name, UNKNOWN_TYPE)}", ""]
    for title, part in zip(("Publishers", "Subscribers"), uses, strict=True):
        nodes = [node for topic_, _, users in part if topic_ == name for node in users]
        lines.append(f"{title}: " if nodes else f"{title}: None")
        lines += [f" * {node} ({_address(graph, node)})" for node in nodes]
        lines.append("")
    return "\n".join(lines) + "\n"


def _address(graph: GraphInspector, node: str) -> str:
    return graph.node_uri(node) or f"unknown address {node}"


def find_topic(graph: GraphInspector, name: str) -> tuple[str, str, str] | None:
    """Resolve a name: a topic, or a topic and a path of fields in its messages.

    Returns:
        Topic, type, and path (empty, or beginning with a slash); None if there is none.
    """
    types = graph.types()
    if name in types:
        return name, types[name], ""
    matches = sorted((topic for topic in types if name.startswith(topic + "/")), reverse=True)
    for topic in matches:
        path = name[len(topic) :]
        if _may_have(types[topic], path):
            return topic, types[topic], path
    return None


def _may_have(kind: str, path: str) -> bool:
    """Return whether messages of a type have the fields of a path; true if the type is not known."""
    from gazelle_ros.base.errors import Error

    try:
        message_class = load_message(kind)
    except Error:
        return True
    try:
        type_at(message_class, parse_path(path))
    except Error:
        return False
    return True


def closest_topic(graph: GraphInspector, name: str) -> str | None:
    """Return a hint for a missing topic: one with a similar name, or with such fields."""
    types = graph.types()
    for topic, kind in types.items():
        if name.startswith(f"{topic}/") and not _may_have(kind, name.removeprefix(topic)):
            return f"the topic {topic} is there, but {kind} has no {name.removeprefix(topic)[1:]}"
    hint = did_you_mean(name, types)
    return hint if hint.startswith("did you mean") else None


def topic_type(graph: GraphInspector, name: str) -> str:
    """Return the type of a topic.

    For a field of its messages, the type, the field and the field's type.

    Raises:
        ToolError: It is unused.
    """
    resolved = graph.resolve(name)
    found = find_topic(graph, resolved)
    if found is None:
        raise ToolError(f"unknown topic type [{resolved}]", hint=closest_topic(graph, resolved))
    _, kind, path = found
    if not path:
        return kind
    return f"{kind} {path[1:]} {type_at(load_message(kind), parse_path(path))}"


def topics_of_type(graph: GraphInspector, kind: str) -> list[str]:
    """Return the topics of a type, sorted."""
    return sorted(topic for topic, each in graph.types().items() if each == kind)
