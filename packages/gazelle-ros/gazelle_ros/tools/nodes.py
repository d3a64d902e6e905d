"""Nodes: their registrations, and whether they respond."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable, Sequence
from typing import TextIO
from urllib.parse import urlsplit

from gazelle_ros import net
from gazelle_ros.errors import ApiError, RosError, UnreachableError
from gazelle_ros.master.proxy import MasterProxy, value_of
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.graph import UNKNOWN_TYPE, GraphInspector
from gazelle_ros.xmlrpc.client import BlockingClient

_PATIENCE_S = 3.0
_DIRECTIONS = {"i": "inbound", "o": "outbound"}
_CONNECTION = re.compile(r"\w+ connection on port (\d+) to \[(.*?)(?: on socket (\d+))?\]")
_LINE = "-" * 80


def list_nodes(
    graph: GraphInspector, space: str | None = None, *, uris: bool = False, names: bool = True
) -> str:
    """Return nodes of a namespace, or all: names, addresses, or both, one a line."""
    lines = []
    for node in graph.nodes(space):
        if not uris:
            lines.append(node)
            continue
        uri = graph.node_uri(node) or "unknown address"
        lines.append(f"{uri} \t{node}" if names else uri)
    return "\n".join(lines) + "\n"


def node_info(graph: GraphInspector, name: str, *, quiet: bool = False) -> str:
    """Describe a node's publications, subscriptions and services, and its connections.

    Args:
        graph: The graph.
        name: The node.
        quiet: Do not ask the node itself.

    Raises:
        ToolError: There is no such node.
    """
    node = graph.resolve(name)
    uri = graph.node_uri(node)
    if uri is None:
        raise graph.unknown("node", node, graph.nodes())
    text = f"{_LINE}\n{_registrations(graph, node)}\n"
    if quiet:
        return text
    text += f"\ncontacting node {uri} ...\n"
    try:
        return text + _connections(graph, uri) + "\n"
    except (RosError, OSError) as error:
        return text + f"ERROR: Communication with node[{uri}] failed: {error}\n"


def _registrations(graph: GraphInspector, node: str) -> str:
    publishers, subscribers, services = graph.master.system_state()
    types = dict(graph.master.published_topics("/"))
    lines = [f"Node [{node}]"]
    for title, part in (("Publications", publishers), ("Subscriptions", subscribers)):
        topics = sorted(topic for topic, users in part.items() if node in users)
        lines.append(f"{title}: " if topics else f"{title}: None")
        lines += [f" * {topic} [{types.get(topic, UNKNOWN_TYPE)}]" for topic in topics]
        lines.append("")
    offered = sorted(name for name, users in services.items() if node in users)
    lines.append("Services: " if offered else "Services: None")
    lines += [f" * {name}" for name in offered]
    return "\n".join(lines) + "\n"


def _connections(graph: GraphInspector, uri: str) -> str:
    client = BlockingClient(uri, timeout=5.0)
    try:
        pid = value_of("getPid", client.call("getPid", graph.caller))
        buses = value_of("getBusInfo", client.call("getBusInfo", graph.caller))
    finally:
        client.close()
    lines = [f"Pid: {pid}"]
    if buses:
        lines.append("Connections:")
    for bus in buses:
        if len(bus) > 5 and not bus[5]:
            continue
        direction = _DIRECTIONS.get(str(bus[2]), "unknown")
        detail = _detail(str(bus[6])) if len(bus) > 6 else ""
        lines += [
            f" * topic: {bus[4]}",
            f"    * to: {_peer(graph, str(bus[1]), str(bus[4]))}",
            f"    * direction: {direction}{detail}",
            f"    * transport: {bus[3]}",
        ]
    return "\n".join(lines) + "\n"


def _detail(text: str) -> str:
    """Return ports and socket of a connection, from a node's description of it."""
    match = _CONNECTION.match(text)
    if match is None:
        return ""
    port, peer, sock = match.groups()
    return f" ({port} - {peer})" + (f" [{sock}]" if sock else "")


def _peer(graph: GraphInspector, peer: str, topic: str) -> str:
    """Return a peer, with its name where it is given by its address."""
    if not peer.startswith("http://"):
        return peer
    for part in graph.master.system_state()[:2]:
        for node in part.get(topic, ()):
            uri = graph.node_uri(node)
            if uri is not None and uri.rstrip("/") == peer.rstrip("/"):
                return f"{node} ({peer})"
    return peer


