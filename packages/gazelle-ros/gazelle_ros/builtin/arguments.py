"""The command line of a node: its own arguments, remappings, special keys, private parameters."""

from __future__ import annotations

import os
import sys
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from gazelle_ros import names
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.errors import MasterUnreachableError, NoMasterError
from gazelle_ros.node import Node

_MASTER_LOOK_S = 0.02
_END_LOOK_S = 0.2
_QUIET_S = 1.0
"""A master that was started at the same time is there by then [s]."""


@dataclass(slots=True)
class NodeArguments:
    """A node's command line, taken apart (http://wiki.ros.org/Remapping%20Arguments)."""

    plain: list[str]
    """Without remappings."""
    options: dict[str, Any]
    """Arguments of `Node`: ``name``, ``namespace``, ``remappings`` and so on."""
    parameters: dict[str, str] = field(default_factory=dict)
    """Private parameters, as YAML."""

    def start(self, *, rosout: bool = True, **keywords: Any) -> Node:
        """Start the node once there is a master, with its private parameters set.

        Args:
            rosout: Publish this process's warnings and log on ``/rosout``.
            keywords: More of what `Node` takes.
        """
        from gazelle_ros.launch.values import load_yaml
        from gazelle_ros.rosout_log import report_on_rosout

        node = self._join(**keywords)
        try:
            if rosout:
                report_on_rosout(node)
            for name, text in self.parameters.items():
                node.set_param(f"~{name}", load_yaml(text))
        except BaseException:
            node.close()  # so that a node that is ended while it begins is off the master, too
            raise
        return node

    def _join(self, **keywords: Any) -> Node:
        """Return the node; nodes of ROS wait for a master however long."""
        begin = time.monotonic()
        said = False
        while True:
            try:
                return Node(**self.options, **keywords)
            except NoMasterError:
                raise
            except MasterUnreachableError as error:
                if not said and time.monotonic() - begin > _QUIET_S:
                    said = True
                    sys.stderr.write(f"[WARN] {error.message}; waiting for it\n")
                time.sleep(_MASTER_LOOK_S)


def parse_arguments(
    arguments: Sequence[str], name: str, *, anonymous: bool = False
) -> NodeArguments:
    """Parse a command line.

    Args:
        arguments: Without the program.
        name: The node's name if the command line has none.
        anonymous: Make that name one that is unique.
    """
    plain, mappings = names.split_arguments(arguments)
    special = {key: value for key, value in mappings.items() if key.startswith("__")}
    options: dict[str, Any] = {
        "name": special.get("__name") or (names.anonymous(name) if anonymous else name),
        "namespace": special.get("__ns") or os.environ.get("ROS_NAMESPACE", "/"),
        "remappings": {key: value for key, value in mappings.items() if not key.startswith("_")},
    }
    if "__master" in special:
        options["master_uri"] = special["__master"]
    host = special.get("__hostname") or special.get("__ip")
    if host:
        options["host"] = host
    parameters = {
        key[1:]: value
        for key, value in mappings.items()
        if key.startswith("_") and not key.startswith("__")
    }
    return NodeArguments(plain, options, parameters)


class NodeWork(Protocol):
    """Work of a node."""

    def run(self, stop: threading.Event) -> None:
        """Run until shutdown."""


class CallbackWork:
    """Work that callbacks do.

    Args:
        node: On the graph.
    """

    def __init__(self, node: Node) -> None:
        self.node = node

    def run(self, stop: threading.Event) -> None:
        """Wait until shutdown."""
        # The node may have been shut down during its start, before there was a hook.
        while not self.node.closed and not stop.wait(_END_LOOK_S):
            pass


def run_node(
    arguments: Sequence[str],
    name: str,
    make: Callable[[Node], NodeWork],
    *,
    anonymous: bool = False,
) -> int:
    """Start a node, and do its work until Ctrl-C, SIGTERM, or until it is shut down; returns 0.

    Args:
        arguments: Command line without the program.
        name: The node's name if the command line has none.
        make: Makes the work from the node.
        anonymous: Make that name one that is unique.
    """
    found = parse_arguments(arguments, name, anonymous=anonymous)
    with found.start() as node, stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        make(node).run(stop)
    return 0


def spin(node: Node) -> int:
    """Wait until Ctrl-C, SIGTERM, or until the node is shut down; returns 0."""
    with stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        CallbackWork(node).run(stop)
    node.close()
    return 0
