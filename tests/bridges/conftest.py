"""A simulation on a graph of its own, and a client beside it."""

from __future__ import annotations

import threading
from types import SimpleNamespace

import pytest

import gazelle
from gazelle.bridges import serve_ros
from gazelle.ros import Master, Node, WallClock, load_message, load_service


class Client:
    """A node that calls services by short names."""

    def __init__(self, uri):
        self.node = Node("client", master_uri=uri, clock=WallClock())

    def call(self, name, kind, **fields):
        service = load_service(kind if "/" in kind else f"gazebo_msgs/{kind}")
        full = name if name.startswith("/") else f"/gazebo/{name}"
        return self.node.client(full, service).call(service._request_class(**fields))

    def listen(self, topic, kind):
        """The messages of a topic from now on, in a list."""
        heard = []
        self.node.subscribe(topic, load_message(kind), heard.append)
        return heard


@pytest.fixture
def graph():
    """A burger named r1 in stage 1, stepped by the test itself."""
    with Master(port=0, rosout=False) as master, gazelle.Simulation("turtlebot3_stage_1") as sim:
        sim.spawn("turtlebot3_burger", name="r1", namespace="/")
        with serve_ros(sim, master.uri) as door:
            client = Client(master.uri)
            yield SimpleNamespace(sim=sim, door=door, master=master, client=client)
            client.node.close()


@pytest.fixture
def running(graph):
    """The same, running in the background as fast as it can."""
    graph.sim.physics.update_rate = 0.0
    thread = threading.Thread(target=graph.door.run)
    thread.start()
    yield graph
    graph.door.stop()
    thread.join()
