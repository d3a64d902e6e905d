"""The topic tools as functions, on a graph of this process."""

from __future__ import annotations

import errno
import io
import threading
import time

import pytest
from ros.graph import Background, until

from gazelle_ros import Time, load_message
from gazelle_ros.tools import listing
from gazelle_ros.tools.echoing import Echo, EchoOptions, echo, filter_of
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import parse_path
from gazelle_ros.tools.publishing import (
    MessagePublisher,
    documents,
    file_documents,
    parse_arguments,
    publish,
)

STRING = load_message("std_msgs/String")
SCAN = load_message("sensor_msgs/LaserScan")


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


def test_echo_waits_for_its_topic(graph, make_node, out, monkeypatch):
    said = io.StringIO()
    monkeypatch.setattr("sys.stderr", said)
    running = Background(echo, graph, "/late", out, EchoOptions(count=1))
    until(lambda: "does not appear to be published yet" in said.getvalue())
    make_node("talker").advertise("/late", STRING, latch=True).publish(STRING(data="x"))
    running.end(stop=False)
    assert out.getvalue() == 'data: "x"\n---\n'


def test_echo_ends_when_it_is_told(graph, make_node, out):
    make_node("talker").advertise("/a", STRING)
    running = Background(echo, graph, "/a", out, EchoOptions())
    time.sleep(0.2)
    running.end()


class Full(io.StringIO):
    """A file on a full disk."""

    def write(self, text):
        raise OSError(errno.ENOSPC, "No space left on device")


def test_echo_ends_with_one_error_where_it_cannot_write(graph, make_node, caplog):
    talker = make_node("talker").advertise("/a", STRING, latch=True)
    talker.publish(STRING(data="hi"))
    with pytest.raises(OSError, match="No space left"):
        echo(graph, "/a", Full(), EchoOptions(), threading.Event())
    assert not caplog.records


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
    with pytest.raises(ToolError, match="fails: AttributeError"):
        write(STRING(data="a"), keep=filter_of("m.nope"))


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
    begin = time.monotonic()
    running = Background(
        lambda stop: run_publish(graph, out, stop, [{"data": "x"}], None, hertz=50.0)
    )
    until(lambda: len(heard) > 30)
    assert len(heard) < 55 * (time.monotonic() - begin) + 3
    running.end()


def test_several_messages_come_one_after_another(graph, heard, out):
    source = [["a"], ["b"], ["c"]]
    running = Background(lambda stop: run_publish(graph, out, stop, [], source, hertz=50.0))
    until(lambda: heard == ["a", "b", "c"])
    running.end(stop=False)


def test_now_and_auto_are_times(graph, out):
    made = publisher(graph, out, threading.Event(), "geometry_msgs/PointStamped")
    try:
        message = made.message([{"header": "auto"}])
        assert abs(message.header.stamp.to_sec() - time.time()) < 60
        message = made.message([{"header": {"stamp": "now", "frame_id": "x"}}])
        assert abs(message.header.stamp.to_sec() - time.time()) < 60
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
    with pytest.raises(ToolError, match="not valid YAML"):
        file_documents(str(path))
    with pytest.raises(ToolError, match="cannot be read"):
        file_documents("/no/such.yaml")


def test_words_are_yaml():
    assert parse_arguments(["1", "x", "{a: 1}", ""]) == [1, "x", {"a": 1}, ""]
    with pytest.raises(ToolError):
        parse_arguments(["[1"])
