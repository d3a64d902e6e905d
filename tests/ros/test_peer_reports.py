"""A peer's malformed messages are one line in the log, and not too often."""

from __future__ import annotations

import logging

import pytest
from ros.graph import until

from gazelle_ros import Master, Node, load_message, load_service
from gazelle_ros.peer_reports import PeerReports


@pytest.fixture
def lines(caplog):
    caplog.set_level(logging.ERROR, logger="gazelle.ros")
    return lambda: [record.getMessage() for record in caplog.records]


def test_one_line_for_each_peer_and_no_traceback(lines):
    reports = PeerReports()
    for _ in range(1000):
        for peer in ("/a", "/b"):
            error = UnicodeDecodeError("utf-8", b"\xff", 0, 1, "invalid\nstart byte")
            reports.complain("subscriber of /scan", peer, error)
    assert len(lines()) == 2
    for line, peer in zip(lines(), ("/a", "/b"), strict=True):
        assert "\n" not in line
        assert f"malformed message from {peer}: UnicodeDecodeError" in line


def test_what_was_not_told_is_counted(lines, monkeypatch):
    now = [0.0]
    monkeypatch.setattr("gazelle_ros.peer_reports.time.monotonic", lambda: now[0])
    reports = PeerReports()
    for now[0] in (0.0, 1.0, 2.0, 11.0):
        reports.complain("a call", "/a", ValueError("bad"))
    assert len(lines()) == 2
    assert lines()[1].endswith("(2 more since the last report)")


def test_it_remembers_no_more_peers_than_a_limit(lines):
    reports = PeerReports()
    for number in range(5000):
        reports.complain("a call", f"/{number}", ValueError("bad"))
    assert len(reports._accounts) <= 256
    assert len(lines()) == 5000


class Garbage:
    """std_msgs/Header, with bytes that are none."""

    _type = "std_msgs/Header"
    _md5sum = load_message("std_msgs/Header")._md5sum
    _full_text = load_message("std_msgs/Header")._full_text
    _has_header = False
    __slots__ = ()
    _slot_types = ()

    def serialize(self, buff):
        buff.write(b"\x00" * 12 + b"\xff\xff\xff\x7f")


@pytest.fixture
def graph():
    with (
        Master(port=0, rosout=False) as master,
        Node("good", master_uri=master.uri) as good,
        Node("bad", master_uri=master.uri) as bad,
    ):
        yield good, bad


def test_malformed_messages_of_a_publisher(graph, lines):
    good, bad = graph
    header, heard = load_message("std_msgs/Header"), []
    good.subscribe("words", header, heard.append)
    wrong, right = bad.advertise("words", Garbage, 10), good.advertise("words", header, 10)
    until(lambda: wrong.num_connections and right.num_connections)
    for _ in range(50):
        wrong.publish(Garbage())
    until(lambda: [line for line in lines() if "malformed" in line])
    right.publish(header(seq=7))
    until(lambda: heard)
    (line,) = [line for line in lines() if "malformed" in line]
    assert line.startswith("subscriber of /words: malformed message from /bad: ")
    assert "Traceback" not in "".join(lines())


def test_a_callback_that_fails_keeps_its_traceback(graph, lines):
    good, bad = graph
    header = load_message("std_msgs/Header")

    def callback(_message):
        raise ValueError("mine")

    good.subscribe("words", header, callback)
    words = bad.advertise("words", header, 10)
    until(lambda: words.num_connections)
    words.publish(header())
    until(lambda: [line for line in lines() if "Traceback" in line and "mine" in line])


def test_a_malformed_request_is_answered_and_told_once(graph, lines):
    good, _ = graph
    service = good.serve("work", load_service("std_srvs/SetBool"), lambda _request: None)
    server = service if hasattr(service, "answer") else service._server
    for _ in range(5):
        assert server.answer(b"", {"callerid": "/bad"})[:1] == b"\x00"
    (line,) = [line for line in lines() if "malformed" in line]
    assert "from /bad" in line
