"""A robot without a simulation, whose controllers are on a graph, and a client of theirs."""

import contextlib
from dataclasses import dataclass, field

from control.stand_in import Frictionless

from gazelle.bridges.control import HardwareLoop
from gazelle.control import ControllerManager
from gazelle_ros import Master, Node, load_message, load_service

KINDS = {
    "list_controllers": "ListControllers",
    "list_controller_types": "ListControllerTypes",
    "load_controller": "LoadController",
    "unload_controller": "UnloadController",
    "switch_controller": "SwitchController",
    "reload_controller_libraries": "ReloadControllerLibraries",
}


@dataclass
class ControlGraph:
    """What a test of controllers has."""

    node: Node
    manager: ControllerManager
    loop: HardwareLoop
    clients: dict = field(default_factory=dict)

    @property
    def space(self):
        return f"/{self.manager.namespace.strip('/')}".rstrip("/")

    def call(self, name, /, **fields):
        """Return the answer of one of the manager's services."""
        kind = load_service(f"controller_manager_msgs/{KINDS[name]}")
        if name not in self.clients:
            full = f"{self.space}/controller_manager/{name}"
            self.node.wait_for_service(full, timeout=30)
            self.clients[name] = self.node.client(full, kind, persistent=True)
        answer = self.clients[name].call(kind._request_class(**fields), timeout=30)
        return answer.ok if hasattr(answer, "ok") else answer

    def configure(self, name, kind, /, **parameters):
        self.node.set_param(f"{self.space}/{name}", {"type": kind, **parameters})

    def load(self, name, kind, /, **parameters):
        self.configure(name, kind, **parameters)
        return self.call("load_controller", name=name)

    def switch(self, start=(), stop=(), strictness=2, **more):
        return self.call(
            "switch_controller",
            start_controllers=list(start),
            stop_controllers=list(stop),
            strictness=strictness,
            **more,
        )

    def spawn(self, name, kind, /, **parameters):
        assert self.load(name, kind, **parameters)
        assert self.switch([name])

    @property
    def states(self):
        return {each.name: each.state for each in self.call("list_controllers").controller}

    def listen(self, topic, kind):
        """Return the list of received messages of a topic."""
        found = []
        self.node.subscribe(f"{self.space}/{topic}", load_message(kind), found.append)
        return found

    def talk(self, topic, kind):
        """Return a publisher of a topic, and the class of its messages."""
        message = load_message(kind)
        return self.node.advertise(f"{self.space}/{topic}", message, latch=True), message


@contextlib.contextmanager
def control_graph(hardware=None, *, namespace="", model=None, rate=200.0, run=True):
    """Yield a robot with an effort and a velocity joint, or another; its loop runs."""
    hardware = hardware or Frictionless({"Effort": ["hip", "knee"], "Velocity": ["left", "right"]})
    with (
        Master(port=0, rosout=False) as master,
        Node("robot", master_uri=master.uri) as robot,
        Node("client", master_uri=master.uri) as client,
    ):
        manager = ControllerManager(hardware, namespace=namespace, model=model)
        with HardwareLoop(robot, manager, rate) as loop:
            if run:
                loop.start()
            yield ControlGraph(client, manager, loop)
