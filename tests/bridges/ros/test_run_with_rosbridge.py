"""rosbridge beside a simulation: ``gazelle run --rosbridge``."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys

import pytest
from ros.rosbridge.conftest import JsonClient

from gazelle_ros import Master


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


@pytest.fixture
def start(tmp_path):
    made = []

    def run(*words, **env):
        command = [sys.executable, "-m", "gazelle", *map(str, words)]
        process = subprocess.Popen(
            command, env=os.environ | env, cwd=tmp_path, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        made.append(process)
        return process

    yield run
    for process in made:
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=60)
        finally:
            process.kill()


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
    assert "add --ros" in said
