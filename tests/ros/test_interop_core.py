"""Our nodes and master with real rospy nodes, real roscore and real tools."""

from __future__ import annotations

import logging
import signal
import time

import pytest
from ports import free_port
from ros import real
from ros.graph import Flag, FlagResponse, Text, Word, until

from gazelle_ros import Master, MasterProxy, Node
from gazelle_ros.errors import ServiceFailedError

pytestmark = [pytest.mark.ros, real.needs_ros]

LISTENER = """
rospy.init_node("real_listener")
rospy.Subscriber("chatter", String, lambda m: say(m._connection_header["callerid"], m.data))
say("ready"); rospy.spin()
"""
TALKER = """
rospy.init_node("real_talker")
p = rospy.Publisher("chatter", String, queue_size=1000, latch=len(sys.argv) > 1)
if len(sys.argv) > 1: p.publish("latched")
while p.get_num_connections() < 1 and not rospy.is_shutdown(): time.sleep(.01)
for i in range(300): p.publish(str(i)); time.sleep(.001)
say("sent"); rospy.spin()
"""
SERVER = """
rospy.init_node("real_server")
def handle(r):
    if not r.data: raise rospy.ServiceException("no")
    return SetBoolResponse(True, "real")
rospy.Service("flip", SetBool, handle); say("ready"); rospy.spin()
"""
CLIENT = """
rospy.init_node("real_client"); rospy.wait_for_service("flip", 60)
for persistent in (False, True):
    p = rospy.ServiceProxy("flip", SetBool, persistent=persistent)
    for v in (True, True):
        r = p(v); say(r.success, r.message)
    try: p(False)
    except rospy.ServiceException as e: say(e)
"""


@pytest.fixture(
    params=["our master", pytest.param("real roscore", marks=pytest.mark.long)]  # it takes a second
)
def graph(request):
    """Yield the URI of a master of either kind."""
    if request.param == "our master":
        with Master(port=0) as running:
            yield running.uri
    else:
        with real.master() as uri:
            yield uri


@pytest.fixture
def node(graph):
    with Node("ours", master_uri=graph) as made:
        yield made


def test_a_real_node_hears_ours(graph, node):
    publisher = node.advertise("chatter", Text, queue_size=None)
    with real.RealNode(graph, LISTENER) as listener:
        listener.expect("ready")
        until(lambda: publisher.num_connections == 1)
        for number in range(500):
            publisher.publish(Text(str(number)))
        listener.expect(*(f"/ours {number}" for number in range(500)))
    until(lambda: publisher.num_connections == 0)


def test_ours_hears_a_real_node(graph, node):
    got = []
    node.subscribe("chatter", Text, got.append)
    with real.RealNode(graph, TALKER) as talker:
        talker.expect("sent")
        until(lambda: len(got) == 300)
    assert [message.data for message in got] == [str(number) for number in range(300)]
    assert got[0]._connection_header["callerid"] == "/real_talker"
    assert got[0]._connection_header["type"] == "std_msgs/String"


@pytest.mark.long
def test_latched_messages_come_late_both_ways(graph, node):
    publisher = node.advertise("chatter", Text, latch=True)
    publisher.publish(Text("one"))
    publisher.publish(Text("two"))
    with real.RealNode(graph, LISTENER) as listener:
        listener.expect("ready", "/ours two")
    publisher.close()
    with real.RealNode(graph, TALKER, "latch"):
        time.sleep(1.0)
        assert node.wait_for_message("chatter", Text, timeout=60).data == "latched"


def test_ours_calls_a_real_service(graph, node):
    with real.RealNode(graph, SERVER) as server:
        server.expect("ready")
        node.wait_for_service("flip", timeout=60)
        for persistent in (False, True):
            client = node.client("flip", Flag, persistent=persistent)
            for _ in range(3):
                assert client.call(Flag._request_class(True)).message == "real"
            with pytest.raises(ServiceFailedError, match="service cannot process request: no"):
                client.call(Flag._request_class(False))
            assert client.call(Flag._request_class(True)).success


def test_a_real_node_calls_our_service(graph, node):
    def handle(request):
        if not request.data:
            raise ServiceFailedError("not today")
        return FlagResponse(True, "ours")

    node.serve("flip", Flag, handle)
    with real.RealNode(graph, CLIENT) as client:
        refusal = (
            "service [/flip] responded with an error: b'service cannot process request: not today'"
        )
        client.expect(*(["True ours", "True ours", refusal] * 2))


