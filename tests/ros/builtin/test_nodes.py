"""Built-in nodes, started as a launch file starts them."""

from __future__ import annotations

import itertools
import math
import signal
import threading
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros import RawMessage, load_message, load_service
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.arguments import parse_arguments
from gazelle_ros.builtin.registry import main_of
from gazelle_ros.builtin.static_transform import from_angles
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.nodes import kill

STRING = load_message("std_msgs/String")


@pytest.fixture
def talk(make_node):
    """Publish numbers on ``/in`` at 50 Hz."""
    publisher = make_node("talker").advertise("/in", STRING)
    stop = threading.Event()

    def run():
        number = 0
        while not stop.wait(0.02):
            publisher.publish(STRING(data=str(number)))
            number += 1

    thread = threading.Thread(target=run)
    thread.start()
    yield publisher
    stop.set()
    thread.join()


# Static transforms -----------------------------------------------------------------------


def test_tf2_sends_a_static_transform_once(start, listen):
    start("tf2_ros", "static_transform_publisher", "1", "2", "3", "0", "0", "0", "1", "a", "b")
    got = listen("/tf_static", load_message("tf2_msgs/TFMessage"))
    until(lambda: got)
    (transform,) = got[0].transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("a", "b")
    place = transform.transform.translation
    assert (place.x, place.y, place.z, transform.transform.rotation.w) == (1, 2, 3, 1)


def test_tf_sends_again_and_again(start, listen, master):
    start("tf", "static_transform_publisher", "0", "0", "1", "0.5", "0", "0", "a", "b", "50")
    got = listen("/tf", load_message("tf2_msgs/TFMessage"))

    def regular():
        stamps = [each.transforms[0].header.stamp.to_sec() for each in got[-5:]]
        return len(stamps) == 5 and 0.15 < stamps[-1] - stamps[0] < 0.5

    until(regular)
    assert got[0].transforms[0].transform.rotation.z == pytest.approx(math.sin(0.25))


@given(st.floats(-3, 3), st.floats(-1.5, 1.5), st.floats(-3, 3))
def test_angles_are_turns_about_fixed_axes(yaw, pitch, roll):
    def times(a, b):
        (x1, y1, z1, w1), (x2, y2, z2, w2) = a, b
        return (
            w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2,
            w1 * y2 - x1 * z2 + y1 * w2 + z1 * x2,
            w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2,
            w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2,
        )

    about_x = (math.sin(roll / 2), 0.0, 0.0, math.cos(roll / 2))
    about_y = (0.0, math.sin(pitch / 2), 0.0, math.cos(pitch / 2))
    about_z = (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))
    assert from_angles(yaw, pitch, roll) == pytest.approx(
        times(times(about_z, about_y), about_x), abs=1e-12
    )


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("tf2_ros", "1 2 3 a b"),
        ("tf2_ros", "1 2 3 0 0 0 a a"),
        ("tf2_ros", "1 2 x 0 0 0 a b"),
        ("tf2_ros", "0 0 0 0 0 0 0 a b"),
        ("tf", "1 2 3 0 0 0 a b"),
        ("tf", "1 2 3 0 0 0 a b 0"),
        ("tf", ""),
    ],
)
def test_wrong_transforms_are_refused(kind, words):
    with pytest.raises(RosError):
        main_of(kind, "static_transform_publisher")(words.split())


# Topic tools -----------------------------------------------------------------------------


def test_relay_passes_all_on(start, listen, talk):
    start("topic_tools", "relay", "/in", "/out")
    got = listen("/out")
    until(lambda: len(got) >= 20)
    numbers = [int(each.data) for each in got]
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_relay_keeps_type_and_latching(start, make_node, master):
    kind = load_message("geometry_msgs/Twist")
    make_node("talker").advertise("/in", kind, latch=True).publish(kind())
    start("topic_tools", "relay", "/in")
    got = []
    make_node("late").subscribe("/in_relay", RawMessage, got.append)
    until(lambda: got)
    header = got[0]._connection_header
    assert (header["type"], header["md5sum"], header["latching"]) == (kind._type, kind._md5sum, "1")
    assert header["message_definition"] == kind._full_text


@pytest.mark.long
def test_throttle_passes_some_on(start, listen, talk):
    begin = time.monotonic()
    start("topic_tools", "throttle", "messages", "/in", "10")
    got = listen("/in_throttle")
    until(lambda: len(got) >= 20)
    assert len(got) <= 11.0 * (time.monotonic() - begin) + 1.0
    numbers = [int(each.data) for each in got]
    assert numbers == sorted(numbers)


