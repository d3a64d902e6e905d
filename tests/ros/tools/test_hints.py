"""Hints of the tools at small mistakes."""

from __future__ import annotations

import io
import threading

import pytest
from ros.graph import until

from gazelle_ros import load_message, load_service
from gazelle_ros.errors import ProtocolError, report
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import keep_text_fields
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.listing import closest_topic, topic_type
from gazelle_ros.tools.watching import wait_for_topic

ODOMETRY = load_message("nav_msgs/Odometry")


@pytest.fixture
def graph(master, make_node):
    make_node("robot").advertise("/odom", ODOMETRY)
    with GraphInspector("rostopic", master.uri) as made:
        yield made


def test_a_topic_that_is_not_there_is_answered_with_the_closest(graph, monkeypatch):
    assert closest_topic(graph, "/odmo") == "did you mean '/odom'?"
    assert closest_topic(graph, "/something/else") is None
    with pytest.raises(ToolError) as caught:
        topic_type(graph, "odmo")
    assert caught.value.hint == "did you mean '/odom'?"
    stop, said = threading.Event(), io.StringIO()
    monkeypatch.setattr("sys.stderr", said)
    waiting = threading.Thread(target=wait_for_topic, args=(graph, "/odmo", stop))
    waiting.start()
    until(lambda: "did you mean '/odom'?" in said.getvalue())
    stop.set()
    waiting.join()


def test_a_field_that_is_not_there_is_named(graph):
    hint = closest_topic(graph, "/odom/pose/pose/positoin")
    assert hint == "the topic /odom is there, but nav_msgs/Odometry has no pose/pose/positoin"


def test_numbers_for_texts_are_texts():
    text = load_message("std_msgs/String")()
    assert keep_text_fields(text, [2.0]) == ["2.0"]
    assert keep_text_fields(text, [{"data": 5}]) == [{"data": "5"}]
    assert keep_text_fields(text, [True]) == [True]
    request = load_service("gazelle_msgs/Step")._request_class()
    assert keep_text_fields(request, [10]) == [10]
    assert keep_text_fields(request, [1, 2]) == [1, 2]


def test_what_a_peer_does_wrong_is_one_line_and_what_users_do_has_a_traceback(caplog):
    report("peer", ProtocolError("refused"))
    assert "refused" in caplog.text
    assert "Traceback" not in caplog.text
    try:
        raise ProtocolError("mine")  # noqa: TRY301  # raised by a user
    except ProtocolError as error:
        report("callback", error)
    assert "Traceback" in caplog.text
