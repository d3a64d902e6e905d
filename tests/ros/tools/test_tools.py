"""The tools as functions, on a graph of this process."""

from __future__ import annotations

import io
import threading
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle.ros import Time, load_message, load_service
from gazelle.ros.tools import listing, nodes, params, services
from gazelle.ros.tools.echoing import Echo, EchoOptions, echo, filter_of
from gazelle.ros.tools.errors import ToolError
from gazelle.ros.tools.fields import parse_path, type_at, value_at
from gazelle.ros.tools.graph import Graph
from gazelle.ros.tools.publishing import (
    MessagePublisher,
    documents,
    file_documents,
    parse_arguments,
    publish,
)
from gazelle.ros.tools.rates import RateMeter, SizeMeter, measure_rates

STRING = load_message("std_msgs/String")
SCAN = load_message("sensor_msgs/LaserScan")
SETBOOL = load_service("std_srvs/SetBool")


@pytest.fixture
def graph(master):
    with Graph("rostool", master.uri, namespace="/") as made:
        yield made


@pytest.fixture
def out():
    return io.StringIO()


class Background:
    """A function in a thread, which ends when its event is set."""

    def __init__(self, function, *arguments, **keywords):
        self.stop = threading.Event()
        self.error = None

        def run():
            try:
                function(*arguments, self.stop, **keywords)
            except Exception as error:  # noqa: BLE001  # it is looked at in the test
                self.error = error

        self.thread = threading.Thread(target=run)
        self.thread.start()

    def end(self, *, stop=True):
        if stop:
            self.stop.set()
        self.thread.join(10)
        assert not self.thread.is_alive()
        if self.error is not None:
            raise self.error


# Fields ----------------------------------------------------------------------------------


def test_paths_lead_to_parts_of_messages():
    scan = SCAN(ranges=[1.0, 2.0, 3.0])
    scan.header.frame_id = "base"
    cases = {
        "/header/frame_id": "base",
        "/ranges": [1.0, 2.0, 3.0],
        "/ranges[1]": 2.0,
        "ranges[-1]": 3.0,
        "": scan,
    }
    for path, value in cases.items():
        assert value_at(scan, parse_path(path)) == value
    markers = load_message("visualization_msgs/MarkerArray")()
    marker = load_message("visualization_msgs/Marker")
    markers.markers = [marker(id=number) for number in range(4)]
    assert value_at(markers, parse_path("/markers[1:3]/id")) == [1, 2]
    assert value_at(markers, parse_path("/markers[::2]/id")) == [0, 2]


@pytest.mark.parametrize("path", ["/a b", "/a[", "/a[x]", "/a[]", "/a[1:2:3:4]"])
def test_malformed_paths_are_refused(path):
    with pytest.raises(ToolError):
        parse_path(path)


def test_missing_fields_are_named_with_the_closest():
    with pytest.raises(ToolError, match="did you mean 'ranges'"):
        value_at(SCAN(), parse_path("/range"))
    with pytest.raises(ToolError, match="out of range"):
        value_at(SCAN(), parse_path("/ranges[5]"))
    with pytest.raises(ToolError, match="has no field"):
        type_at(SCAN, parse_path("/header/nope"))


def test_types_of_parts_are_known():
    assert type_at(SCAN, parse_path("/header/stamp")) == "time"
    assert type_at(SCAN, parse_path("/ranges")) == "float32[]"
    assert type_at(SCAN, parse_path("/ranges[0]")) == "float32"


@given(st.text(alphabet="/ab[]:-01 ", max_size=12))
def test_any_path_is_parsed_or_refused(path):
    try:
        parse_path(path)
    except ToolError:
        return


# Topics ----------------------------------------------------------------------------------


