"""Wait for a topic, and get its messages whatever their type."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from gazelle_ros import names
from gazelle_ros.names import ANY_TYPE
from gazelle_ros.node import Node
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.listing import closest_topic, find_topic

NODE_NAME = "GAZELLE_ROS_NODE"
"""Environment variable with the name that a tool's node is to have."""
_POLL_S = 0.1


def wait_for_topic(
    graph: GraphInspector, name: str, stop: threading.Event
) -> tuple[str, str, str] | None:
    """Return topic, type and path of a name, when there is such a topic; None if stopped."""
    resolved = graph.resolve(name)
    said = False
    while not stop.is_set():
        found = find_topic(graph, resolved)
        if found is not None and found[1] != ANY_TYPE:
            return found
        if not said:
            said = True
            sys.stderr.write(f"WARNING: topic [{resolved}] does not appear to be published yet\n")
            hint = closest_topic(graph, resolved)
            if hint is not None:
                sys.stderr.write(f"  hint: {hint}\n")
        stop.wait(_POLL_S)
    return None


def tool_node(graph: GraphInspector, **keywords: Any) -> Node:
    """Return a node for a tool, under the name of a launch file, else under one of its own."""
    given = os.environ.get(NODE_NAME)
    name = graph.resolve(given) if given else names.anonymous(graph.caller)
    return Node(name, master_uri=graph.master_uri, **keywords)


class PeriodicReport:
    """Calls something once a second until it is stopped."""

    def __init__(self, stop: threading.Event) -> None:
        self._stop = stop

    def run(self, report: Callable[[], None]) -> None:
        """Call `report` each second."""
        due = time.monotonic() + 1.0
        while not self._stop.wait(max(0.0, due - time.monotonic())):
            due += 1.0
            report()
