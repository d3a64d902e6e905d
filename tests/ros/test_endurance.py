"""A lot of data, a lot of nodes, and a master that is killed."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from ports import free_port
from ros.graph import Flag, Text, until

from gazelle_ros import MasterProxy, Node
from gazelle_ros.errors import RosError

MASTER = "import sys; from gazelle_ros import run_master; run_master('127.0.0.1', int(sys.argv[1]))"


def resident():
    """Return memory of this process, in MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def pour(make_node, flood, number):
    """Send that many megabytes through a topic; returns how far memory rose after the first."""
    seen, levels = [0, 0], []

    def take(message):
        seen[0] += 1
        seen[1] += len(message._buff)
        if seen[0] % 100 == 0:
            levels.append(resident())

    make_node("listener").subscribe("flood", Text, take, raw=True)
    flood(None, number, 1_000_000)
    until(lambda: seen[0] == number, timeout=1200)
    assert seen[1] > number * 1_000_000
    return max(levels) - levels[0]


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc to look into")
@pytest.mark.long
@pytest.mark.parametrize(
    "gigabytes", [1, pytest.param(10, marks=[pytest.mark.slow, pytest.mark.timeout(1800)])]
)
def test_gigabytes_through_a_topic_leave_memory_flat(make_node, flood, gigabytes):
    assert pour(make_node, flood, gigabytes * 1000) < 40


@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="no /proc to look into")
def test_a_subscriber_that_never_reads_does_not_fill_the_publisher(make_node, strangers):
    talker, listener = make_node("talker"), make_node("listener")
    blocked, stop = threading.Event(), threading.Event()

    def block(_message):
        blocked.set()
        stop.wait(120)

    listener.subscribe("chatter", Text, block, queue_size=2)
    publisher = talker.advertise("chatter", Text, queue_size=2)
    until(lambda: publisher.num_connections == 1)
    message = Text("x" * 1_000_000)
    publisher.publish(message)
    assert blocked.wait(60)
    for _ in range(30):
        publisher.publish(message)
    before = resident()
    for _ in range(150):
        publisher.publish(message)
    assert resident() - before < 40
    stop.set()


def start_master(port):
    process = subprocess.Popen([sys.executable, "-c", MASTER, str(port)])
    proxy = MasterProxy(f"http://127.0.0.1:{port}", "/test")

    def answers():
        try:
            return bool(proxy.get_pid())
        except RosError:
            return False

    until(answers)
    proxy.close()
    return process


def test_nodes_come_back_to_a_master_that_was_killed():
    port = free_port()
    process = start_master(port)
    uri = f"http://127.0.0.1:{port}"
    got = []
    with Node("talker", master_uri=uri) as talker, Node("listener", master_uri=uri) as listener:
        publisher = talker.advertise("chatter", Text)
        listener.subscribe("chatter", Text, got.append)
        talker.serve("flip", Flag, lambda request: (True, ""))
        until(lambda: publisher.num_connections == 1)
        process.kill()
        process.wait()
        publisher.publish(Text("alone"))
        until(lambda: len(got) == 1)
        process = start_master(port)
        try:
            proxy = MasterProxy(uri, "/test")
            until(lambda: "/chatter" in proxy.system_state()[0])
            until(lambda: "/chatter" in proxy.system_state()[1])
            until(lambda: "/flip" in proxy.system_state()[2])
            proxy.close()
            publisher.publish(Text("together"))
            until(lambda: len(got) == 2)
        finally:
            process.terminate()
            process.wait()


@pytest.mark.long
def test_registering_is_quick_however_many_nodes_there_are(master):
    # Their ports are closed, as if all of them had been killed.
    proxy = MasterProxy(master.uri, "/late")
    for number in range(1000):
        crowd = MasterProxy(master.uri, f"/n{number}")
        crowd.register_subscriber("/t", Text._type, f"http://127.0.0.1:1/{number}")
        crowd.close()
    lasted = []
    for number in range(5):
        begin = time.monotonic()
        proxy.register_publisher("/t", Text._type, f"http://127.0.0.1:2/{number}")
        lasted.append(time.monotonic() - begin)
    assert min(lasted) < 10.0
    assert len(proxy.system_state()[1]["/t"]) == 1000
    proxy.close()
