"""Servers without free file descriptors, and peers that speak no WebSocket, are a line of the log."""

import contextlib
import os
import socket
import subprocess
import sys
import time

import pytest
from ports import free_port

from gazelle_ros import Master

OPEN_FILES = 40
GUESTS = 60


def flood(port, count):
    """Connect as often as a server's queue takes, and hang up."""
    with contextlib.ExitStack() as stack:
        for _ in range(count):
            guest = stack.enter_context(socket.create_connection(("127.0.0.1", port), timeout=20.0))
            guest.setblocking(False)
        time.sleep(2.5)  # asyncio tries again after a second


@pytest.mark.long
@pytest.mark.parametrize("words", ["bridge", "view empty", "view", "master"])
def test_a_server_without_file_descriptors_says_so_once(words, tmp_path):
    if words.startswith("view"):
        pytest.importorskip("viser", reason="the extra 'web' is not installed")
    port, said = free_port(), tmp_path / "said.txt"
    with Master(port=0, rosout=False) as master, said.open("w") as out:
        command = f'ulimit -n {OPEN_FILES}; exec "$0" -m gazelle {words} --port {port}'
        process = subprocess.Popen(
            ["/bin/sh", "-c", command, sys.executable],
            stdout=out,
            stderr=subprocess.STDOUT,
            env=os.environ | {"ROS_MASTER_URI": master.uri},
        )
        try:
            end = time.monotonic() + 120.0
            while "http://" not in said.read_text() and "ws://" not in said.read_text():
                assert process.poll() is None, said.read_text()
                assert time.monotonic() < end
                time.sleep(0.1)
            flood(port, GUESTS)
        finally:
            process.terminate()
            process.wait()
    text = said.read_text()
    assert "Traceback" not in text, text
    assert words == "master" or text.count("no free file descriptor") == 1, text
