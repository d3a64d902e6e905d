"""rospy's interface, in one process."""

import importlib
import io
import socket
import threading
import time

import numpy as np
import pytest
from ports import free_port

from gazelle_ros import Master, publishing


def until(condition, seconds=60.0):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, "it did not come true in time"
        time.sleep(0.005)


@pytest.fixture
def msgs(rospy):
    return importlib.import_module("std_msgs.msg")


@pytest.fixture
def srvs(rospy):
    return importlib.import_module("std_srvs.srv")


def test_topics_made_before_the_node_work_with_it(rospy, msgs):
    got = []
    publisher = rospy.Publisher("early", msgs.String, queue_size=1, latch=True)
    rospy.Subscriber("early", msgs.String, lambda m, a: got.append((m.data, a)), "more")
    with pytest.raises(rospy.ROSException, match="not been initialized"):
        publisher.publish("x")
    rospy.init_node("probe", disable_signals=True)
    publisher.publish(data="hello")
    until(lambda: got)
    assert got == [("hello", "more")]
    assert publisher.get_num_connections() == 1


def test_publish_takes_messages_fields_and_keywords(node, msgs):
    got = []
    publisher = node.Publisher("t", msgs.ColorRGBA, queue_size=9)
    node.Subscriber("t", msgs.ColorRGBA, got.append)
    until(publisher.get_num_connections)
    publisher.publish(msgs.ColorRGBA(1, 2, 3, 4))
    publisher.publish(1, 2, 3, 4)
    publisher.publish(a=4)
    until(lambda: len(got) == 3)
    assert [m.a for m in got] == [4.0, 4.0, 4.0]
    with pytest.raises(TypeError, match="arguments or keywords"):
        publisher.publish(1, a=2)
    with pytest.raises(TypeError, match="expected"):
        publisher.publish(msgs.String("x"))
    with pytest.raises(node.ROSSerializationException):
        publisher.publish(r="red")


def test_a_published_message_may_be_changed_afterwards(node, msgs):
    got = []
    node.Subscriber("t", msgs.Int32, lambda m: got.append(m.data))
    publisher = node.Publisher("t", msgs.Int32, queue_size=100)
    until(publisher.get_num_connections)
    message = msgs.Int32()
    for number in range(20):
        message.data = number
        publisher.publish(message)
    until(lambda: len(got) == 20)
    assert got == list(range(20))


def test_a_latched_message_reaches_later_subscribers_of_the_same_node(node, msgs):
    got = []
    publisher = node.Publisher("t", msgs.String, queue_size=1, latch=True)
    node.Subscriber("t", msgs.String, lambda m: got.append(1))
    publisher.publish("x")
    until(lambda: got)
    node.Subscriber("t", msgs.String, lambda m: got.append(2))
    until(lambda: 2 in got)


def test_a_latched_message_is_not_missed_while_its_publisher_is_attached(node, msgs, monkeypatch):
    added = threading.Event()
    attach = publishing.Publication.attach

    def slow(publication, link):
        attach(publication, link)
        assert added.wait(60.0)

    monkeypatch.setattr(publishing.Publication, "attach", slow)
    got = []
    publisher = node.Publisher("t", msgs.String, queue_size=1, latch=True)
    publisher.publish("x")
    node.Subscriber("t", msgs.String, lambda m: got.append(1))
    until(lambda: got)
    node.Subscriber("t", msgs.String, lambda m: got.append(2))
    added.set()
    until(lambda: 2 in got)
    assert got == [1, 2]


def test_listeners_hear_of_subscribers(node, msgs):
    heard, got = [], []

    class Listener(node.SubscribeListener):
        def peer_subscribe(self, topic_name, topic_publish, peer_publish):
            heard.append(topic_name)
            peer_publish(msgs.String("only you"))

        def peer_unsubscribe(self, topic_name, num_peers):
            heard.append(num_peers)

    node.Publisher("t", msgs.String, Listener(), queue_size=1)
    subscriber = node.Subscriber("t", msgs.String, got.append)
    until(lambda: got)
    subscriber.unregister()
    until(lambda: len(heard) == 2)
    assert heard == ["/t", 0]
    assert got[0].data == "only you"


def test_any_message_is_bytes_and_a_header(node, msgs):
    got = []
    publisher = node.Publisher("t", msgs.String, queue_size=1)
    node.Subscriber("t", node.AnyMsg, got.append)
    until(publisher.get_num_connections)
    publisher.publish("abc")
    until(lambda: got)
    assert got[0]._buff == b"\3\0\0\0abc"
    assert got[0]._connection_header["type"] == "std_msgs/String"


