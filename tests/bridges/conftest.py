"""A simulation on a graph of its own, and a client beside it."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import pytest
from graph_client import Client

import gazelle
from gazelle.bridges import serve_ros
from gazelle_ros import Master


@pytest.fixture
def graph():
    """Yield a burger named r1 in stage 1, stepped by the test itself."""
    with Master(port=0, rosout=False) as master, gazelle.Simulation("turtlebot3_stage_1") as sim:
        sim.spawn("turtlebot3_burger", name="r1", namespace="/")
        with serve_ros(sim, master.uri) as server:
            client = Client(master.uri)
            yield SimpleNamespace(sim=sim, server=server, master=master, client=client)
            client.node.close()


@pytest.fixture
def running(graph):
    """Yield the same world, running in the background as fast as it can."""
    graph.sim.physics.update_rate = 0.0
    thread = threading.Thread(target=graph.server.run)
    thread.start()
    yield graph
    graph.server.stop()
    thread.join()
