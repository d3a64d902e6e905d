"""No web page can call a master or a node past the browser's guard; every ROS client can."""

from __future__ import annotations

import http.client
import xmlrpc.client

import pytest

from gazelle_ros import Master, Node

CALL = xmlrpc.client.dumps(("/test", "/seen", 1), "setParam")


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


def post(uri, headers, method="POST"):
    host, _, port = uri.removeprefix("http://").rstrip("/").rpartition(":")
    connection = http.client.HTTPConnection(host, int(port), timeout=60)
    try:
        connection.request(method, "/", CALL, headers)
        return connection.getresponse().status
    finally:
        connection.close()


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "https://example.org", "Content-Type": "text/plain"},
        {"Origin": "null", "Content-Type": "application/x-www-form-urlencoded"},
        {"origin": "http://localhost:8000", "Content-Type": "multipart/form-data; boundary=x"},
        {"Sec-Fetch-Site": "cross-site", "Content-Type": "text/plain"},
        {"Origin": "https://example.org", "Content-Type": "text/xml"},
    ],
)
def test_what_a_page_sends_is_refused(master, headers):
    assert post(master.uri, headers) == 403
    assert not master.api.parameters.has("/seen")
    with Node("robot", master_uri=master.uri) as node:
        assert post(node.uri, headers) == 403


def test_browsers_that_ask_first_are_not_let_in(master):
    asked = {"Origin": "https://example.org", "Access-Control-Request-Method": "POST"}
    assert post(master.uri, asked, "OPTIONS") == 501


@pytest.mark.parametrize(
    "headers",
    [
        {"Content-Type": "text/xml", "User-Agent": "Python-xmlrpc/3.11"},
        {"Content-Type": "text/xml", "User-Agent": "XMLRPC++ 0.7"},
        {"Content-Type": "text/xml", "User-Agent": "Apache XML RPC 3.1.3"},
        {"Content-Type": "text/xml", "User-Agent": "NodeJS XML-RPC Client", "Accept": "text/xml"},
        {"Content-Type": "application/x-www-form-urlencoded", "User-Agent": "curl/8.5"},
        {},
    ],
)
def test_ros_clients_call_as_ever(master, headers):
    assert post(master.uri, headers) == 200
    assert master.api.parameters.has("/seen")
