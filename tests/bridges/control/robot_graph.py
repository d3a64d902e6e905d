"""A simulated robot on a graph, with a client of its controllers."""

import contextlib
from types import SimpleNamespace

from bridges.control.control_graph import ControlGraph

import gazelle
from gazelle.bridges import serve_ros
from gazelle.description import World
from gazelle_ros import Master, Node


class RobotGraph(ControlGraph):
    """The same of a robot that is simulated."""

    def __init__(self, node, sim, server, namespace):
        super().__init__(node, SimpleNamespace(namespace=namespace), None)
        self.sim, self.server = sim, server


@contextlib.contextmanager
def robot_graph(*texts, parameters=(), namespace="/arm", world=None, start=True):
    """Run robots of URDF texts in an empty world on a graph."""
    with (
        Master(port=0, rosout=False) as master,
        Node("client", master_uri=master.uri) as client,
        gazelle.Simulation(world or World("w")) as sim,
    ):
        for name, value in dict(parameters).items():
            client.set_param(name, value)
        for text in texts:
            sim.spawn(gazelle.formats.load_model_string(text))
        with serve_ros(sim, master.uri) as server:
            if start:
                server.start()
            yield RobotGraph(client, sim, server, namespace)
