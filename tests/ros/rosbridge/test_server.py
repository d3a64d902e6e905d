"""rosbridge over real sockets, spoken by hand."""

from __future__ import annotations

import json
import math
import threading

import cbor2
import numpy as np
import pytest
from ros.graph import until
from ros.rosbridge.conftest import JsonClient
from websockets.exceptions import ConnectionClosed, InvalidStatus

from gazelle_ros import Node, load_message, load_service
from gazelle_ros.base.errors import RosError
from gazelle_ros.errors import ServiceError
from gazelle_ros.rosbridge.fragments import text_of_png
from gazelle_ros.rosbridge.server import BridgeServer
from gazelle_ros.rosbridge.settings import BridgeSettings, read_settings

STRING = load_message("std_msgs/String")
SCAN = load_message("sensor_msgs/LaserScan")


def listen(robot, topic, kind=STRING):
    got = []
    robot.subscribe(topic, kind, got.append)
    return got


def connected(publisher, count=1):
    until(lambda: publisher.num_connections >= count)


def test_a_client_publishes(robot, client):
    got = listen(robot, "/from_client")
    client.say("advertise", topic="/from_client", type="std_msgs/String")
    for word in ("one", "two"):
        client.say("publish", topic="/from_client", msg={"data": word})
    until(lambda: len(got) == 2)  # though it was published right after it was advertised
    assert [message.data for message in got] == ["one", "two"]


def test_a_client_publishes_where_others_do_without_advertising(robot, client):
    got = listen(robot, "/known")
    client.say("publish", topic="/known", msg={"data": "x"})
    until(lambda: got)
    answer = client.ask("publish", id="p", topic="/unknown", msg={"data": "x"})
    assert (answer["op"], answer["level"], answer["id"]) == ("status", "error", "p")
    assert "Cannot infer topic type" in answer["msg"]


def test_a_latched_topic_greets_who_comes_late(robot, client):
    client.say("advertise", topic="/latched", type="std_msgs/String", latch=True, queue_size=1)
    client.say("publish", topic="/latched", msg={"data": "kept"})
    client.settled()
    got = listen(robot, "/latched")
    until(lambda: got)


def test_a_topic_goes_after_its_last_client(robot, bridge, client, another):
    topics = lambda: dict(robot.master.published_topics())  # noqa: E731
    for each in (client, another):
        each.say("advertise", topic="/shared", type="std_msgs/String")
        each.settled()
    client.say("unadvertise", topic="/shared")
    client.settled()
    assert "/shared" in topics()
    another.socket.close()
    until(lambda: "/shared" not in topics())


def test_a_client_subscribes(robot, client):
    publisher = robot.advertise("/scan", SCAN)
    client.say("subscribe", topic="/scan")
    client.settled()
    connected(publisher)
    publisher.publish(SCAN(ranges=[1.5, math.inf], angle_min=-1.0))
    message = client.hear()
    assert (message["op"], message["topic"]) == ("publish", "/scan")
    assert message["msg"]["ranges"] == [1.5, None]
    assert message["msg"]["header"]["stamp"] == {"secs": 0, "nsecs": 0}


def test_a_second_client_gets_what_is_latched(robot, client, another):
    publisher = robot.advertise("/map_like", STRING, latch=True)
    publisher.publish(STRING("walls"))
    for each in (client, another):
        assert each.ask("subscribe", topic="/map_like")["msg"] == {"data": "walls"}


def test_cbor_carries_typed_arrays(robot, client):
    publisher = robot.advertise("/cbor_scan", SCAN)
    client.say("subscribe", topic="/cbor_scan", compression="cbor")
    client.settled()
    connected(publisher)
    publisher.publish(SCAN(ranges=[1.5, math.inf]))
    found = cbor2.loads(client.hear())
    assert found["topic"] == "/cbor_scan"
    ranges = found["msg"]["ranges"]
    assert ranges.tag == 85  # RFC 8746: float32, little endian
    assert np.frombuffer(ranges.value, "<f4").tolist() == [1.5, math.inf]


def test_cbor_raw_carries_the_bytes(robot, client):
    publisher = robot.advertise("/raw_scan", SCAN)
    client.say("subscribe", topic="/raw_scan", compression="cbor-raw")
    client.settled()
    connected(publisher)
    publisher.publish(SCAN(ranges=[1.5]))
    found = cbor2.loads(client.hear())["msg"]
    assert found["secs"] > 0
    assert SCAN().deserialize(found["bytes"]).ranges == (1.5,)