def test_parameters_are_shared(graph, node):
    value = {"a": [1, 2.5, "three", True], "deep": {"er": -7}}
    node.set_param("/shared", value)
    with real.RealNode(
        graph, 'rospy.set_param("/theirs", {"x": [1, "y"]}); say(rospy.get_param("/shared"))'
    ) as reader:
        reader.expect(str(value))
        reader.process.wait(60)
    assert node.get_param("/theirs") == {"x": [1, "y"]}


def test_a_followed_parameter_changes(graph, node):
    assert node.parameters.get_cached("/followed", 1) == 1
    real.tool(graph, "rosparam", "set", "/followed", "5")
    until(lambda: node.parameters.get_cached("/followed", None) == 5)
    real.tool(graph, "rosparam", "delete", "/followed")
    until(lambda: node.parameters.get_cached("/followed", None) is None)


@pytest.mark.long
def test_real_tools_see_our_nodes(graph, node):
    node.advertise("chatter", Text, latch=True).publish(Text("hello"))
    node.serve("flip", Flag, lambda request: (request.data, "x"))
    assert "/chatter" in real.tool(graph, "rostopic", "list").split()
    assert "Publishers: \n * /ours" in real.tool(graph, "rostopic", "info", "/chatter")
    assert 'data: "hello"' in real.tool(graph, "rostopic", "echo", "-n1", "/chatter")
    assert "/flip [std_srvs/SetBool]" in real.tool(graph, "rosnode", "info", "/ours") or (
        " * /flip" in real.tool(graph, "rosnode", "info", "/ours")
    )
    assert "xmlrpc reply from" in real.tool(graph, "rosnode", "ping", "-c1", "/ours")
    assert real.tool(graph, "rosservice", "type", "/flip").strip() == "std_srvs/SetBool"
    assert 'message: "x"' in real.tool(graph, "rosservice", "call", "/flip", "true")


def test_rosnode_kill_ends_our_node(graph, node):
    reasons = []
    node.on_shutdown.append(reasons.append)
    node.advertise("chatter", Text)
    assert "killed" in real.tool(graph, "rosnode", "kill", "/ours")
    assert node.wait_closed(60)
    assert reasons


def test_a_real_node_logs_through_our_rosout():
    with Master(port=0) as master, Node("ours", master_uri=master.uri) as node:
        from gazelle_ros import load_message

        got = []
        node.subscribe("/rosout_agg", load_message("rosgraph_msgs/Log"), got.append)
        script = 'rospy.init_node("logger")\nwhile not rospy.is_shutdown(): rospy.logwarn("careful"); time.sleep(0.2)'
        with real.RealNode(master.uri, script):
            until(lambda: any(m.msg == "careful" and m.name == "/logger" for m in got))


@pytest.mark.long
def test_simulated_time_of_a_real_clock(graph):
    MasterProxy(graph, "/test").set_param("/use_sim_time", True)
    script = """
from rosgraph_msgs.msg import Clock
rospy.init_node("clock", disable_rostime=True)
p = rospy.Publisher("/clock", Clock, queue_size=10)
while p.get_num_connections() < 1: time.sleep(.01)
i = 100
while not rospy.is_shutdown(): i += 1; p.publish(Clock(rospy.Time(i))); time.sleep(.01)
"""
    with Node("ours", master_uri=graph) as node:
        assert node.clock.simulated
        assert node.clock.now() == 0
        with real.RealNode(graph, script):
            assert node.clock.sleep(50 * 10**9)
            assert node.clock.now() >= 150 * 10**9


@pytest.mark.long
def test_a_real_publisher_of_another_type_is_named(graph, node, caplog):
    publish = 'rospy.Publisher("chatter", String, queue_size=1); say("ready"); rospy.spin()'
    with real.RealNode(graph, f'rospy.init_node("real_talker"); {publish}') as talker:
        talker.expect("ready")
        with caplog.at_level(logging.ERROR):
            subscriber = node.subscribe("chatter", Word, lambda message: None)
            until(lambda: "/chatter" in caplog.text)
        assert subscriber.num_connections == 0
        time.sleep(0.5)
        refusals = [each for each in caplog.messages if "refused" in each]
        assert len(refusals) == 1, refusals


@pytest.mark.long
def test_our_node_registers_again_with_a_restarted_roscore():
    port = free_port()
    with real.master(port=port) as uri:
        node = Node("ours", master_uri=uri)
        publisher = node.advertise("chatter", Text, latch=True)
        publisher.publish(Text("still here"))
        node.serve("flip", Flag, lambda request: (True, ""))
    with real.master(port=port) as uri:
        proxy = MasterProxy(uri, "/test")
        until(lambda: "/chatter" in dict(proxy.published_topics()))
        until(lambda: "/flip" in proxy.system_state()[2])
        assert 'data: "still here"' in real.tool(uri, "rostopic", "echo", "-n1", "/chatter")
        node.close()
        assert "/chatter" not in dict(proxy.published_topics())
        proxy.close()


