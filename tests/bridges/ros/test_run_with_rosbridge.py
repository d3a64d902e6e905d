"""rosbridge beside a simulation: ``gazelle run --rosbridge``."""

from __future__ import annotations

import re
import signal

import pytest
from ros.graph import started
from ros.rosbridge.conftest import JsonClient

from gazelle_ros import Master


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


@pytest.fixture
def start(tmp_path):
    with started(["-m", "gazelle"], tmp_path) as run:
        yield run


@pytest.mark.long
@pytest.mark.parametrize("world", ["empty", "fleet"])
def test_gazelle_run_with_rosbridge(start, master, world):
    process = start("run", world, "--ros", "--rosbridge", 0, ROS_MASTER_URI=master.uri)
    lines = iter(process.stdout.readline, "")
    found = next(filter(None, (re.search(r"ws://127\.0\.0\.1:(\d+)", line) for line in lines)))
    client = JsonClient(int(found.group(1)))
    client.say("subscribe", topic="/clock")
    assert client.hear()["topic"] == "/clock"
    client.socket.close()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130


def test_rosbridge_needs_a_graph(start):
    process = start("run", "empty", "--rosbridge")
    said, _ = process.communicate(timeout=60)
    assert process.returncode == 2
    assert "requires --ros" in said
