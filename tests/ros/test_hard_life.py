"""Slow, dying, restarting and lying neighbours."""

from __future__ import annotations

import logging
import resource
import socket
import struct
import threading
import time
from pathlib import Path

import pytest
from ports import free_port
from ros.graph import Flag, Text, Word, until

from gazelle_ros import Master, MasterProxy, Node, RawMessage, SimulatedClock, thread_pool
from gazelle_ros.clock import SECOND
from gazelle_ros.errors import (
    MasterUnreachableError,
    Md5MismatchError,
    NodeClosedError,
    RosError,
    RosTimeoutError,
    ServiceError,
    ServiceNotFoundError,
)
from gazelle_ros.tcpros import headers

DESCRIPTORS = Path("/proc/self/fd")


def test_a_callback_that_raises_is_reported_and_changes_nothing(make_node, caplog):
    talker, listener = make_node("talker"), make_node("listener")
    got = []

    def fail(message):
        got.append(message.data)
        raise ValueError("bad day")

    listener.subscribe("chatter", Text, fail)
    publisher = talker.advertise("chatter", Text)
    until(lambda: publisher.num_connections == 1)
    with caplog.at_level(logging.ERROR, "gazelle.ros"):
        for number in range(3):
            publisher.publish(Text(str(number)))
        until(lambda: len(got) == 3)
    until(lambda: caplog.text.count("bad callback of /chatter: bad day") == 3)


def test_callbacks_that_block_do_not_hold_up_others(make_node):
    talker, listener = make_node("talker"), make_node("listener")
    release = threading.Event()
    got, blocked = [], []

    def block(message):
        blocked.append(message)
        release.wait(120)

    for number in range(20):
        listener.subscribe(f"slow{number}", Text, block)
    listener.subscribe("fast", Text, got.append)
    slow = [talker.advertise(f"slow{number}", Text, latch=True) for number in range(20)]
    for publisher in slow:
        publisher.publish(Text("wait"))
    fast = talker.advertise("fast", Text)
    until(lambda: fast.num_connections == 1)
    until(lambda: len(blocked) == 20)
    for number in range(10):
        fast.publish(Text(str(number)))
        until(lambda number=number: len(got) == number + 1)
    release.set()


def test_a_callback_may_call_a_service_of_its_own_node(make_node):
    node = make_node("both")
    node.serve("flip", Flag, lambda request: (not request.data, ""))
    answers = []
    client = node.client("flip", Flag)
    node.subscribe("go", Word, lambda m: answers.append(client.call(Flag._request_class(False))))
    publisher = node.advertise("go", Word)
    until(lambda: publisher.num_connections == 1)
    for _ in range(30):
        publisher.publish(Word(1))
    until(lambda: len(answers) == 30)


def test_a_slow_subscriber_with_a_queue_gets_the_newest(make_node, strangers):
    talker, listener = make_node("talker"), make_node("listener")
    got, release = [], threading.Event()

    def slow(message):
        release.wait(120)
        got.append(int(message.data))

    listener.subscribe("chatter", Text, slow, queue_size=3)
    publisher = talker.advertise("chatter", Text, queue_size=1000)
    until(lambda: publisher.num_connections == 1)
    for number in range(500):
        publisher.publish(Text(str(number)))
    waiting = listener.subscription("/chatter")._queue.items
    until(lambda: waiting and b"499" in waiting[-1][1])
    release.set()
    until(lambda: got and got[-1] == 499)
    assert got == sorted(got)
    assert len(got) <= 5


def test_a_publisher_drops_the_oldest_for_a_subscriber_that_does_not_read(make_node):
    talker = make_node("talker")
    publisher = talker.advertise("big", Text, queue_size=4)
    fields = {"callerid": "/lazy", "topic": "/big", "type": "*", "md5sum": "*"}
    with socket.create_connection(("127.0.0.1", talker.tcpros_port)) as sock:
        sock.sendall(headers.encode(fields))
        until(lambda: publisher.num_connections == 1)
        for number in range(200):
            publisher.publish(Text(f"{number:06d}" + "x" * 200_000))
        sock.settimeout(60)
        stream = sock.makefile("rb")

        def frame():
            return stream.read(struct.unpack("<I", stream.read(4))[0])

        frame()
        got = []
        while not got or got[-1] != 199:
            got.append(int(frame()[4:10]))
        assert got[-4:] == [196, 197, 198, 199]
        assert got == sorted(got)
        assert len(got) < 200


@pytest.mark.parametrize("queue", [None, 100_000])
def test_nothing_is_lost_or_reordered_on_a_healthy_connection(make_node, flood, queue):
    got = []
    make_node("listener").subscribe("flood", Text, lambda m: got.append(int(m.data.split()[0])))
    flood(queue, 30_000, 20)
    until(lambda: len(got) == 30_000, timeout=300)
    assert got == list(range(30_000))