def test_png_and_fragments_carry_the_same_text(robot, client, another):
    publisher = robot.advertise("/long", STRING)
    client.say("subscribe", topic="/long", compression="png")
    another.say("subscribe", topic="/long", fragment_size=100)
    for each in (client, another):
        each.settled()
    connected(publisher)
    publisher.publish(STRING("é" * 500))
    png = client.hear()
    assert png["op"] == "png"
    assert json.loads(text_of_png(png["data"], 10_000))["msg"]["data"] == "é" * 500
    first = another.hear()
    rest = [another.hear() for _ in range(first["total"] - 1)]
    text = "".join(each["data"] for each in (first, *rest))
    assert json.loads(text)["msg"]["data"] == "é" * 500


def test_fragments_and_pngs_of_a_client_are_put_together(robot, client):
    from gazelle_ros.rosbridge.fragments import split_text, text_as_png

    got = listen(robot, "/pieces")
    text = json.dumps({"op": "publish", "topic": "/pieces", "msg": {"data": "x" * 300}})
    for piece in split_text(text, 50, "7"):
        client.socket.send(piece)
    client.say("png", data=text_as_png(text))
    until(lambda: len(got) == 2)
    assert {message.data for message in got} == {"x" * 300}


def test_subscriptions_end_by_id_or_all_at_once(robot, client):
    publisher = robot.advertise("/by_id", STRING)
    for identifier in ("a", "b"):
        client.say("subscribe", id=identifier, topic="/by_id")
    client.settled()
    connected(publisher)
    client.say("unsubscribe", id="a", topic="/by_id")
    client.settled()
    publisher.publish(STRING("still"))
    assert client.hear()["msg"]["data"] == "still"
    client.say("unsubscribe", topic="/by_id")
    client.settled()
    until(lambda: publisher.num_connections == 0)


def test_a_client_calls_a_service(robot, client):
    kind = load_service("roscpp_tutorials/TwoInts")
    robot.serve("/add", kind, lambda request: [request.a + request.b])
    for args in ({"a": 2, "b": 3}, [2, 3]):
        answer = client.call("/add", args, id="sum")
        assert answer == {
            "op": "service_response", "service": "/add", "values": {"sum": 5}, "result": True,
            "id": "sum",
        }  # fmt: skip


@pytest.mark.parametrize(
    ("service", "args", "said"),
    [
        ("/nowhere", {}, "nowhere"),
        ("/fails", {}, "it broke"),
        ("/takes_two", {"a": "x"}, "requires a int64"),
        ("/takes_two", [1, 2, 3], "2 fields"),
    ],
)
def test_a_call_that_fails_says_why(robot, client, service, args, said):
    def fail(_request):
        raise ServiceError("it broke")

    if robot.service("/fails") is None:
        robot.serve("/fails", load_service("std_srvs/Empty"), fail)
        robot.serve("/takes_two", load_service("roscpp_tutorials/TwoInts"), lambda _: [0])
    client.say("call_service", service=service, args=args, id=1)
    status, answer = client.hear(), client.hear()
    assert (status["op"], status["level"], status["id"]) == ("status", "error", 1)
    assert (answer["result"], answer["id"]) == (False, 1)
    assert said in answer["values"]
    assert said in status["msg"]


def test_a_client_answers_a_service(robot, client):
    kind = load_service("roscpp_tutorials/TwoInts")
    client.say("advertise_service", service="/client_adds", type="roscpp_tutorials/TwoInts")
    client.settled()
    found = []
    caller = threading.Thread(
        target=lambda: found.append(
            robot.client("/client_adds", kind).call(kind._request_class(a=1, b=2))
        )
    )
    caller.start()
    request = client.hear()
    assert (request["op"], request["args"]) == ("call_service", {"a": 1, "b": 2})
    client.say(
        "service_response", service="/client_adds", id=request["id"], values={"sum": 3}, result=True
    )
    caller.join(60)
    assert found[0].sum == 3