def test_topics_are_listed(graph, make_node, out):
    node = make_node("talker")
    node.advertise("/b", STRING)
    node.subscribe("/a", STRING, print)
    node.advertise("/n/c", SCAN)
    listing.list_topics(graph, out)
    assert out.getvalue() == "/a\n/b\n/n/c\n"
    out = io.StringIO()
    listing.list_topics(graph, out, verbose=True)
    assert out.getvalue() == (
        "\nPublished topics:\n * /b [std_msgs/String] 1 publisher\n"
        " * /n/c [sensor_msgs/LaserScan] 1 publisher\n\n"
        "Subscribed topics:\n * /a [std_msgs/String] 1 subscriber\n\n"
    )
    out = io.StringIO()
    listing.list_topics(graph, out, "/n", subscribers=False)
    assert out.getvalue() == "/n/c\n"
    out = io.StringIO()
    listing.list_topics(graph, out, by_host=True)
    assert out.getvalue().startswith("Host [127.0.0.1]:\n  /a\n")


def test_a_topic_is_described(graph, make_node):
    node = make_node("talker")
    node.advertise("/b", STRING)
    assert listing.topic_info(graph, "b") == (
        f"Type: std_msgs/String\n\nPublishers: \n * /talker ({node.uri})\n\nSubscribers: None\n\n"
    )
    with pytest.raises(ToolError, match="did you mean '/b'"):
        listing.topic_info(graph, "/bb")


def test_types_are_told(graph, make_node):
    make_node("talker").advertise("/scan", SCAN)
    assert listing.topic_type(graph, "/scan") == "sensor_msgs/LaserScan"
    assert listing.topic_type(graph, "/scan/header/seq") == (
        "sensor_msgs/LaserScan header/seq uint32"
    )
    with pytest.raises(ToolError):
        listing.topic_type(graph, "/scan/nope")
    assert listing.topics_of_type(graph, "sensor_msgs/LaserScan") == ["/scan"]


def test_messages_are_echoed(graph, make_node, out):
    make_node("talker").advertise("/a", STRING, latch=True).publish(STRING(data="hi"))
    Background(echo, graph, "/a", out, EchoOptions(count=1)).end(stop=False)
    assert out.getvalue() == 'data: "hi"\n---\n'


def test_echo_waits_for_its_topic(graph, make_node, out, capsys):
    running = Background(echo, graph, "/late", out, EchoOptions(count=1))
    time.sleep(0.3)
    make_node("talker").advertise("/late", STRING, latch=True).publish(STRING(data="x"))
    running.end(stop=False)
    assert out.getvalue() == 'data: "x"\n---\n'
    assert "does not appear to be published yet" in capsys.readouterr().err


def test_echo_ends_when_it_is_told(graph, make_node, out):
    make_node("talker").advertise("/a", STRING)
    running = Background(echo, graph, "/a", out, EchoOptions())
    time.sleep(0.2)
    running.end()


def test_echo_of_a_missing_field_is_an_error(graph, make_node, out):
    make_node("talker").advertise("/scan", SCAN, latch=True).publish(SCAN(ranges=[1.0]))
    with pytest.raises(ToolError, match="out of range"):
        Background(echo, graph, "/scan/ranges[3]", out, EchoOptions(count=1)).end(stop=False)


def write(message, path="", kind=None, **options):
    out = io.StringIO()
    Echo(out, EchoOptions(**options), parse_path(path), kind).write(message, Time(100, 5))
    return out.getvalue()


def test_echo_has_many_forms():
    scan = SCAN(ranges=[1.0, 2.0])
    scan.header.stamp = Time(90, 5)
    assert 'ranges: "<array type: float32, length: 2>"' in write(scan, no_arrays=True)
    assert 'frame_id: "<string length: 0>"' in write(scan, no_strings=True)
    assert "secs: -10" in write(scan, offset=True)
    assert write(STRING(data="x"), clear=True).startswith("\033[2J\033[;Hdata")
    header, line = write(scan, plot=True).splitlines()
    assert header.startswith("%time,field.header.seq,field.header.stamp,field.header.frame_id")
    assert header.endswith("field.ranges0,field.ranges1")
    assert line.startswith("90000000005,0,90000000005,,")
    assert line.endswith(",1.0,2.0")
    assert write(scan, "/ranges", plot=True) == "%time,field0,field1\n100000000005,1.0,2.0\n"
    assert write(STRING(data="a"), plot=True, no_strings=True) == "%time,\n100000000005,\n"
    assert write(scan, "/ranges[0]", width=4).startswith("1.00")