def test_numpy_messages_hold_arrays(node, msgs):
    numpy_msg = importlib.import_module("rospy.numpy_msg").numpy_msg
    got = []
    kind = numpy_msg(msgs.Float64MultiArray)
    assert numpy_msg(msgs.Float64MultiArray) is kind
    node.Subscriber("t", kind, got.append)
    publisher = node.Publisher("t", kind, queue_size=1)
    until(publisher.get_num_connections)
    publisher.publish(data=np.arange(3.0))
    until(lambda: got)
    assert isinstance(got[0].data, np.ndarray)
    assert got[0].data.tolist() == [0.0, 1.0, 2.0]


def test_a_bad_callback_is_logged_and_changes_nothing(node, msgs, monkeypatch):
    got, printed = [], io.StringIO()
    monkeypatch.setattr("sys.stderr", printed)

    def bad(message):
        got.append(message.data)
        raise ValueError("a bug of mine")

    node.Subscriber("t", msgs.Int32, bad)
    publisher = node.Publisher("t", msgs.Int32, queue_size=5)
    until(publisher.get_num_connections)
    publisher.publish(1)
    publisher.publish(2)
    until(lambda: got == [1, 2])
    until(lambda: "a bug of mine" in printed.getvalue())


@pytest.mark.parametrize(
    ("name", "kind", "text"),
    [
        ("", "String", "non-empty"),
        ("t", None, "not initialized"),
        ("t", "text", "not a class"),
        ("t", int, "not a message"),
    ],
)
def test_topics_refuse_what_cannot_be(node, msgs, name, kind, text):
    kind = msgs.String if kind == "String" else kind
    with pytest.raises(ValueError, match=text):
        node.Subscriber(name, kind)


def test_a_publisher_without_queue_size_is_warned_of(node, msgs):
    with pytest.warns(SyntaxWarning, match="queue_size"):
        node.Publisher("t", msgs.String)


def test_services_take_and_give_what_rospy_allows(node, srvs):
    def handle(request):
        return {"success": request.data, "message": "done"}

    service = node.Service("flag", srvs.SetBool, handle)
    proxy = node.ServiceProxy("flag", srvs.SetBool, persistent=True)
    node.wait_for_service("flag", 60.0)
    assert proxy(True).success
    assert not proxy(data=False).success
    assert proxy.call(srvs.SetBoolRequest(True)).message == "done"
    with pytest.raises(node.ServiceException, match="already registered"):
        node.Service("flag", srvs.SetBool, handle)
    proxy.close()
    service.shutdown()
    with pytest.raises(node.ServiceException, match=r"service \[/flag\] unavailable"):
        node.ServiceProxy("flag", srvs.SetBool)(True)


def test_errors_of_services_have_rospys_texts(node, srvs):
    seen = []

    def handle(request):
        if request.data:
            raise node.ServiceException("not today")
        return

    def broken(request):
        raise ValueError("a bug")

    node.Service("no", srvs.SetBool, handle)
    node.Service("broken", srvs.SetBool, broken, error_handler=lambda *a: seen.append(a))
    for name, data, text in [
        ("no", True, "responded with an error: .*service cannot process request: not today"),
        ("no", False, "service cannot process request: service handler returned None"),
        ("broken", True, "error processing request: a bug"),
    ]:
        with pytest.raises(node.ServiceException, match=text):
            node.ServiceProxy(name, srvs.SetBool)(data)
    assert seen[0][1] is ValueError


def test_arguments_that_no_request_can_hold_fail_as_in_rospy(node, msgs, srvs):
    genpy = importlib.import_module("genpy")
    node.Service("flag", srvs.SetBool, lambda request: (True, ""))
    proxy = node.ServiceProxy("flag", srvs.SetBool)
    for wrong in ("yes", [1], srvs.SetBoolRequest("yes")):
        with pytest.raises(genpy.SerializationError, match="field data is not a bool"):
            proxy(wrong)
    with pytest.raises(TypeError, match="does not match service type"):
        proxy(msgs.Bool(True))
    with pytest.raises(node.ServiceException, match=r"service \[/nowhere\] unavailable"):
        node.ServiceProxy("nowhere", srvs.SetBool)("yes")
    with pytest.raises(node.ServiceException, match=r"^unable to connect to service: .*md5sums"):
        node.ServiceProxy("flag", srvs.Trigger)()


