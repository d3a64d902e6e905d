"""A master and nodes that end with their test."""

from __future__ import annotations

import pytest

import gazelle.ros.node as node_module
from gazelle.ros import Master, Node


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


@pytest.fixture
def make_node(master):
    made = []

    def make(name, **options):
        made.append(Node(name, master_uri=master.uri, **options))
        return made[-1]

    yield make
    for node in made:
        node.close()


@pytest.fixture
def strangers(monkeypatch):
    """Nodes of this process do not know of each other, and use sockets."""
    monkeypatch.setattr(node_module.Node, "neighbour", staticmethod(lambda uri: None))