def test_echo_filters():
    keep = filter_of("m.data > 'b'")
    assert write(STRING(data="a"), keep=keep) == ""
    assert write(STRING(data="c"), keep=keep) == 'data: "c"\n---\n'
    with pytest.raises(ToolError):
        filter_of("m.data >")


# Publishing ------------------------------------------------------------------------------


@pytest.fixture
def heard(make_node):
    found = []
    make_node("listener").subscribe("/out", STRING, lambda m: found.append(m.data))
    return found


def publisher(graph, out, stop, kind="std_msgs/String", **options):
    return MessagePublisher(graph, "/out", kind, out, stop, **options)


def run_publish(graph, out, stop, *arguments, latch=True, **options):
    made = publisher(graph, out, stop, latch=latch)
    try:
        publish(made, *arguments, **options)
    finally:
        made.close()


def test_one_message_is_published(graph, heard, out):
    running = Background(lambda stop: run_publish(graph, out, stop, ["hi"], None, once=True))
    until(lambda: heard == ["hi"])
    running.end()
    assert out.getvalue() == "publishing and latching message for 3.0 seconds\n"


def test_messages_are_repeated(graph, heard, out):
    running = Background(
        lambda stop: run_publish(graph, out, stop, [{"data": "x"}], None, hertz=50.0)
    )
    until(lambda: len(heard) > 10)
    begin, count = time.monotonic(), len(heard)
    time.sleep(0.5)
    rate = (len(heard) - count) / (time.monotonic() - begin)
    running.end()
    assert 35 < rate < 60


def test_several_messages_come_one_after_another(graph, heard, out):
    source = [["a"], ["b"], ["c"]]
    running = Background(lambda stop: run_publish(graph, out, stop, [], source, hertz=50.0))
    until(lambda: heard == ["a", "b", "c"])
    running.end(stop=False)


def test_now_and_auto_are_times(graph, out):
    made = publisher(graph, out, threading.Event(), "geometry_msgs/PointStamped")
    try:
        message = made.message([{"header": "auto"}])
        assert abs(message.header.stamp.to_sec() - time.time()) < 5
        message = made.message([{"header": {"stamp": "now", "frame_id": "x"}}])
        assert abs(message.header.stamp.to_sec() - time.time()) < 5
        with pytest.raises(ToolError, match="No field name"):
            made.message([{"nope": 1}])
    finally:
        made.close()


def test_documents_come_when_they_are_complete():
    stream = io.StringIO("data: a\n---\n---\n[b]\n---\ndata: incomplete\n")
    assert list(documents(stream)) == [[{"data": "a"}], ["b"]]


def test_files_hold_documents(tmp_path):
    path = tmp_path / "m.yaml"
    path.write_text("data: a\n---\ndata: b\n")
    assert file_documents(str(path)) == [[{"data": "a"}], [{"data": "b"}]]
    path.write_text("a: [")
    with pytest.raises(ToolError, match="no YAML"):
        file_documents(str(path))
    with pytest.raises(ToolError, match="cannot be read"):
        file_documents("/no/such.yaml")


def test_words_are_yaml():
    assert parse_arguments(["1", "x", "{a: 1}", ""]) == [1, "x", {"a": 1}, ""]
    with pytest.raises(ToolError):
        parse_arguments(["[1"])


# Rates -----------------------------------------------------------------------------------


def test_rates_are_measured():
    meter = RateMeter()
    assert meter.read() is None
    for number in range(11):
        meter.add(number * 0.1)
    rate, least, most, spread, count = meter.read()
    assert (rate, least, most, count) == (
        pytest.approx(10),
        pytest.approx(0.1),
        pytest.approx(0.1),
        11,
    )
    assert spread == pytest.approx(0, abs=1e-9)
    assert meter.read() is None
    assert not meter.add(0.0)


