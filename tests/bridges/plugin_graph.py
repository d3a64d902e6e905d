"""A simulation of some models on a graph, and what a client of it does."""

from __future__ import annotations

import contextlib
import threading
import time
from types import SimpleNamespace

from graph_client import Client

import gazelle
from gazelle import formats
from gazelle.bridges import serve_ros
from gazelle_ros import Master, load_message


@contextlib.contextmanager
def running(*models, parameters=()):
    """Run a simulation of some models on a graph, in the background.

    Args:
        models: SDF.
        parameters: Names and values that are there before it.
    """
    text = f'<sdf version="1.6"><world name="w">{"".join(models)}</world></sdf>'
    with (
        Master(port=0, rosout=False) as master,
        gazelle.Simulation(formats.load_string(text)) as sim,
    ):
        client = Client(master.uri)
        for name, value in dict(parameters).items():
            client.node.set_param(name, value)
        with serve_ros(sim, master.uri) as server:
            thread = threading.Thread(target=server.run)
            thread.start()
            try:
                yield SimpleNamespace(sim=sim, client=client)
            finally:
                client.node.close()
                server.stop()
                thread.join()


def wait(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.01)
    assert condition()


def first(graph, topic, kind):
    heard = graph.client.listen(topic, kind)
    wait(lambda: heard)
    return heard[-1]


def send(graph, topic, kind, **fields):
    """Publish until somebody is there to hear."""
    message = load_message(kind)(**fields)
    publisher = graph.client.node.advertise(topic, type(message))
    wait(lambda: publisher.num_connections)
    publisher.publish(message)
    return publisher
