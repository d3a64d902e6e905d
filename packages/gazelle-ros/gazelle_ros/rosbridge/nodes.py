"""The nodes ``rosbridge_websocket`` and ``rosapi_node``."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.net import is_loopback
from gazelle_ros.node import Node
from gazelle_ros.rosbridge.rosapi import RosApi
from gazelle_ros.rosbridge.server import BridgeServer
from gazelle_ros.rosbridge.settings import BridgeSettings, read_settings


def websocket_main(arguments: Sequence[str]) -> int:
    """Run a rosbridge server until Ctrl-C; returns the exit code."""
    found = parse_arguments(arguments, "rosbridge_websocket")
    with found.start() as node:
        settings = read_settings(node, found.plain)
        server = _listen(node, settings)
        if server is None:
            return 0
        with server:
            node.set_param("~actual_port", server.port)
            sys.stderr.write(f"{listening_text(settings, server.port)}\n")
            return spin(node)


@contextmanager
def bridge(settings: BridgeSettings, master_uri: str | None = None) -> Iterator[BridgeServer]:
    """Run both nodes in this process, for as long as the block lasts.

    Args:
        settings: Settings of the server.
        master_uri: Of the graph; ``ROS_MASTER_URI``'s if None.

    Raises:
        RosError: The port is taken, or no master answers.
    """
    with (
        Node("rosbridge_websocket", master_uri=master_uri) as node,
        BridgeServer(node, settings) as server,
        Node("rosapi", master_uri=master_uri) as api,
        RosApi(api, settings),
    ):
        yield server


def rosapi_main(arguments: Sequence[str]) -> int:
    """Serve rosapi until Ctrl-C; returns the exit code."""
    found = parse_arguments(arguments, "rosapi_node")
    with found.start() as node, RosApi(node, read_settings(node, found.plain)):
        return spin(node)


def listening_text(settings: BridgeSettings, port: int) -> str:
    """Describe the address it listens on, and its reach."""
    scheme = "wss" if settings.certfile else "ws"
    text = f"Rosbridge WebSocket server started at {scheme}://{settings.address}:{port}"
    if is_loopback(settings.address):
        return text
    return f"{text}; every machine that reaches this one can use the graph through it"


def _listen(node: Node, settings: BridgeSettings) -> BridgeServer | None:
    """Return the server once its port is free; None if the node is to end first."""
    while True:
        try:
            return BridgeServer(node, settings)
        except RosError as error:
            pause = settings.retry_startup_delay
            if not pause:
                raise
            sys.stderr.write(f"[WARN] {error.message}; trying again in {pause:g} s\n")
        with stopping() as stop:
            until = time.monotonic() + pause
            while time.monotonic() < until:
                if node.closed or stop.wait(min(0.2, pause)):
                    return None