def test_a_window_forgets():
    meter = RateMeter(3)
    for now in (0.0, 10.0, 10.1, 10.2):
        meter.add(now)
    assert meter.read()[4] == 3
    assert meter.add(10.3)
    assert meter.read()[0] == pytest.approx(10)


def test_sizes_are_measured():
    meter = SizeMeter()
    meter.add(0.0, 1000)
    assert meter.text(1.0) == ""
    meter.add(1.0, 3000)
    assert meter.text(2.0) == (
        "average: 2.00KB/s\n\tmean: 2.00KB min: 1.00KB max: 3.00KB window: 2\n"
    )


def test_rates_of_topics_are_written(graph, make_node, out):
    node = make_node("talker")
    publishers = [node.advertise(topic, STRING) for topic in ("/a", "/b")]
    running = Background(measure_rates, graph, ["/a", "/b"], out)
    until(lambda: all(each.num_connections for each in publishers))
    deadline = time.monotonic() + 1.5
    while time.monotonic() < deadline:
        for each in publishers:
            each.publish(STRING())
        time.sleep(0.02)
    running.end()
    lines = out.getvalue().splitlines()
    assert lines[:2] == ["subscribed to [/a]", "subscribed to [/b]"]
    assert lines[2].split() == ["topic", "rate", "min_delta", "max_delta", "std_dev", "window"]
    assert float(lines[4].split()[1]) == pytest.approx(50, abs=10)


# Services --------------------------------------------------------------------------------


@pytest.fixture
def server(make_node):
    node = make_node("server")
    node.serve("/set", SETBOOL, lambda request: (request.data, f"got {request.data}"))
    return node


def test_services_are_described(graph, server):
    assert services.list_services(graph) == [("/set", ["/server"])]
    assert services.list_services(graph, "/nope") == []
    assert services.service_type(graph, "set") == "std_srvs/SetBool"
    assert services.services_of_type(graph, "std_srvs/SetBool") == ["/set"]
    lines = services.service_info(graph, "/set").splitlines()
    assert lines[0] == "Node: /server"
    assert lines[2:] == ["Type: std_srvs/SetBool", "Args: data"]
    with pytest.raises(ToolError, match="did you mean '/set'"):
        services.service_node(graph, "/sett")


def test_services_are_called(graph, server, make_node):
    caller = services.Caller(graph, make_node("caller"), "/set")
    assert caller.takes_values
    response = caller.call(caller.request([True]))
    assert (response.success, response.message) == (True, "got True")
    assert caller.request([{"data": False}]).data is False
    with pytest.raises(ToolError, match="Service arguments are"):
        caller.request([1, 2])


# Nodes -----------------------------------------------------------------------------------


def test_nodes_are_described(graph, make_node):
    node = make_node("talker")
    node.advertise("/a", STRING)
    other = make_node("n/listener")
    other.subscribe("/a", STRING, print)
    assert nodes.list_nodes(graph) == "/n/listener\n/talker\n"
    assert nodes.list_nodes(graph, "/n") == "/n/listener\n"
    assert nodes.list_nodes(graph, uris=True, names=False) == f"{other.uri}\n{node.uri}\n"
    assert nodes.machines(graph) == ["127.0.0.1"]
    assert nodes.nodes_on(graph, "localhost") == ["/n/listener", "/talker"]
    until(lambda: node.publication("/a").num_connections)
    text = nodes.node_info(graph, "/talker")
    assert "Publications: \n * /a [std_msgs/String]\n" in text
    assert "Subscriptions: None\n" in text
    assert "Pid: " in text
    assert " * topic: /a\n    * to: /n/listener\n    * direction: outbound" in text
    with pytest.raises(ToolError, match="did you mean '/talker'"):
        nodes.node_info(graph, "/talkr")


