"""Service connections that end while their call is being answered."""

from __future__ import annotations

import socket
import struct
import threading
import time

import pytest
from ros.graph import until

from gazelle_ros import loop as loops
from gazelle_ros.limits import LIMITS
from gazelle_ros.tcpros.service_links import ServiceConnection

REQUEST = struct.pack("<I", 1) + b"x"


@pytest.fixture
def loop():
    loop = loops.acquire()
    yield loop
    loops.release(loop)


@pytest.mark.parametrize("persistent", ["0", "1"])
def test_a_worker_that_ends_while_the_connection_is_closed_leaves_no_handler(loop, persistent):
    """Else the next socket with that number is never watched, and a server takes nobody any more."""
    client, server = socket.socketpair()
    number = server.fileno()
    server.setblocking(False)
    asked, let_go = threading.Event(), threading.Event()

    def answer(_request, _fields):
        asked.set()
        let_go.wait(120)
        return b"\x01\0\0\0\0"

    def when_closing(_link):
        let_go.set()
        time.sleep(0.05)  # the worker finds that the connection is closed

    fields = {"callerid": "/client", "persistent": persistent}
    link = ServiceConnection(loop, server, fields, answer, LIMITS, when_closing)
    loop.run(lambda: link.start(b"", b""))
    client.send(REQUEST)
    assert asked.wait(60)
    loop.run(link.close)
    until(lambda: server.fileno() == -1)
    assert not loop.run(lambda: loop.watches(number))
    client.close()