@pytest.mark.long
def test_a_flood_through_a_slow_subscriber_keeps_memory_flat(make_node, flood):
    seen = [0, 0]

    def slow(message):
        seen[0] += 1
        seen[1] += len(message.data)
        if seen[0] % 100 == 0:
            time.sleep(0.02)

    make_node("listener").subscribe("flood", Text, slow)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    flood(None, 2000, 200_000)
    until(lambda: seen[0] == 2000, timeout=300)
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert seen[1] > 400_000_000
    assert grown < 60_000, f"grew by {grown} kB for 400 MB of messages"


def test_a_publisher_killed_and_started_again_is_found(make_node, flood):
    got = []
    subscriber = make_node("listener").subscribe("flood", Text, got.append)
    for _ in range(3):
        process = flood(None, 10, 10)
        until(lambda: len(got) == 10)
        process.kill()
        until(lambda: subscriber.num_connections == 0)
        got.clear()


def test_nodes_survive_their_master():
    port = free_port()
    master = Master(port=port, rosout=False)
    talker, listener = (Node(name, master_uri=master.uri) for name in ("talker", "listener"))
    got = []
    listener.subscribe("chatter", Text, got.append)
    publisher = talker.advertise("chatter", Text)
    talker.serve("flip", Flag, lambda request: (True, ""))
    until(lambda: publisher.num_connections == 1)
    master.close()
    publisher.publish(Text("without a master"))
    until(lambda: len(got) == 1)
    with Master(port=port, rosout=False) as again:
        proxy = MasterProxy(again.uri, "/test")
        until(lambda: "/chatter" in proxy.system_state()[0])
        until(lambda: "/chatter" in proxy.system_state()[1])
        until(lambda: "/flip" in proxy.system_state()[2])
        publisher.publish(Text("with a new one"))
        until(lambda: len(got) == 2)
        # Whoever comes now finds them, too.
        late = Node("late", master_uri=again.uri)
        late.subscribe("chatter", Text, got.append)
        until(lambda: publisher.num_connections == 2)
        late.close()
        for node in (talker, listener):
            node.close()
        assert proxy.system_state() == ({}, {}, {})
        proxy.close()


def test_a_second_node_of_the_same_name_ends_the_first(make_node):
    first = make_node("same")
    first.advertise("a", Text)
    second = make_node("same")
    second.advertise("b", Text)
    assert first.wait_closed(60)
    assert not second.closed
    until(lambda: second.master.system_state()[0] == {"/b": ["/same"]})
    with pytest.raises(NodeClosedError):
        first.advertise("c", Text)


def test_two_types_on_a_topic_do_not_meet(make_node, strangers, caplog):
    talker, listener = make_node("talker"), make_node("listener")
    publisher = talker.advertise("chatter", Text)
    subscriber = listener.subscribe("chatter", Word, lambda message: None)
    time.sleep(0.3)
    assert publisher.num_connections == subscriber.num_connections == 0
    talker.subscribe("x", Text, print)
    with pytest.raises(Md5MismatchError, match="std_msgs/String"):
        talker.subscribe("x", Word, print)


@pytest.mark.parametrize("local", [True, False])
def test_raw_subscribers_get_bytes(make_node, local, request):
    if not local:
        request.getfixturevalue("strangers")
    talker, listener = make_node("talker"), make_node("listener")
    got = []
    listener.subscribe("chatter", RawMessage, got.append)
    publisher = talker.advertise("chatter", Text, latch=True)
    publisher.publish(Text("hi"))
    until(lambda: got)
    assert got[0]._buff == b"\2\0\0\0hi"
    assert got[0]._connection_header["type"] == "std_msgs/String"


def test_several_local_subscribers_get_copies(make_node):
    talker, one, two = make_node("talker"), make_node("one"), make_node("two")
    got = []
    one.subscribe("chatter", Text, got.append)
    two.subscribe("chatter", Text, got.append)
    publisher = talker.advertise("chatter", Text)
    until(lambda: publisher.num_connections == 2)
    message = Text("hi")
    publisher.publish(message)
    until(lambda: len(got) == 2)
    assert [m.data for m in got] == ["hi", "hi"]
    assert got[0] is not got[1]
    assert message not in got


def test_a_persistent_client_finds_the_next_server(make_node):
    first, second, client_node = make_node("first"), make_node("second"), make_node("client")
    first.serve("flip", Flag, lambda request: (True, "first"))
    client = client_node.client("flip", Flag, persistent=True)
    assert client.call(Flag._request_class()).message == "first"
    first.close()
    with pytest.raises(ServiceNotFoundError):
        client.call(Flag._request_class())
    second.serve("flip", Flag, lambda request: (True, "second"))
    assert client.call(Flag._request_class()).message == "second"


def test_service_calls_time_out(make_node):
    node = make_node("both")
    release = threading.Event()
    node.serve("slow", Flag, lambda request: release.wait(120) and (True, ""))
    with pytest.raises(RosTimeoutError):
        node.client("slow", Flag).call(Flag._request_class(), timeout=0.2)
    with pytest.raises(RosTimeoutError):
        node.wait_for_service("never", timeout=0.3)
    release.set()


