"""A Stage world on a graph of its own, stepped by the test, and a client beside it."""

import threading
from types import SimpleNamespace

import pytest
from ros.graph import until
from stage_samples import write

from gazelle.stage import StageSimulation
from gazelle.stage.bridge import serve_stage
from gazelle_ros import Master, Node, WallClock, load_message, load_service

SCANNER = (
    "define scanner ranger ( sensor ( range [0.1 8] fov 180 samples 181 ) )\n"
    'define robot position ( size [.4 .4 .4] drive "omni" scanner ( pose [.1 0 -.1 0] ) )\n'
)


class Stage:
    """The world, its server, and a client."""

    def __init__(self, sim, server, master):
        self.sim, self.server, self.master = sim, server, master
        self.interface = server.interface
        self.node = Node("client", master_uri=master.uri, clock=WallClock())
        self._publishers = {}

    def topics(self):
        """Return the type of each topic that the world publishes or subscribes to."""
        return dict(self.node.master.topic_types())

    def listen(self, topic, kind):
        """Return the list of a topic's messages from now on."""
        heard = []
        self.node.subscribe(topic, load_message(kind), heard.append)
        self.until(lambda: self.connected(topic))
        return heard

    def connected(self, topic):
        """Return whether the world has a subscriber on a topic."""
        return any(p.topic == topic and p.num_connections for p in self.server.node.publications())

    def send(self, topic, kind, **fields):
        """Publish one message, and wait until it had its effect."""
        if topic not in self._publishers:
            self._publishers[topic] = self.node.advertise(topic, load_message(kind), 10)
            self.until(lambda: self._publishers[topic].num_connections)
        message = load_message(kind)()
        for path, value in fields.items():
            *owners, name = path.split("__")
            target = message
            for owner in owners:
                target = getattr(target, owner)
            setattr(target, name, value)
        self._publishers[topic].publish(message)

    def call(self, service_name, kind, /, **fields):
        service = load_service(kind)
        return self.node.client(service_name, service).call(service._request_class(**fields))

    def step(self, heard=None, count=1):
        """Step; with a list of messages wait for the next one, and return it."""
        before = len(heard or ())
        self.sim.step(count)
        if heard is None:
            return None
        self.until(lambda: len(heard) >= before + count)
        return heard[-1]

    until = staticmethod(until)

    def close(self):
        self.node.close()


@pytest.fixture
def stage(tmp_path):
    """Yield a function that serves the world of a text on a graph."""
    open_things = []

    def make(text, params=None, **options):
        master = Master(port=0, rosout=False)
        open_things.append(master)
        if params:
            with_params = Node("setter", master_uri=master.uri, clock=WallClock())
            for name, value in params.items():
                with_params.set_param(f"/stageros/{name}", value)
            with_params.close()
        sim = StageSimulation(write(tmp_path, SCANNER + text), threads=1)
        server = serve_stage(sim.simulation, master.uri, **options)
        made = Stage(sim, server, master)
        open_things.extend((sim, server, made))
        return made

    yield make
    for thing in reversed(open_things):
        thing.close()


@pytest.fixture
def running():
    """Run a server in the background while a test is in a ``with`` block."""
    threads = []

    def start(server, seconds=None):
        thread = threading.Thread(target=server.run, args=(seconds,), daemon=True)
        thread.start()
        threads.append((server, thread))
        return SimpleNamespace(thread=thread)

    yield start
    for server, thread in threads:
        server.stop()
        thread.join(60)
