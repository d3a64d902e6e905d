"""A master and nodes that end with their test."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest

import gazelle_ros.node as node_module
from gazelle_ros import Master, Node, load_message

FLOOD = """
import sys, time
from gazelle_ros import Node, load_message
node = Node("flood", master_uri=sys.argv[1])
queue = None if sys.argv[2] == "None" else int(sys.argv[2])
publisher = node.advertise("flood", load_message("std_msgs/String"), queue_size=queue)
while publisher.num_connections < 1: time.sleep(.001)
text = "x" * int(sys.argv[4])
for number in range(int(sys.argv[3])): publisher.publish(publisher.message_class(f"{number} {text}"))
print("sent", flush=True)
node.wait_closed()
"""


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
    """Hide nodes of this process from each other, so that they use sockets."""
    monkeypatch.setattr(node_module.Node, "neighbour", staticmethod(lambda uri: None))
    alone = staticmethod(lambda host, port, name: None)
    monkeypatch.setattr(node_module.Node, "neighbour_service", alone)


@pytest.fixture
def flood(master):
    """Start another process that publishes."""
    started = []

    def start(queue, number, size):
        arguments = [sys.executable, "-c", FLOOD, master.uri, str(queue), str(number), str(size)]
        started.append(subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True))
        return started[-1]

    yield start
    for process in started:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.fixture
def start(master, tmp_path):
    """Yield a function that starts a built-in node as a process."""
    made = []

    def run(package, kind, *arguments):
        command = [sys.executable, "-m", "gazelle_ros.builtin.start", package, kind, *arguments]
        env = os.environ | {"ROS_MASTER_URI": master.uri}
        made.append(
            subprocess.Popen(command, env=env, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
        )
        return made[-1]

    yield run
    for process in made:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
        try:
            assert process.wait(60) == 0
        finally:
            process.kill()
            process.stderr.close()


@pytest.fixture
def listen(make_node):
    """Yield a function that returns the messages of a topic as they come, Strings by default."""
    node = make_node("listener")

    def run(topic, kind=None):
        found = []
        node.subscribe(topic, kind or load_message("std_msgs/String"), found.append)
        return found

    return run