def test_services_can_be_called_before_there_is_a_node(rospy, srvs, make_node):
    server = make_node("server")
    server.serve("/flag", srvs.SetBool, lambda request: {"success": True})
    rospy.wait_for_service("/flag", 60.0)
    assert rospy.ServiceProxy("/flag", srvs.SetBool)(True).success


def test_parameters_with_and_without_a_node(rospy):
    rospy.set_param("/a/b", [1, 2.5, "x", {"y": True}])
    assert rospy.get_param("/a") == {"b": [1, 2.5, "x", {"y": True}]}
    assert rospy.get_param("/nothing", 7) == 7
    with pytest.raises(KeyError):
        rospy.get_param("/nothing")
    rospy.init_node("probe", argv=["probe", "_speed:=1.5", "__ns:=/here"], disable_signals=True)
    assert rospy.get_param("~speed") == 1.5
    assert rospy.get_name() == "/here/probe"
    rospy.set_param("~deep", {"x": 1})
    assert rospy.has_param("/here/probe/deep/x")
    assert rospy.get_param_cached("~deep/x") == 1
    rospy.set_param("~deep/x", 2)
    assert rospy.get_param_cached("~deep/x") == 2
    assert rospy.search_param("speed") == "/here/probe/speed"
    rospy.delete_param("~speed")
    with pytest.raises(KeyError):
        rospy.delete_param("~speed")
    assert "/a/b" in rospy.get_param_names()
    with pytest.raises((TypeError, OverflowError)):
        rospy.set_param("~big", 2**40)


def test_names_resolve_and_remap(rospy):
    rospy.init_node("probe", argv=["probe", "t:=/else", "~p:=q", "plain"], disable_signals=True)
    assert rospy.resolve_name("t") == "/else"
    assert rospy.resolve_name("~p") == "/q"
    assert rospy.resolve_name("a/b") == "/a/b"
    assert rospy.remap_name("t") == "/else"
    assert rospy.get_namespace() == "/"
    assert rospy.get_caller_id() == "/probe"
    assert rospy.myargv(["probe", "t:=/else", "plain"]) == ["probe", "plain"]
    assert rospy.get_node_uri().startswith("http://")


def test_a_node_begins_once(rospy):
    rospy.init_node("probe", disable_signals=True)
    rospy.init_node("probe", disable_signals=True)
    with pytest.raises(rospy.ROSException, match="different arguments"):
        rospy.init_node("other")


@pytest.mark.parametrize("name", ["", "a/b"])
def test_impossible_names_are_refused(rospy, name):
    with pytest.raises(ValueError, match="name"):
        rospy.init_node(name)


def test_a_master_that_is_not_there_yet_is_waited_for(rospy, monkeypatch):
    port, printed, masters = free_port(), io.StringIO(), []
    uri = f"http://127.0.0.1:{port}"
    said = f"Unable to register with master node [{uri}]: master may not be running yet. Will keep"
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    monkeypatch.setattr("sys.stdout", printed)

    def start_late():
        until(lambda: said in printed.getvalue())
        masters.append(Master(port=port))

    late = threading.Thread(target=start_late)
    late.start()
    rospy.init_node("probe", disable_signals=True)
    late.join()
    assert printed.getvalue().count(said) == 1
    assert rospy.get_published_topics()
    rospy.signal_shutdown("done")
    masters[0].close()


def test_what_is_no_master_is_not_waited_for(rospy, monkeypatch):
    with socket.create_server(("127.0.0.1", 0)) as taken:

        def refuse():
            connection = taken.accept()[0]
            connection.recv(65536)
            connection.sendall(b"HTTP/1.0 404 No\r\n\r\n")
            connection.close()

        threading.Thread(target=refuse, daemon=True).start()
        monkeypatch.setenv("ROS_MASTER_URI", f"http://127.0.0.1:{taken.getsockname()[1]}")
        with pytest.raises(rospy.ROSInitException, match="is not a ROS master"):
            rospy.init_node("probe", disable_signals=True)


def test_waiting_for_a_message(node, msgs):
    publisher = node.Publisher("t", msgs.String, queue_size=1, latch=True)
    publisher.publish("there")
    assert node.wait_for_message("t", msgs.String, 60.0).data == "there"
    with pytest.raises(node.ROSException, match="exceeded while waiting for message on topic none"):
        node.wait_for_message("none", msgs.String, node.Duration(0.1))
    with pytest.raises(node.ROSException, match="exceeded while waiting for service /none"):
        node.wait_for_service("none", 0.1)


