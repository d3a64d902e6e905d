"""Wait for a topic, and get its messages whatever their type."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from gazelle.errors import Error
from gazelle.ros import names
from gazelle.ros.errors import RosError
from gazelle.ros.messages import class_from_text, load_message
from gazelle.ros.names import ANY_TYPE
from gazelle.ros.node import Node
from gazelle.ros.raw import RawMessage
from gazelle.ros.tools.graph import Graph
from gazelle.ros.tools.listing import find_topic

_POLL_S = 0.1


def wait_for_topic(graph: Graph, name: str, stop: threading.Event) -> tuple[str, str, str] | None:
    """Topic, type and path that a name means, when there is such a topic; None if stopped."""
    wanted = graph.resolve(name)
    said = False
    while not stop.is_set():
        found = find_topic(graph, wanted)
        if found is not None and found[1] != ANY_TYPE:
            return found
        if not said:
            said = True
            sys.stderr.write(f"WARNING: topic [{wanted}] does not appear to be published yet\n")
        stop.wait(_POLL_S)
    return None


def tool_node(graph: Graph, **keywords: Any) -> Node:
    """A node for a tool, under a name of its own."""
    name = names.anonymous(graph.caller)
    return Node(name, master_uri=graph.master_uri, **keywords)


class Decoder:
    """Makes messages of bytes, with the definition that came with the connection.

    A type that is not installed is understood all the same.
    """

    def __init__(self) -> None:
        self._classes: dict[str, Any] = {}

    def decode(self, raw: RawMessage) -> Any:
        """The message.

        Raises:
            RosError: Its type is not known, and its definition did not come along.
        """
        header = raw._connection_header  # noqa: SLF001  # rospy's name
        checksum = header.get("md5sum", "")
        if checksum not in self._classes:
            self._classes[checksum] = self._class_of(header)
        return self._classes[checksum]().deserialize(raw._buff)  # noqa: SLF001  # rospy's name

    @staticmethod
    def _class_of(header: dict[str, str]) -> Any:
        kind, text = header.get("type", ""), header.get("message_definition", "")
        try:
            known = load_message(kind)
        except Error:
            known = None
        if known is not None and known._md5sum == header.get("md5sum"):  # noqa: SLF001  # genpy's name
            return known
        if not text:
            raise RosError(f"the type {kind} is not known here, nor did its definition come along")
        return class_from_text(kind, text)


class Pacer:
    """Calls something once a second until it is told to stop."""

    def __init__(self, stop: threading.Event) -> None:
        self._stop = stop

    def run(self, report: Callable[[], None]) -> None:
        """Call `report` each second."""
        due = time.monotonic() + 1.0
        while not self._stop.wait(max(0.0, due - time.monotonic())):
            due += 1.0
            report()