@pytest.mark.long
def test_throttle_counts_bytes(start, listen, talk):
    def size():
        return sum(4 + len(each.data) for each in got)

    begin = time.monotonic()
    start("topic_tools", "throttle", "bytes", "/in", "60", "0.5", "/out")
    got = listen("/out")
    until(lambda: size() >= 150)
    assert size() <= 60.0 * (time.monotonic() - begin + 0.5)


@pytest.mark.long
def test_drop_leaves_some_out(start, listen, talk):
    start("topic_tools", "drop", "/in", "2", "3", "/out")
    got = listen("/out")
    until(lambda: len(got) >= 10)
    numbers = [int(each.data) for each in got]
    assert {b - a for a, b in itertools.pairwise(numbers)} == {3}


@pytest.mark.long
def test_mux_switches(start, listen, make_node, talk):
    other = make_node("other").advertise("/other", STRING, latch=True)
    other.publish(STRING(data="x"))
    start("topic_tools", "mux", "/out", "/in", "/other", "__name:=mux")
    got, selected = listen("/out"), listen("/mux/selected")
    until(lambda: len(got) > 5)
    assert "x" not in {each.data for each in got}
    node = make_node("caller")

    def call(name, **fields):
        service = load_service(f"topic_tools/Mux{name}")
        node.wait_for_service(f"/mux/{name.lower()}", 60)
        client = node.client(f"/mux/{name.lower()}", service)
        return client.call(service._request_class(**fields))

    assert call("List").topics == ["/in", "/other"]
    assert call("Select", topic="/other").prev_topic == "/in"

    def quiet():
        got.clear()
        time.sleep(0.3)
        return got == []

    until(quiet)
    assert call("Select", topic="__none").prev_topic == "/other"
    call("Add", topic="/third")
    call("Delete", topic="/in")
    assert call("List").topics == ["/other", "/third"]
    with pytest.raises(RosError):
        call("Select", topic="/nope")
    until(lambda: len(selected) >= 3)
    assert [each.data for each in selected][:3] == ["/in", "/other", "__none"]


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("relay", ""),
        ("relay", "/a /b /c"),
        ("throttle", "messages /a"),
        ("throttle", "messages /a 0"),
        ("throttle", "bytes /a 5"),
        ("throttle", "words /a 5"),
        ("drop", "/a 1"),
        ("drop", "/a 3 2"),
        ("drop", "/a x 2"),
        ("mux", "/a"),
    ],
)
def test_wrong_arguments_are_refused(kind, words):
    with pytest.raises(RosError):
        main_of("topic_tools", kind)(words.split())


def test_a_wrong_command_line_is_one_line_without_traceback(start):
    process = start("topic_tools", "relay")
    process.wait(60)
    said = process.stderr.read()
    assert said.startswith("[topic_tools/relay] give one topic or two")
    assert "Traceback" not in said
    process.returncode = 0


# Command lines ---------------------------------------------------------------------------


def test_command_lines_are_taken_apart(monkeypatch):
    monkeypatch.setenv("ROS_NAMESPACE", "/env")
    words = ["a", "x:=/y", "_p:=[1, 2]", "__name:=n", "__log:=f", "__master:=http://h:1", "b"]
    found = parse_arguments(words, "default")
    assert found.plain == ["a", "b"]
    assert found.parameters == {"p": "[1, 2]"}
    assert found.options == {
        "name": "n",
        "namespace": "/env",
        "remappings": {"x": "/y"},
        "master_uri": "http://h:1",
    }
    assert parse_arguments(["__ns:=/arg"], "default").options["namespace"] == "/arg"


@pytest.mark.long
def test_tools_are_nodes_too(start, listen, master):
    process = start(
        "rostopic",
        "rostopic",
        "pub",
        "-r",
        "20",
        "/out",
        "std_msgs/String",
        "data: hi",
        "__name:=me",
    )
    got = listen("/out")
    until(lambda: len(got) > 3)
    assert got[0].data == "hi"
    assert "/me" in master.api.registrations.nodes
    process.send_signal(signal.SIGINT)
    until(lambda: process.poll() is not None)


@pytest.mark.long
def test_a_node_that_is_asked_to_end_is_off_the_master_when_it_is_gone(start, master):
    words = ["0", "0", "1", "0", "0", "0", "a", "b", "50"]
    for number in range(5):
        process = start("tf", "static_transform_publisher", *words, f"__name:=n{number}")
        with GraphInspector("killer", master.uri) as graph:
            until(lambda: graph.nodes("/"))
            assert kill(graph, [f"/n{number}"]) == []
            assert process.wait(60) == 0
            assert graph.nodes("/") == []