@pytest.mark.long
def test_a_killed_real_publisher_is_found_again(graph, node):
    got = []
    subscriber = node.subscribe("chatter", Text, got.append)
    for _ in range(2):
        with real.RealNode(graph, TALKER) as talker:
            talker.expect("sent")
            until(lambda: len(got) == 300)
            talker.process.send_signal(signal.SIGKILL)
        until(lambda: subscriber.num_connections == 0)
        got.clear()


def test_our_master_answers_as_the_real_one():
    with real.master(core=False) as theirs, Master(port=0, rosout=False) as ours:
        answers = [_converse(uri) for uri in (theirs, ours.uri)]
    assert answers[0] == answers[1]


NODE_A, NODE_B = "http://127.0.0.1:1/", "http://127.0.0.1:2/"
STRING, INT = "std_msgs/String", "std_msgs/Int32"
CALLS = [
    ("getSystemState",),
    ("lookupNode", "/a"),
    ("lookupService", "/a"),
    ("registerSubscriber", "/t", "*", NODE_B),
    ("getTopicTypes",),
    ("registerPublisher", "/t", STRING, NODE_A),
    ("registerPublisher", "rel", STRING, NODE_A),
    ("registerPublisher", "~priv", STRING, NODE_A),
    ("getTopicTypes",),
    ("getPublishedTopics", ""),
    ("getPublishedTopics", "/t"),
    ("getPublishedTopics", 5),
    ("registerPublisher", "/t", INT, NODE_B),
    ("getTopicTypes",),
    ("getSystemState",),
    ("unregisterPublisher", "/t", NODE_A),
    ("unregisterPublisher", "/t", NODE_B),
    ("unregisterPublisher", "/t", NODE_B),
    ("unregisterSubscriber", "/never", NODE_B),
    ("getSystemState",),
    ("registerPublisher", "/t", "notype", NODE_A),
    ("registerPublisher", "/t", STRING, "nouri"),
    ("registerPublisher", "", STRING, NODE_A),
    ("registerPublisher", "/bad name", STRING, NODE_A),
    ("registerPublisher", "/t", 5, NODE_A),
    ("registerPublisher", "/t"),
    ("registerService", "/s", "rosrpc://127.0.0.1:9", NODE_A),
    ("lookupService", "/s"),
    ("unregisterService", "/s", "rosrpc://127.0.0.1:8"),
    ("unregisterService", "/s", "rosrpc://127.0.0.1:9"),
    ("registerService", "/s", "http://x:1", NODE_A),
    ("getSystemState",),
    ("setParam", "/p", {"y": 2, "z": {"w": [1, 2.5, "three", True]}}),
    ("getParam", "/p/"),
    ("getParam", "/p/z/w"),
    ("getParam", "/p/y/k"),
    ("hasParam", "/p/q"),
    ("setParam", "/p/y/k", 5),
    ("getParam", "/p"),
    ("deleteParam", "/p/q"),
    ("deleteParam", "/p/y"),
    ("setParam", "/p", {}),
    ("hasParam", "/p"),
    ("getParamNames",),
    ("setParam", "rel", 1),
    ("setParam", "~priv", 1),
    ("getParam", "~priv"),
    ("searchParam", "rel"),
    ("searchParam", "rel/zz"),
    ("searchParam", "nope"),
    ("searchParam", "~x"),
    ("searchParam", "/rel"),
    ("setParam", "", 1),
    ("setParam", "/", 1),
    ("setParam", "/a/b", {"c/d": 1}),
    ("getParam", "/a/b"),
    ("getParam", "/a/b/c/d"),
    ("subscribeParam", NODE_A, "/nope"),
    ("subscribeParam", NODE_A, "/p"),
    ("unsubscribeParam", NODE_A, "/p"),
    ("unsubscribeParam", NODE_A, "/p"),
    ("deleteParam", "/"),
    ("getParamNames", 1),
    ("getPid", 1),
]


def _converse(uri):
    answers = []
    for caller in ("/a", "/ns/b"):
        proxy = MasterProxy(uri, caller)
        answers += [(method, args, proxy.call_raw(method, *args)) for method, *args in CALLS]
        proxy.close()
    return answers
