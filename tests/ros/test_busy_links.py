"""Connections with so much traffic that a worker of their own reads them."""

from __future__ import annotations

import re
import sys
import threading
import time

import pytest
from ros.graph import Flag, Text, Word, until

from gazelle_ros import loop as loops
from gazelle_ros.errors import ServiceError, ServiceFailedError, ServiceNotFoundError
from gazelle_ros.slave import SlaveApi

only_linux = pytest.mark.skipif(sys.platform != "linux", reason="only on Linux")


@pytest.fixture
def talk(make_node, strangers):
    """Return a publisher and its subscriber's messages."""
    talker, listener = make_node("talker"), make_node("listener")
    got = []
    subscriber = listener.subscribe("chatter", Word, lambda message: got.append(message.data))
    publisher = talker.advertise("chatter", Word, queue_size=None)
    until(lambda: publisher.num_connections == 1)
    return publisher, subscriber, got


def dedicated():
    return loops._shared.dedicated


def make_busy(publisher, got):
    """Send and wait for each message, as a conversation does."""
    deadline = time.monotonic() + 60
    while not dedicated():
        assert time.monotonic() < deadline, "the connection never became busy"
        count = len(got)
        publisher.publish(Word(count))
        while len(got) == count:
            assert time.monotonic() < deadline, "a message was lost"
            time.sleep(0)


@only_linux
def test_a_busy_connection_is_read_by_a_worker_and_given_back(talk):
    publisher, _, got = talk
    make_busy(publisher, got)
    until(lambda: not dedicated())
    count = len(got)
    publisher.publish(Word(count))
    until(lambda: len(got) == count + 1)
    for _ in range(3):
        make_busy(publisher, got)
        until(lambda: not dedicated())
    assert got == list(range(len(got)))


@only_linux
def test_a_busy_connection_can_be_closed_from_either_end(talk, make_node):
    publisher, subscriber, got = talk
    make_busy(publisher, got)
    subscriber.close()
    until(lambda: publisher.num_connections == 0)
    until(lambda: not dedicated())
    again = make_node("again")
    heard = []
    again.subscribe("chatter", Word, lambda message: heard.append(message.data))
    until(lambda: publisher.num_connections == 1)
    make_busy(publisher, heard)
    publisher.close()
    until(lambda: not dedicated())


@only_linux
def test_a_callback_of_a_busy_connection_that_blocks_holds_up_nobody(make_node, strangers):
    talker, listener = make_node("talker"), make_node("listener")
    got, other, release = [], [], threading.Event()

    def take(message):
        if message.data < 0:
            release.wait(120)
        got.append(message.data)

    listener.subscribe("chatter", Word, take, queue_size=3)
    listener.subscribe("other", Text, other.append)
    publisher, second = talker.advertise("chatter", Word), talker.advertise("other", Text)
    until(lambda: publisher.num_connections == second.num_connections == 1)
    make_busy(publisher, got)
    publisher.publish(Word(-1))
    time.sleep(0.05)
    for number in range(20):
        second.publish(Text(str(number)))
        until(lambda number=number: len(other) == number + 1)
    for number in range(1000, 1100):
        publisher.publish(Word(number))
    release.set()
    until(lambda: got[-1] == 1099)


@only_linux
def test_a_callback_of_a_busy_connection_may_close_it(make_node, strangers):
    talker, listener = make_node("talker"), make_node("listener")
    got = []

    def take(message):
        got.append(message.data)
        if message.data < 0:
            subscriber.close()

    subscriber = listener.subscribe("chatter", Word, take)
    publisher = talker.advertise("chatter", Word)
    until(lambda: publisher.num_connections == 1)
    make_busy(publisher, got)
    publisher.publish(Word(-1))
    until(lambda: publisher.num_connections == 0)
    until(lambda: not dedicated())


@only_linux
def test_busy_services_answer_in_order_and_end(make_node, strangers):
    server, caller = make_node("server"), make_node("caller")
    service = server.serve("flip", Flag, lambda request: (not request.data, "x" * 100))
    client = caller.client("flip", Flag, persistent=True)
    deadline = time.monotonic() + 60
    while not dedicated():
        assert time.monotonic() < deadline
        assert client.call(Flag._request_class(True)).success is False
        assert client.call(Flag._request_class(False)).success is True
    service.close()
    with pytest.raises(ServiceError):
        client.call(Flag._request_class(True))
    until(lambda: not dedicated())


def test_services_of_one_process_behave_as_over_a_socket(make_node):
    server, caller = make_node("server"), make_node("caller")
    seen = []

    def handle(request):
        seen.append((threading.get_ident(), request._connection_header["callerid"]))
        if request.data:
            raise ServiceError("not today")
        return True, "ok"

    service = server.serve("flip", Flag, handle)
    client = caller.client("flip", Flag, persistent=True)
    assert client.call(Flag._request_class()).message == "ok"
    assert seen == [(threading.get_ident(), "/caller")]
    with pytest.raises(ServiceFailedError, match="service cannot process request: not today"):
        client.call(Flag._request_class(True))
    # With a limit of time somebody else has to wait for the handler.
    assert client.call(Flag._request_class(), timeout=60).message == "ok"
    assert seen[-1][0] != threading.get_ident()
    service.close()
    with pytest.raises(ServiceNotFoundError):
        client.call(Flag._request_class())


def test_services_of_one_process_are_of_one_type(make_node):
    server, caller = make_node("server"), make_node("caller")
    server.serve("flip", Flag, lambda request: (True, ""))

    class Other(Flag):
        _md5sum = "0" * 32

    with pytest.raises(ServiceError, match="md5sums do not match"):
        caller.client("flip", Other).call(Flag._request_class())


def test_a_service_may_call_itself(make_node):
    node = make_node("both")
    client = node.client("flip", Flag, persistent=True)

    def handle(request):
        if request.data:
            return True, "outer " + client.call(Flag._request_class(False)).message
        return True, "inner"

    node.serve("flip", Flag, handle)
    assert client.call(Flag._request_class(True)).message == "outer inner"


def test_headers_of_a_publisher_go_over_the_wire(make_node, strangers):
    talker, listener = make_node("talker"), make_node("listener")
    got = []
    listener.subscribe("chatter", Text, got.append)
    publisher = talker.advertise("chatter", Text, latch=True, headers={"mood": "good"})
    publisher.publish(Text("hi"))
    until(lambda: got)
    assert got[0]._connection_header["mood"] == "good"
    assert got[0]._connection_header["callerid"] == "/talker"


def test_bus_info_names_ports_and_sockets(make_node, strangers, master):
    talker, listener = make_node("talker"), make_node("listener")
    listener.subscribe("chatter", Text, print)
    publisher = talker.advertise("chatter", Text)
    until(lambda: publisher.num_connections == 1)
    (out,) = SlaveApi(talker).get_bus_info("/test")[2]
    (into,) = SlaveApi(listener).get_bus_info("/test")[2]
    assert out[1:6] == ["/listener", "o", "TCPROS", "/chatter", True]
    assert into[1:6] == [talker.uri, "i", "TCPROS", "/chatter", True]
    pattern = r"TCPROS connection on port \d+ to \[127.0.0.1:\d+ on socket \d+\]"
    for each in (out, into):
        assert re.fullmatch(pattern, each[6])
