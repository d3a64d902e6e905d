"""Nodes on their own master: topics, services and parameters within and between nodes."""

from __future__ import annotations

import threading

import pytest
from ports import free_port
from ros.graph import Flag, Text, Word, until

from gazelle_ros import Master, Node
from gazelle_ros.base.program import program_name
from gazelle_ros.errors import MasterUnreachableError, ServiceFailedError
from gazelle_ros.raw import RawMessage


def test_a_message_reaches_a_subscriber_as_the_same_object(make_node):
    talker, listener = make_node("talker"), make_node("listener")
    got = []
    listener.subscribe("chatter", Text, got.append)
    publisher = talker.advertise("chatter", Text)
    until(lambda: publisher.num_connections == 1)
    message = Text("hello")
    publisher.publish(message)
    until(lambda: got)
    assert got[0] is message


def test_a_message_goes_over_a_socket_when_the_nodes_are_not_neighbours(make_node, strangers):
    talker, listener = make_node("talker"), make_node("listener")
    got = []
    listener.subscribe("chatter", Text, got.append)
    publisher = talker.advertise("chatter", Text)
    until(lambda: publisher.num_connections == 1)
    for number in range(1000):
        publisher.publish(Text(str(number)))
        if number % 5 == 0:
            until(lambda number=number: len(got) > number - 5)
    until(lambda: len(got) == 1000)
    assert [message.data for message in got] == [str(number) for number in range(1000)]
    assert got[0]._connection_header["callerid"] == "/talker"


@pytest.mark.parametrize("apart", [False, True])
@pytest.mark.parametrize("latch", [False, True])
@pytest.mark.parametrize("raw_first", [False, True])
def test_subscribers_of_one_node_get_messages_and_bytes_as_each_asks(
    make_node, request, raw_first, latch, apart
):
    if apart:
        request.getfixturevalue("strangers")
    talker, listener = make_node("talker"), make_node("listener")
    publisher = talker.advertise("chatter", Text, latch=latch)
    got, bytes_, any_ = [], [], []
    wanted = [(Text, got, {}), (Text, bytes_, {"raw": True}), (RawMessage, any_, {})]
    for kind, heard, how in reversed(wanted) if raw_first else wanted:
        listener.subscribe("chatter", kind, heard.append, **how)
    until(lambda: publisher.num_connections == 1)
    publisher.publish(Text("hello"))
    late = []
    if latch:
        until(lambda: len(got) == len(bytes_) == len(any_) == 1)
        listener.subscribe("chatter", Text, late.append, raw=not raw_first)
    else:
        late = [None]
    until(lambda: len(got) == len(bytes_) == len(any_) == len(late) == 1)
    assert (type(got[0]), got[0].data) == (Text, "hello")
    assert bytes_[0]._buff == any_[0]._buff == b"\5\0\0\0hello"
    if latch and raw_first:
        assert late[0].data == "hello"
    elif latch:
        assert late[0]._buff == any_[0]._buff


@pytest.mark.parametrize("apart", [False, True])
def test_a_second_publisher_of_a_node_hears_of_subscribers_that_are_there(
    make_node, request, apart
):
    if apart:
        request.getfixturevalue("strangers")
    talker, listener = make_node("talker"), make_node("listener")
    got, peers, gone = [], [], []
    subscriber = listener.subscribe("chatter", Text, got.append)
    first = talker.advertise("chatter", Text, on_connect=peers.append)
    until(lambda: peers == ["/listener"])
    second = talker.advertise("chatter", Text, on_connect=peers.append, on_disconnect=gone.append)
    until(lambda: peers == ["/listener"] * 2)
    first.publish(Text("one"))
    second.publish(Text("two"))
    until(lambda: [message.data for message in got] == ["one", "two"])
    subscriber.close()
    until(lambda: gone == ["/listener"])
    assert len(peers) == 2


def test_a_service_answers(make_node):
    server, client = make_node("server"), make_node("client")
    server.serve("flip", Flag, lambda request: (not request.data, "flipped"))
    for persistent in (False, True):
        caller = client.client("flip", Flag, persistent=persistent)
        for value in (True, False, True):
            response = caller.call(Flag._request_class(value))
            assert (response.success, response.message) == (not value, "flipped")


def test_a_service_that_raises_tells_the_client(make_node):
    node = make_node("both")
    node.serve("bad", Flag, lambda request: 1 // 0)
    with pytest.raises(ServiceFailedError, match=r"error processing request: .*by zero"):
        node.client("bad", Flag).call(Flag._request_class(True))


def test_parameters_resolve_for_the_node(make_node):
    one, other = make_node("one", namespace="/ns"), make_node("other")
    one.set_param("~rate", {"x": 1})
    one.set_param("shared", [1, 2.5, "three", True])
    assert other.get_param("/ns/one/rate/x") == 1
    assert other.get_param("/ns/shared") == [1, 2.5, "three", True]
    assert one.search_param("shared") == "/ns/shared"
    assert other.get_param("/none", 5) == 5
    one.delete_param("~rate")
    assert not other.has_param("/ns/one/rate")


def test_a_closed_node_leaves_nothing(master):
    before = threading.active_count()
    node = Node("short", master_uri=master.uri)
    node.advertise("a", Text)
    node.subscribe("b", Text, lambda message: None)
    node.serve("c", Flag, lambda request: None)
    node.close()
    publishers, subscribers, services = node.master.system_state()
    assert "/short" not in str((publishers, subscribers, services))
    assert threading.active_count() <= before + 2


def test_without_a_master_the_error_says_what_to_do():
    with pytest.raises(MasterUnreachableError, match=f"{program_name()} master"):
        Node("lonely", master_uri="http://127.0.0.1:9/")


def test_the_last_message_of_a_latched_topic_comes_late(make_node):
    talker, listener = make_node("talker"), make_node("listener")
    publisher = talker.advertise("map", Text, latch=True)
    publisher.publish(Text("first"))
    publisher.publish(Text("second"))
    got = []
    listener.subscribe("map", Text, got.append)
    until(lambda: got)
    assert [message.data for message in got] == ["second"]


def test_wait_for_message(make_node):
    node = make_node("one")
    publisher = node.advertise("map", Word, latch=True)
    publisher.publish(Word(7))
    assert node.wait_for_message("map", Word, timeout=60.0).data == 7


def test_master_closes_its_port():
    port = free_port()
    for _ in range(2):
        Master(port=port, rosout=False).close()


@pytest.mark.parametrize(("given", "told"), [("debian", "debian\n"), ("", "noetic\n")])
def test_the_master_says_which_distribution_it_stands_for(monkeypatch, given, told):
    monkeypatch.setenv("ROS_DISTRO", given)
    with Master(port=0) as master, Node("asker", master_uri=master.uri) as node:
        assert node.get_param("/rosdistro") == told