def test_rates_and_timers_keep_time(node):
    # A pause of the process makes one round long, and a rate makes up for less than two cycles.
    lasted = []
    for _ in range(10):
        rate, begin = node.Rate(100), time.monotonic()
        for _ in range(10):
            rate.sleep()
        lasted.append(time.monotonic() - begin)
        if lasted[-1] < 0.3:
            break
    assert 0.05 < min(lasted) < 0.3
    events = []
    timer = node.Timer(node.Duration(0.02), events.append)
    until(lambda: len(events) >= 3)
    timer.shutdown()
    assert events[0].last_real is None
    assert events[1].last_expected == events[0].current_expected
    assert 0.0 <= min(each.last_duration for each in events[1:]) < 1.0
    once = []
    node.Timer(node.Duration(0.01), once.append, oneshot=True).join(60.0)
    assert len(once) == 1


def test_hooks_run_while_the_node_can_still_publish(node, msgs):
    got, order = [], []
    publisher = node.Publisher("t", msgs.String, queue_size=1)
    node.Subscriber("t", msgs.String, got.append)
    until(publisher.get_num_connections)

    def last_words():
        order.append("client")
        publisher.publish("stop")
        until(lambda: got)

    node.on_shutdown(last_words)
    node.core.add_preshutdown_hook(order.append)
    node.signal_shutdown("enough")
    assert order == ["client", "enough"]
    assert node.is_shutdown()
    with pytest.raises(node.ROSException, match="closed topic"):
        publisher.publish("late")
    for wait in (lambda: node.sleep(1), node.Rate(1).sleep):
        with pytest.raises(node.ROSInterruptException):
            wait()
    node.spin()


def test_the_master_can_end_the_node(node, make_node):
    ended = threading.Event()
    node.on_shutdown(ended.set)
    import xmlrpc.client

    xmlrpc.client.ServerProxy(node.get_node_uri()).shutdown("/somebody", "go")
    assert ended.wait(60.0)
    node.spin()


def test_logs_go_to_the_screen_and_to_rosout(node, msgs, capsys):
    log = importlib.import_module("rosgraph_msgs.msg").Log
    got = []
    node.Subscriber("/rosout", log, got.append)
    until(lambda: any(m for m in node.core.process.node.subscriptions() if m.num_connections))
    node.logdebug("hidden")
    node.loginfo("number %d", 5)
    node.logwarn("careful")
    for _ in range(3):
        node.logerr_once("once")
        node.logfatal_throttle(60, "throttled")
        node.loginfo_throttle_identical(60, "same")
    until(lambda: len(got) == 5)
    assert [m.level for m in got] == [node.INFO, node.WARN, node.ERROR, node.FATAL, node.INFO]
    assert got[0].msg == "number 5"
    assert got[0].name == "/probe"
    assert got[0].file == "test_rospy.py"
    assert got[0].function.endswith("test_logs_go_to_the_screen_and_to_rosout")
    printed = capsys.readouterr()
    assert "[INFO] [" in printed.out
    assert "]: number 5" in printed.out
    assert "[WARN]" in printed.err
    assert "hidden" not in printed.out


def test_logger_levels_can_be_changed_from_outside(node):
    srv = importlib.import_module("roscpp.srv")
    loggers = node.ServiceProxy("~get_loggers", srv.GetLoggers)().loggers
    assert ("rosout", "INFO") in [(each.name, each.level) for each in loggers]
    node.ServiceProxy("~set_logger_level", srv.SetLoggerLevel)("rosout", "DEBUG")
    loggers = node.ServiceProxy("~get_loggers", srv.GetLoggers)().loggers
    assert ("rosout", "DEBUG") in [(each.name, each.level) for each in loggers]


def test_the_master_is_an_api_and_a_dict(node):
    master = node.get_master()
    assert master.getPid()[0] == 1
    master["x"] = 3
    assert "x" in master
    assert master["x"] == 3
    assert master.lookupService("~get_loggers")[0] == 1
    del master["x"]
    assert "/x" not in list(master)
    assert ["/rosout", "rosgraph_msgs/Log"] in node.get_published_topics()


def test_messages_go_to_and_from_buffers(rospy, msgs):
    msg = importlib.import_module("rospy.msg")
    buffer, queue = io.BytesIO(), []
    for number in range(3):
        msg.serialize_message(buffer, 0, msgs.Int32(number))
    buffer.write(b"\4\0")
    msg.deserialize_messages(buffer, queue, msgs.Int32, queue_size=2)
    assert [m.data for m in queue] == [1, 2]
    assert buffer.getvalue() == b"\4\0"