def test_nodes_answer_pings(graph, make_node, out):
    make_node("talker").advertise("/a", STRING)
    complaints = []
    good = nodes.ping(graph, "/talker", out, threading.Event(), count=2, complain=complaints.append)
    assert good
    lines = out.getvalue().splitlines()
    assert lines[0] == "pinging /talker with a timeout of 3.0s"
    assert len(lines) == 4
    assert lines[3].startswith("ping average: ")
    assert not nodes.ping(graph, "/no", out, threading.Event(), complain=complaints.append)
    assert complaints == ["cannot ping [/no]: unknown node"]


def test_nodes_are_ended(graph, make_node):
    node = make_node("talker")
    node.advertise("/a", STRING)
    assert nodes.kill(graph, ["/talker", "/no"]) == ["/no"]
    until(lambda: node.closed)


def test_dead_nodes_are_found_and_forgotten(graph, master, make_node):
    make_node("alive").advertise("/a", STRING)
    graph.master.caller = "/dead"
    graph.master.register_publisher("/a", "std_msgs/String", "http://127.0.0.1:1/")
    graph.master.register_subscriber("/b", "std_msgs/String", "http://127.0.0.1:1/")
    graph.master.register_service("/s", "rosrpc://127.0.0.1:1", "http://127.0.0.1:1/")
    graph.master.caller = "/rostool"
    assert nodes.dead_nodes(graph) == ["/dead"]
    nodes.unregister(graph, ["/dead"])
    assert graph.nodes() == ["/alive"]
    assert graph.services() == []


# Parameters ------------------------------------------------------------------------------


def test_parameters_are_set_and_merged(graph):
    params.set_from_text(graph, "/a", "{b: 1, c: [1, x]}")
    done = params.set_from_text(graph, "/a", "{d: {e: true}}")
    assert done == [("/a/d/e", True)]
    assert params.get_parameter(graph, "/a") == {"b": 1, "c": [1, "x"], "d": {"e": True}}
    assert params.list_parameters(graph, "/a/d") == ["/a/d/e"]
    params.set_from_text(graph, "/s", "")
    assert params.get_parameter(graph, "/s") == ""


def test_parameters_have_forms(graph):
    value = {"b": 1, "d": {"t": "x\ny", "u": "z"}, "l": [1.5]}
    assert params.as_yaml(1) == "1\n"
    assert params.as_yaml("x") == "x\n"
    assert params.pretty(value) == "b: 1\nd:\n  t: |\n    x\n    y\n  u: z\nl: - 1.5\n"
    assert params.pretty("text") == "text\n"


def test_parameters_are_loaded_and_dumped(graph, tmp_path):
    path = tmp_path / "p.yaml"
    path.write_text("a: !degrees 180\n_ns: inner\n---\nb: 2\n")
    params.load_parameters(graph, str(path), "/n")
    found = params.get_parameter(graph, "/n")
    assert found == {"inner": {"a": pytest.approx(3.14159265)}, "b": 2}
    path.write_text(params.dump_parameters(graph, "/n"))
    params.load_parameters(graph, str(path), "/m")
    assert params.get_parameter(graph, "/m") == found
    path.write_text("a: [")
    with pytest.raises(ToolError, match="no YAML"):
        params.load_parameters(graph, str(path))
    with pytest.raises(ToolError, match="cannot be read"):
        params.load_parameters(graph, "/no/such")


def test_parameters_are_deleted(graph):
    params.set_from_text(graph, "/alpha", "1")
    with pytest.raises(ToolError, match="did you mean '/alpha'"):
        params.delete_parameter(graph, "/alpa")
    params.delete_parameter(graph, "/alpha")
    assert params.list_parameters(graph) == []
    params.set_from_text(graph, "/", "{x: 1}")
    params.delete_parameter(graph, "/")
    assert params.list_parameters(graph) == []


@pytest.mark.parametrize("text", ["[", "99999999999", "null"])
def test_values_that_cannot_be_are_refused(graph, text):
    with pytest.raises(ToolError):
        params.set_from_text(graph, "/x", text)


def test_the_root_is_a_mapping(graph):
    with pytest.raises(ToolError, match="dictionary"):
        params.set_from_text(graph, "/", "1")
