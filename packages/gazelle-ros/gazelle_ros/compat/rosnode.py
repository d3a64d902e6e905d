"""rosnode's interface: nodes of the graph."""

from __future__ import annotations

import io
import sys
import threading
from collections.abc import Sequence
from typing import Any

from gazelle_ros.compat import commands
from gazelle_ros.compat.tool_errors import raising
from gazelle_ros.errors import MasterUnreachableError
from gazelle_ros.tools import nodes
from gazelle_ros.tools.graph import GraphInspector

ID = "/rosnode"


class ROSNodeException(Exception):  # noqa: N818  # rosnode's names
    """Root of the errors about nodes."""


class ROSNodeIOException(ROSNodeException):
    """The master does not answer."""


def _graph() -> GraphInspector:
    return GraphInspector("rosnode")


@raising(ROSNodeIOException)
def get_node_names(namespace: str | None = None) -> list[str]:
    """Return names of the nodes in a namespace.

    Raises:
        ROSNodeIOException: The master does not answer.
    """
    return _graph().nodes(namespace)


@raising(ROSNodeIOException)
def get_api_uri(master: Any, caller_id: str, skip_cache: bool = False) -> str | None:  # noqa: FBT001, FBT002  # rosnode's interface
    """Return the address of a node; None if there is none."""
    del master
    return _graph().node_uri(caller_id, fresh=skip_cache)


@raising(ROSNodeIOException)
def get_machines_by_nodes() -> list[str]:
    """Return names of the machines with nodes."""
    return nodes.machines(_graph())


@raising(ROSNodeIOException)
def get_nodes_by_machine(machine: str) -> list[str]:
    """Return names of the nodes of a machine."""
    return nodes.nodes_on(_graph(), machine)


def kill_nodes(node_names: list[str]) -> tuple[list[str], list[str]]:
    """Shut nodes down.

    Returns:
        Those that were requested, and those that could not be.
    """
    try:
        failed = nodes.kill(_graph(), node_names)
    except MasterUnreachableError:
        return [], list(node_names)
    return [name for name in node_names if name not in failed], failed


@raising(ROSNodeIOException)
def get_node_info_description(node_name: str) -> str:
    """Return a description of a node's publications, subscriptions and services."""
    return nodes.node_info(_graph(), node_name, quiet=True)


@raising(ROSNodeIOException)
def rosnode_info(node_name: str, quiet: bool = False) -> None:  # noqa: FBT001, FBT002  # rosnode's interface
    """Print what a node publishes, subscribes to and offers."""
    sys.stdout.write(nodes.node_info(_graph(), node_name, quiet=quiet))


@raising(ROSNodeIOException, ROSNodeIOException)
def rosnode_ping(
    node_name: str,
    max_count: int | None = None,
    verbose: bool = False,  # noqa: FBT001, FBT002  # rosnode's interface
    skip_cache: bool = False,  # noqa: FBT001, FBT002
) -> bool:
    """Ping a node once a second; return whether it answers.

    Raises:
        ROSNodeIOException: The master does not answer.
    """
    del skip_cache
    out = sys.stdout if verbose else io.StringIO()
    stop = threading.Event()
    return nodes.ping(_graph(), node_name, out, stop, count=max_count, complain=_complain)


@raising(ROSNodeIOException)
def rosnode_ping_all(
    verbose: bool = False,  # noqa: FBT001, FBT002  # rosnode's interface
    skip_cache: bool = False,  # noqa: FBT001, FBT002
) -> tuple[list[str], list[str]]:
    """Return nodes that answer, and nodes that do not."""
    del verbose, skip_cache
    graph = _graph()
    dead = nodes.dead_nodes(graph)
    return [name for name in graph.nodes() if name not in dead], dead


def _complain(text: str) -> None:
    sys.stderr.write(f"ERROR: {text}\n")


def cleanup_master_blacklist(master: Any, blacklist: list[str]) -> None:
    """Unregister nodes from the master."""
    del master
    nodes.unregister(_graph(), blacklist)


@raising(ROSNodeIOException)
def rosnode_listnodes(
    namespace: str | None = None,
    list_uri: bool = False,  # noqa: FBT001, FBT002  # rosnode's interface
    list_all: bool = False,  # noqa: FBT001, FBT002
) -> None:
    """Write the nodes to the screen."""
    uris = list_uri or list_all
    sys.stdout.write(nodes.list_nodes(_graph(), namespace, uris=uris, names=not list_uri))


def rosnodemain(argv: Sequence[str] | None = None) -> None:
    """Run rosnode's command line; see `gazelle_ros.compat.commands.run`.

    Args:
        argv: The command line, by default this process's.

    Raises:
        SystemExit: It failed.
    """
    commands.run("node", argv)