@pytest.mark.parametrize("how", ["result", "misfit", "leave", "unadvertise"])
def test_a_client_that_does_not_answer_fails_the_call(robot, bridge, how):
    client = JsonClient(bridge.port)
    service = f"/deaf_{how}"
    kind = load_service("roscpp_tutorials/TwoInts")
    client.say("advertise_service", service=service, type="roscpp_tutorials/TwoInts")
    client.settled()
    errors = []

    def call():
        try:
            robot.client(service, kind).call(kind._request_class())
        except ServiceError as error:
            errors.append(str(error))

    caller = threading.Thread(target=call)
    caller.start()
    request = client.hear()
    answer = {"service": service, "id": request["id"]}
    if how == "result":
        client.say("service_response", **answer, values="no", result=False)
    elif how == "misfit":
        client.say("service_response", **answer, values={"sum": "three"}, result=True)
        assert "requires a int64" in client.hear()["msg"]
    elif how == "unadvertise":
        client.say("unadvertise_service", service=service)
    if how != "leave":
        caller.join(60)
    client.socket.close()
    caller.join(60)
    assert len(errors) == 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "not valid JSON"),
        ("[" * 100_000, "not valid JSON"),
        ("[]", "not a JSON object"),
        ("{}", "without an op"),
        ('{"op": "publsh"}', "did you mean 'publish'"),
        ('{"op": 5}', "Unknown operation"),
        ('{"op": "subscribe"}', "Expected a topic field"),
        ('{"op": "subscribe", "topic": 5}', "to be a string"),
        ('{"op": "subscribe", "topic": "/t", "type": "no_such/Type"}', "no_such"),
        (
            '{"op": "subscribe", "topic": "/t", "type": "std_msgs/String", "compression": "zip"}',
            "cbor-raw",
        ),
        ('{"op": "subscribe", "topic": "/t", "throttle_rate": -1}', "not below zero"),
        ('{"op": "subscribe", "topic": "/t", "queue_length": 1.5}', "to be a int"),
        ('{"op": "subscribe", "topic": "a b", "type": "std_msgs/String"}', "a b"),
        ('{"op": "advertise", "topic": "/t"}', "Expected a type field"),
        ('{"op": "advertise", "topic": "/rosout_like", "type": "std_msgs/Strin"}', "String"),
        ('{"op": "unadvertise_service", "service": "/none"}', "has not been advertised"),
        (
            '{"op": "service_response", "service": "/none", "result": true}',
            "has not been advertised",
        ),
        ('{"op": "set_level", "level": "loud"}', "loud"),
        ('{"op": "fragment", "id": "x", "data": "", "num": 2, "total": 1}', "is invalid"),
        ('{"op": "png", "data": "abcd"}', "not a PNG"),
        ('{"op": "auth", "mac": "x"}', "does not support authentication"),
    ],
)
def test_what_is_wrong_is_said(client, text, said):
    client.socket.send(text)
    answer = client.hear()
    assert (answer["op"], answer["level"]) == ("status", "error")
    assert said in answer["msg"]


def test_binary_messages_are_refused_in_words(client):
    client.socket.send(b"\0\1")
    assert "send JSON" in client.hear()["msg"]


def test_types_that_differ_are_refused(robot, client):
    robot.advertise("/typed", STRING)
    for op in ("subscribe", "advertise"):
        answer = client.ask(op, topic="/typed", type="std_msgs/Int32")
        assert "already established with type std_msgs/String" in answer["msg"]


def test_levels_of_status(robot, client):
    assert "does not support authentication" in client.ask("auth")["msg"]
    client.say("set_level", level="none")
    client.say("auth")
    client.settled()
    client.say("set_level", level="info")
    answer = client.ask("advertise", topic="/told", type="std_msgs/String", id="x")
    assert answer == {"op": "status", "level": "info", "msg": "Advertised /told", "id": "x"}
    assert client.ask("unadvertise", topic="/never")["level"] == "warning"


def test_who_is_there(graph, robot):
    """On a bridge of its own, as sockets of other tests are closed whenever Python does so."""
    got = listen(robot, "/own/client_count", load_message("std_msgs/Int32"))
    with (
        Node("own_bridge", master_uri=graph.uri, namespace="/own") as node,
        BridgeServer(node, BridgeSettings(port=0)) as server,
    ):
        first = JsonClient(server.port)
        until(lambda: got and got[-1].data == 1)
        second = JsonClient(server.port)
        until(lambda: got[-1].data == 2)
        second.socket.close()
        until(lambda: got[-1].data == 1)
        first.socket.close()
        until(lambda: got[-1].data == 0)


def test_a_slow_client_holds_nobody_up(robot, bridge, client):
    kind = load_message("std_msgs/UInt8MultiArray")
    publisher = robot.advertise("/big", kind, queue_size=1000)
    asleep = JsonClient(bridge.port, max_queue=1)
    for each in (asleep, client):
        each.say("subscribe", topic="/big", compression="cbor")
        each.settled()
    connected(publisher)
    for number in range(60):
        publisher.publish(kind(data=bytes([number]) * 1_000_000))
        message = cbor2.loads(client.hear())
        assert message["msg"]["data"][0] == number  # while the other takes nothing
    # The one that slept gets the newest, though not all.
    got = []
    while not got or got[-1] != 59:
        got.append(cbor2.loads(asleep.hear())["msg"]["data"][0])
    assert got == sorted(got)
    assert len(got) < 60
    asleep.socket.close()


