"""Our nodes and master with a roscpp node."""

from __future__ import annotations

import logging
import select
import time

import pytest
from ros import real
from ros.graph import Flag, FlagResponse, Text, Word, until

from gazelle_ros import Node, Time, load_message
from gazelle_ros.errors import ServiceFailedError

# A C++ program is compiled for them.
pytestmark = [pytest.mark.ros, pytest.mark.long, real.needs_ros, pytest.mark.timeout(300)]


@pytest.mark.parametrize("nodelay", [False, True])
def test_we_hear_roscpp(start, node, nodelay):
    got = []
    node.subscribe("chatter", Text, got.append, tcp_nodelay=nodelay)
    start("talk", 5000).expect("sent")
    until(lambda: len(got) == 5000)
    assert [message.data for message in got] == [str(number) for number in range(5000)]
    header = got[0]._connection_header
    assert header["callerid"] == "/cpp"
    assert header["md5sum"] == Text._md5sum
    assert header["message_definition"].strip() == Text._full_text.strip()


def test_roscpp_hears_us(start, node):
    publisher = node.advertise("chatter", Text, queue_size=None)
    listener = start("listen")
    listener.expect("ready")
    until(lambda: publisher.num_connections == 1)
    for number in range(5000):
        publisher.publish(Text(str(number)))
    listener.expect(*(str(number) for number in range(5000)))
    real.stop(listener.process)
    until(lambda: publisher.num_connections == 0)


def test_large_messages_pass_both_ways(start, node):
    got = []
    publisher = node.advertise("chatter", Text, queue_size=None)
    listener = start("listen")
    listener.expect("ready")
    until(lambda: publisher.num_connections == 1)
    for _ in range(5):
        publisher.publish(Text("x" * 5_000_000))
    listener.expect(*["5000000 bytes"] * 5)
    real.stop(listener.process)
    publisher.close()
    node.subscribe("chatter", Text, lambda message: got.append(len(message.data)))
    start("talk", 5, 5_000_000).expect("sent")
    until(lambda: got == [5_000_001] * 5)


def test_latched_messages_come_late(start, node):
    publisher = node.advertise("chatter", Text, latch=True)
    publisher.publish(Text("one"))
    publisher.publish(Text("two"))
    listener = start("listen")
    listener.expect("ready", "two")
    real.stop(listener.process)
    publisher.close()
    start("talk-latched").expect("ready")
    message = node.wait_for_message("chatter", Text, timeout=60)
    assert message.data == "second"
    assert message._connection_header["latching"] == "1"


def test_a_talker_and_a_listener_of_roscpp_meet_on_our_master(start):
    listener = start("listen", "__name:=listener")
    listener.expect("ready")
    start("talk", 100).expect("sent")
    listener.expect(*(str(number) for number in range(100)))


def test_topics_of_other_types_are_refused_both_ways(start, node, caplog):
    got = []
    talker = start("talk-numbers")
    talker.expect("ready")
    with caplog.at_level(logging.WARNING):
        subscriber = node.subscribe("chatter", Text, got.append)
        until(lambda: "md5" in caplog.text.lower())
    assert subscriber.num_connections == 0
    subscriber.close()
    real.stop(talker.process)
    publisher = node.advertise("chatter", Word, latch=True)
    publisher.publish(Word(5))
    listener = start("listen")
    listener.expect("ready")
    time.sleep(1.0)  # it says nothing of being refused
    assert publisher.num_connections == 0
    assert not got


@pytest.mark.parametrize("persistent", [False, True])
def test_we_call_roscpp(start, node, persistent):
    start("serve").expect("ready")
    node.wait_for_service("flip", timeout=60)
    client = node.client("flip", Flag, persistent=persistent)
    for _ in range(200):
        answer = client.call(Flag._request_class(True))
        assert (answer.success, answer.message) == (True, "roscpp")
    with pytest.raises(ServiceFailedError):
        client.call(Flag._request_class(False))
    assert client.call(Flag._request_class(True)).success


@pytest.mark.parametrize("mode", ["call", "call-persistent"])
def test_roscpp_calls_us(start, node, mode):
    def handle(request):
        if not request.data:
            raise ServiceFailedError("not today")
        return FlagResponse(True, "ours")

    node.serve("flip", Flag, handle)
    caller = start(mode, 200)
    lines = []
    while not lines or "refused" not in lines[-1]:
        lines.append(caller.line())
        assert lines[-1], lines
    assert lines[-1].endswith("200 ours refused")
    assert any("not today" in line for line in lines)


def test_parameters_are_shared(start, node):
    shared = {
        "whole": -3,
        "real": 2.5,
        "word": "naïve text",
        "flag": True,
        "list": [1, 2, 30],
        "gains": {"p": 0.5, "i": 2.0},
    }
    node.set_param("/shared", shared)
    node.set_param("/gain", 1)
    sharer = start("share")
    sharer.expect("-3 2.5 naïve text 1 3 30 0.5 0", "1 /gain")
    until(lambda: node.has_param("/cpp/own"))
    assert node.get_param("/theirs") == {"list": ["x", "y"], "real": 0.25}
    assert node.get_param("/cpp/own") == 7
    until(lambda: not node.has_param("/shared/word"))


def test_roscpp_follows_a_parameter(start, node):
    node.set_param("/shared", {"list": [0]})
    sharer = start("share")
    sharer.line()
    sharer.line()
    for value in (5, 6, 0):
        node.set_param("/followed", value)
        sharer.expect(f"followed {value}")


def test_roscpp_sleeps_by_our_clock(start, node):
    clock = load_message("rosgraph_msgs/Clock")
    node.set_param("/use_sim_time", True)
    publisher = node.advertise("/clock", clock, queue_size=10)
    sleeper = start("sleep")
    sleeper.expect("ready")
    until(lambda: publisher.num_connections >= 1)
    # It may begin to sleep late: time goes on until it has slept.
    for second in range(100, 10_000):
        publisher.publish(clock(Time(second)))
        if select.select([sleeper.process.stdout], [], [], 0.01)[0]:
            break
    sleeper.expect("slept")


def test_we_sleep_by_the_clock_of_roscpp(start, graph, node):
    node.set_param("/use_sim_time", True)
    with Node("sleeper", master_uri=graph) as sleeper:
        assert sleeper.clock.simulated
        start("tick")
        assert sleeper.clock.sleep(50 * 10**9)
        assert sleeper.clock.now() >= 150 * 10**9


def test_real_tools_end_both_kinds_of_nodes(start, graph, node):
    node.advertise("chatter", Text)
    talker = start("talk-latched")
    talker.expect("ready")
    assert "killed" in real.tool(graph, "rosnode", "kill", "/cpp", "/ours")
    assert talker.process.wait(60) == 0
    assert node.wait_closed(60)
