"""A rosbridge server on a graph, and clients that end with their test."""

from __future__ import annotations

import json

import pytest
from websockets.sync.client import connect

from gazelle_ros import Master, Node
from gazelle_ros.rosbridge.rosapi import RosApi
from gazelle_ros.rosbridge.server import BridgeServer
from gazelle_ros.rosbridge.settings import BridgeSettings

PATIENCE_S = 60


@pytest.fixture(scope="module")
def graph():
    """Yield a master that the tests of a module share; each test uses names of its own."""
    with Master(port=0, rosout=False) as master:
        yield master


@pytest.fixture(scope="module")
def bridge(graph):
    settings = BridgeSettings(port=0, unregister_timeout=0.05)
    with (
        Node("rosbridge_websocket", master_uri=graph.uri) as node,
        BridgeServer(node, settings) as server,
        Node("rosapi", master_uri=graph.uri) as api,
        RosApi(api, settings),
    ):
        yield server


@pytest.fixture(scope="module")
def robot(graph):
    """Yield another node of the graph."""
    with Node("robot", master_uri=graph.uri) as node:
        yield node


class JsonClient:
    """A WebSocket client that speaks JSON."""

    def __init__(self, port, **options):
        self.socket = connect(f"ws://127.0.0.1:{port}", **options)

    def say(self, op, **fields):
        self.socket.send(json.dumps({"op": op, **fields}))

    def hear(self):
        data = self.socket.recv(timeout=PATIENCE_S)
        return json.loads(data) if isinstance(data, str) else data

    def ask(self, op, **fields):
        """Send a message, and return the next answer."""
        self.say(op, **fields)
        return self.hear()

    def call(self, service, args=None, **fields):
        return self.ask("call_service", service=service, args=args or {}, **fields)

    def settled(self):
        """Wait until the server has done all that was said."""
        answer = self.call("/rosapi/get_time", id="settled")
        assert answer["id"] == "settled", answer


@pytest.fixture
def client(bridge):
    made = JsonClient(bridge.port)
    yield made
    made.socket.close()


@pytest.fixture
def another(bridge):
    made = JsonClient(bridge.port)
    yield made
    made.socket.close()