def machines(graph: GraphInspector) -> list[str]:
    """Return the hosts that nodes run on, sorted."""
    found = {urlsplit(graph.node_uri(node) or "").hostname for node in graph.nodes()}
    return sorted(host for host in found if host)


def nodes_on(graph: GraphInspector, machine: str) -> list[str]:
    """Return the nodes of a host, sorted.

    Raises:
        ToolError: The host is not known.
    """
    try:
        addresses = _addresses(machine)
    except OSError:
        raise ToolError(f"cannot resolve machine name [{machine}] to address") from None
    found = []
    for node in graph.nodes():
        host = urlsplit(graph.node_uri(node) or "").hostname
        if host is None:
            continue
        try:
            if host == machine or _addresses(host) & addresses:
                found.append(node)
        except OSError:
            continue
    return sorted(found)


def _addresses(host: str) -> set[str]:
    if host == "localhost":  # RFC 6761; a machine without /etc/hosts does not know it
        return {"127.0.0.1", "::1"}
    return set(net.addresses_of(host))


def kill(graph: GraphInspector, nodes: Sequence[str]) -> list[str]:
    """Request nodes to shut down; returns those that did not answer."""
    failed = []
    for node in nodes:
        uri = graph.node_uri(node, fresh=True)
        if uri is None:
            failed.append(node)
            continue
        client = BlockingClient(uri, timeout=_PATIENCE_S)
        try:
            client.call("shutdown", graph.caller, "user request")
        except (RosError, OSError):
            failed.append(node)
        finally:
            client.close()
    return failed


def ping(
    graph: GraphInspector,
    name: str,
    out: TextIO,
    stop: threading.Event,
    *,
    count: int | None = None,
    complain: Callable[[str], None],
) -> bool:
    """Call a node once a second and write how long it takes.

    Args:
        graph: The graph.
        name: The node.
        out: Gets the text.
        stop: Ends it.
        count: Number of times; None until `stop` is set.
        complain: Gets what goes wrong.

    Returns:
        Whether the node answered each time.
    """
    node = graph.resolve(name)
    uri = graph.node_uri(node, fresh=True)
    if uri is None:
        complain(f"cannot ping [{node}]: unknown node")
        return False
    out.write(f"pinging {node} with a timeout of {_PATIENCE_S}s\n")
    client = BlockingClient(uri, timeout=_PATIENCE_S)
    times: list[float] = []
    try:
        while not stop.is_set() and (count is None or len(times) < count):
            begin = time.perf_counter()
            value_of("getPid", client.call("getPid", graph.caller))
            times.append(1000.0 * (time.perf_counter() - begin))
            out.write(f"xmlrpc reply from {uri}\ttime={times[-1]:f}ms\n")
            out.flush()
            if count is None or len(times) < count:
                stop.wait(1.0)
    except (UnreachableError, ApiError, OSError) as error:
        complain(f"connection to [{node}] failed: {error}")
        return False
    finally:
        client.close()
    if len(times) > 1:
        out.write(f"ping average: {sum(times) / len(times):f}ms\n")
    return True


def process_of(graph: GraphInspector, node: str) -> int | None:
    """Return the number of a node's process; None if it does not answer."""
    uri = graph.node_uri(node, fresh=True)
    if uri is None:
        return None
    client = BlockingClient(uri, timeout=_PATIENCE_S)
    try:
        return int(value_of("getPid", client.call("getPid", graph.caller)))
    except (RosError, OSError):
        return None
    finally:
        client.close()


def alive(graph: GraphInspector, node: str) -> bool:
    """Return whether a node answers."""
    return process_of(graph, node) is not None


def dead_nodes(graph: GraphInspector) -> list[str]:
    """Return the nodes that are registered and do not answer, sorted."""
    return [node for node in graph.nodes() if not alive(graph, node)]


def unregister(graph: GraphInspector, nodes: Sequence[str]) -> None:
    """Unregister everything of some nodes from the master."""
    publishers, subscribers, services = graph.master.system_state()
    for node in nodes:
        uri = graph.node_uri(node, fresh=True)
        proxy = MasterProxy(graph.master_uri, node)
        try:
            for topic in [topic for topic, users in publishers.items() if node in users]:
                proxy.unregister_publisher(topic, uri or "")
            for topic in [topic for topic, users in subscribers.items() if node in users]:
                proxy.unregister_subscriber(topic, uri or "")
            for name in [name for name, users in services.items() if node in users]:
                address = graph.service_uri(name)
                if address is not None:
                    proxy.unregister_service(name, address)
        finally:
            proxy.close()