# Who may connect, and settings ---------------------------------------------------------------


@pytest.mark.parametrize(
    ("origin", "host", "allowed"),
    [
        (None, "127.0.0.1:9090", True),
        ("http://localhost:8080", "localhost:9090", True),
        ("http://127.0.0.1", "localhost:9090", True),
        ("null", "localhost:9090", False),  # a sandboxed frame of any page
        ("NULL", "localhost:9090", False),
        ("file://", "localhost:9090", False),
        ("", "localhost:9090", False),
        ("http://localhost@evil.example", "localhost:9090", False),
        ("http://localhost.evil.example", "localhost:9090", False),
        ("https://evil.example", "localhost:9090", False),
        ("https://evil.example", "evil.example:9090", False),  # DNS rebinding
        ("http://192.168.1.7:8000", "192.168.1.7:9090", True),
        ("http://192.168.1.8", "192.168.1.7:9090", False),
        ("https://robots.example.org", "192.168.1.7:9090", True),
        ("rubbish", "", False),
    ],
)
def test_which_pages_may_connect(origin, host, allowed):
    from gazelle_ros.rosbridge.origins import may_connect

    settings = BridgeSettings(allowed_origins=["https://*.example.org"])
    assert may_connect(origin, host, settings) is allowed


@pytest.mark.parametrize(
    ("given", "allowed"),
    [
        ({"allowed_origins": "[null]"}, True),
        ({"websocket_null_origin": "true"}, True),
        ({"allowed_origins": "[*]"}, False),  # not by its name
        ({"websocket_null_origin": "false"}, False),
    ],
)
def test_a_page_without_an_origin_connects_only_if_that_is_allowed_by_name(given, allowed):
    from gazelle_ros.rosbridge.origins import may_connect

    assert may_connect("null", "localhost:9090", BridgeSettings(**given)) is allowed


def test_a_page_from_elsewhere_is_turned_away(bridge):
    with pytest.raises(InvalidStatus, match="403"):
        JsonClient(bridge.port, origin="https://evil.example")
    with pytest.raises(InvalidStatus, match="403"):
        JsonClient(bridge.port, origin="null")
    JsonClient(bridge.port, origin="http://localhost:8000").socket.close()


def test_limits_and_patterns(graph):
    settings = BridgeSettings(
        port=0,
        max_incoming_bytes=1000,
        max_clients=1,
        topics_glob="[/open*]",
        services_glob="[/open*]",
    )
    with (
        Node("limited", master_uri=graph.uri, namespace="/limits") as node,
        BridgeServer(node, settings) as server,
    ):
        client = JsonClient(server.port)
        assert "topics_glob" in client.ask("subscribe", topic="/closed", type="x/Y")["msg"]
        assert "services_glob" in client.call("/closed")["msg"]
        with pytest.raises(InvalidStatus, match="503"):
            JsonClient(server.port)
        client.say("publish", topic="/open", msg={"data": "x" * 2000})
        with pytest.raises(ConnectionClosed):
            client.hear()
        with pytest.raises(RosError, match="cannot listen"):
            BridgeServer(node, BridgeSettings(port=server.port))


def test_settings_come_from_parameters_and_words(graph):
    with Node("told", master_uri=graph.uri) as node:
        for name, value in {
            "port": 9091, "max_message_size": "None", "topics_glob": "['/a', /b*]", "address": "",
            "authenticate": False, "bson_only_mode": False, "websocket_external_port": "None",
        }.items():  # fmt: skip
            node.set_param(f"~{name}", value)
        settings = read_settings(node, ["--port", "0", "--unregister_timeout", "2.5"])
        assert (settings.port, settings.unregister_timeout) == (0, 2.5)
        assert settings.topics_glob == ("/a", "/b*")
        assert settings.address == "0.0.0.0"
        assert settings.max_message_size is None
        for words, said in (
            (["--prot", "1"], "not an option"),
            (["--port"], "without a value"),
            (["--port", "x"], "must be a number"),
            (["--authenticate"], "authenticated"),
            (["--bson_only_mode"], "BSON"),
            (["--topics_glob", "/a"], "must be a list"),
            (["--certfile", "x"], "both"),
        ):
            with pytest.raises(RosError, match=said):
                read_settings(node, words)