def test_a_server_that_answers_nonsense_is_an_error(make_node):
    node = make_node("client")
    with socket.create_server(("127.0.0.1", 0)) as server:
        address = f"rosrpc://127.0.0.1:{server.getsockname()[1]}"
        node.master.register_service("/flip", address, "http://127.0.0.1:1/")
        for answer in (b"", b"\xff" * 50, headers.encode({"x": "y"}) + b"\1\xff\xff\xff\xff"):

            def serve(answer=answer):
                sock, _ = server.accept()
                with sock:
                    sock.recv(4096)
                    sock.sendall(answer)
                    time.sleep(0.05)

            thread = threading.Thread(target=serve)
            thread.start()
            with pytest.raises(ServiceError):
                node.client("flip", Flag).call(Flag._request_class(), timeout=60)
            thread.join()


@pytest.mark.long
def test_a_thousand_nodes_register(master):
    proxy = MasterProxy(master.uri, "/crowd")
    begin = time.monotonic()
    socks = []
    for number in range(1000):
        crowd = MasterProxy(master.uri, f"/n{number}")
        crowd.register_publisher(f"/t{number % 10}", Text._type, f"http://127.0.0.1:1/{number}")
        if number < 300:
            socks.append(crowd)  # its connection stays open
        else:
            crowd.close()
    assert time.monotonic() - begin < 60.0  # half a second on a quiet machine
    assert sum(len(nodes) for nodes in proxy.system_state()[0].values()) == 1000
    for crowd in socks:
        crowd.close()
    proxy.close()


def test_open_and_close_leaves_no_socket_and_no_thread(master):
    def count():
        return len(list(DESCRIPTORS.iterdir())), threading.active_count()

    def round_trip():
        with Node("short", master_uri=master.uri) as node:
            publisher = node.advertise("a", Text)
            subscriber = node.subscribe("a", Text, lambda message: None)
            node.serve("c", Flag, lambda request: (True, ""))
            node.client("c", Flag, persistent=True).call(Flag._request_class())
            until(lambda: subscriber.num_connections == 1)
            publisher.publish(Text("x"))
            subscriber.close()
            publisher.close()

    if not DESCRIPTORS.is_dir():
        pytest.skip("no /proc to count in")
    round_trip()
    time.sleep(0.1)
    before = count()
    for _ in range(20):
        round_trip()
    until(lambda: count()[0] <= before[0] + 1)
    until(lambda: count()[1] <= before[1] + thread_pool.MAX_IDLE)


def test_a_local_publisher_without_queue_waits_for_a_slow_subscriber(make_node):
    talker, listener = make_node("talker"), make_node("listener")
    got = []

    def slow(message):
        got.append(message.data)
        if len(got) % 500 == 0:
            time.sleep(0.02)

    listener.subscribe("chatter", Word, slow)
    publisher = talker.advertise("chatter", Word, queue_size=None)
    until(lambda: publisher.num_connections == 1)
    for number in range(20_000):
        publisher.publish(Word(number))
    until(lambda: len(got) == 20_000)
    assert got == list(range(20_000))


def test_statistics_tell_what_subscribers_measure(master, make_node, strangers):
    from gazelle_ros import load_message

    make_node("boss").set_param("/enable_statistics", True)
    make_node("boss2").set_param("/statistics_window_min_size", 0.2)
    clock = SimulatedClock()
    clock.set(SECOND)
    talker, listener = make_node("talker"), make_node("listener", clock=clock)
    got, reports = [], []
    listener.subscribe("chatter", Text, got.append)
    talker.subscribe("/statistics", load_message("rosgraph_msgs/TopicStatistics"), reports.append)
    publisher = talker.advertise("chatter", Text)
    until(lambda: publisher.num_connections == 1)
    until(lambda: listener.publication("/statistics").num_connections == 1)
    for number in range(21):
        publisher.publish(Text("1234"))
        until(lambda number=number: len(got) == number + 1)
        clock.set(clock.now() + SECOND // 100)
    until(lambda: reports)
    (report,) = reports
    assert (report.topic, report.node_pub, report.node_sub) == ("/chatter", "/talker", "/listener")
    assert report.delivered_msgs == 21
    assert report.traffic == report.delivered_msgs * 8
    assert report.period_mean.to_sec() == pytest.approx(0.01)


@pytest.mark.parametrize(
    "answer", [b"HTTP/1.0 501 No\r\n\r\n", b"HTTP/1.0 200 OK\r\n\r\n<p>hi</p>"]
)
def test_a_port_that_something_else_has_is_called_so(answer):
    with socket.create_server(("127.0.0.1", 0)) as taken:

        def serve():
            for _ in range(2):
                connection = taken.accept()[0]
                connection.recv(65536)
                connection.sendall(answer)
                connection.close()

        threading.Thread(target=serve, daemon=True).start()
        port = taken.getsockname()[1]
        with pytest.raises(MasterUnreachableError, match="is not a ROS master") as caught:
            Node("lost", master_uri=f"http://127.0.0.1:{port}")
        assert "--port 11312" in caught.value.hint
        with pytest.raises(RosError, match="not a ROS master has that port"):
            Master(port=port)
