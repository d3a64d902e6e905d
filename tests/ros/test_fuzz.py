"""Garbage on every port: nothing hangs, nothing dies, healthy peers notice nothing."""

from __future__ import annotations

import os
import random
import socket
import struct
import threading

import pytest
from ros.graph import Flag, Text, until

from gazelle_ros import Master, MasterProxy
from gazelle_ros.limits import NetworkLimits
from gazelle_ros.net import split_uri
from gazelle_ros.tcpros import headers
from gazelle_ros.xmlrpc.http import request
from gazelle_ros.xmlrpc.writing import write_call

ROUNDS = int(os.environ.get("GAZELLE_FUZZ_ROUNDS", "600"))
"""600 take a second or two; a release is checked with half a million."""

TOPIC_HEADER = {
    "callerid": "/fuzz",
    "topic": "/chatter",
    "type": Text._type,
    "md5sum": Text._md5sum,
}
SERVICE_HEADER = {
    "callerid": "/fuzz",
    "service": "/flip",
    "md5sum": Flag._md5sum,
    "persistent": "1",
}


def seeds():
    """Return good beginnings of conversations, to be spoiled."""
    call = request("x", "/RPC2", write_call("setParam", ("/fuzz", "/p", {"a": [1, 2.5, "x"]})))
    return [
        call,
        call * 3,
        request("x", "/", write_call("registerPublisher", ("/fuzz", "/t", "a/b", "http://x:1/"))),
        request("x", "/", write_call("publisherUpdate", ("/master", "/other", ["http://"]))),
        request("x", "/", write_call("requestTopic", ("/fuzz", "/chatter", [["TCPROS"]]))),
        headers.encode(TOPIC_HEADER),
        headers.encode(SERVICE_HEADER) + struct.pack("<I", 1) + b"\1",
        b"\xff" * 64,
        b"\0" * 64,
        b"GET / HTTP/1.1\r\n\r\n",
        b"POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n",
        b"POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n",
        b"",
    ]


def spoil(data, rng):
    """Change, cut, repeat or insert some bytes."""
    data = bytearray(data)
    for _ in range(rng.randint(0, 6)):
        place = rng.randint(0, len(data))
        what = rng.randrange(5)
        if what == 0 and data:
            data[place % len(data)] = rng.randrange(256)
        elif what == 1:
            del data[place : place + rng.randint(1, 40)]
        elif what == 2:
            data[place:place] = bytes(rng.randrange(256) for _ in range(rng.randint(1, 40)))
        elif what == 3:
            data[place:place] = data[: rng.randint(0, 200)]
        else:
            data[place:place] = rng.choice([b"<value>", b"]]>", b"\r\n\r\n", b"&#0;", b"<i8>9"])
    return bytes(data)


def throw(port, data, rng):
    """Send it in one or two pieces; read or leave at once."""
    with socket.create_connection(("127.0.0.1", port), timeout=60) as sock:
        sock.settimeout(0.05)
        try:
            cut = rng.randint(0, len(data))
            sock.sendall(data[:cut])
            sock.sendall(data[cut:])
            if rng.random() < 0.3:
                sock.recv(65536)
        except OSError:
            pass


@pytest.mark.long
@pytest.mark.timeout(3600)
def test_garbage_on_every_port_disturbs_nobody(master, make_node, strangers, caplog):
    node, listener = make_node("node"), make_node("listener")
    got = []
    publisher = node.advertise("chatter", Text, queue_size=None)
    listener.subscribe("chatter", Text, got.append)
    node.serve("flip", Flag, lambda request: (not request.data, ""))
    client = listener.client("flip", Flag, persistent=True)
    until(lambda: publisher.num_connections == 1)
    ports = [master.port, split_uri(node.uri)[1], node.tcpros_port, split_uri(listener.uri)[1]]
    rng = random.Random(ROUNDS)
    for number in range(ROUNDS):
        throw(rng.choice(ports), spoil(rng.choice(seeds()), rng), rng)
        publisher.publish(Text(str(number)))
        if number % 20 == 0:
            assert client.call(Flag._request_class(False)).success
            assert listener.master.get_pid()
    until(lambda: len(got) == ROUNDS)
    assert [message.data for message in got] == [str(number) for number in range(ROUNDS)]
    assert "a socket's handler" not in caplog.text
    assert "a call on the event loop" not in caplog.text


def test_a_publisher_that_lies_does_not_hurt_its_subscriber(master, make_node):
    listener = make_node("listener")
    got = []
    listener.subscribe("chatter", Text, got.append)
    reply = headers.encode(TOPIC_HEADER | {"latching": "0"})
    good = struct.pack("<II", 6, 2) + b"ok"
    answers = [
        b"",
        b"\xff\xff\xff\xff",
        struct.pack("<I", 5) + b"abcde",
        headers.encode({"error": "no"}),
        headers.encode({"type": "x/Y", "md5sum": "0" * 32}),
        reply + b"\xff\xff\xff\xff",
        reply + struct.pack("<I", 3) + b"abc" + good,
        reply + good,
    ]
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]

        def lie():
            for answer in answers:
                sock, _ = server.accept()
                with sock:
                    sock.recv(4096)
                    sock.sendall(answer)
                    sock.settimeout(0.2)
                    try:
                        while sock.recv(4096):
                            pass
                    except OSError:
                        pass

        thread = threading.Thread(target=lie)
        thread.start()

        def dispatch(method, params):
            return [1, "", ["TCPROS", "127.0.0.1", port]]

        from gazelle_ros import loop
        from gazelle_ros.xmlrpc.server import XmlRpcServer

        running = loop.acquire()
        slave = XmlRpcServer(running, "127.0.0.1", 0, dispatch)
        liar = MasterProxy(master.uri, "/liar")
        liar.register_publisher("/chatter", Text._type, slave.uri)
        liar.close()
        listener.loop.run(lambda: listener.subscription("/chatter").update([slave.uri]))
        # Waiting between attempts doubles each time, which is too patient for a test.
        link = listener.subscription("/chatter").links[slave.uri]
        while thread.is_alive():
            link._retry_s = 0.01
            thread.join(0.01)
        until(lambda: len(got) >= 2)
        assert {message.data for message in got} == {"ok"}
        slave.close()
        loop.release(running)


def test_a_request_beyond_the_limits_is_refused(master):
    small = NetworkLimits(xml_bytes=2000, xml_depth=5, http_header_bytes=500, xml_values=20)
    with Master(port=0, rosout=False, limits=small) as master:

        def status(data):
            with socket.create_connection(("127.0.0.1", master.port), timeout=60) as sock:
                sock.sendall(data)
                return sock.recv(4096).decode()

        deep = write_call("setParam", ("/f", "/p", [[[[[[[1]]]]]]]))
        wide = write_call("setParam", ("/f", "/p", list(range(30))))
        bomb = (
            b'<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a "aaaaaaaa"><!ENTITY c "&a;&a;&a;">]>'
            b"<methodCall><methodName>&c;</methodName></methodCall>"
        )
        assert "413" in status(request("x", "/", b"x" * 3000)).split("\r\n")[0]
        assert "431" in status(b"POST / HTTP/1.1\r\nX: " + b"y" * 1000)
        assert "nested deeper" in status(request("x", "/", deep))
        assert "more than 20 values" in status(request("x", "/", wide))
        assert "document types are refused" in status(request("x", "/", bomb))
        assert "200 OK" in status(request("x", "/", write_call("getPid", ("/f",))))


def test_half_open_connections_end_by_themselves(make_node):
    node = make_node("node", limits=NetworkLimits(handshake_seconds=0.2))
    with socket.create_connection(("127.0.0.1", node.tcpros_port), timeout=60) as sock:
        sock.sendall(b"\x10")
        assert sock.recv(10) == b""


def test_too_many_connections_are_turned_away(make_node):
    node = make_node("node", limits=NetworkLimits(connections=10))
    socks = [socket.create_connection(("127.0.0.1", node.tcpros_port)) for _ in range(20)]
    try:
        socks[-1].settimeout(60)
        assert socks[-1].recv(1) == b""
    finally:
        for sock in socks:
            sock.close()
    publisher = node.advertise("chatter", Text, latch=True)
    publisher.publish(Text("alive"))
    assert node.wait_for_message("chatter", Text, timeout=60).data == "alive"


def test_a_request_of_impossible_length_right_after_the_header_ends_the_connection(make_node):
    node = make_node("node")
    node.serve("flip", Flag, lambda request: (True, ""))
    for _ in range(3):
        with socket.create_connection(("127.0.0.1", node.tcpros_port), timeout=60) as sock:
            sock.sendall(headers.encode(SERVICE_HEADER) + b"\xff\xff\xff\xff")
            while sock.recv(4096):
                pass
    assert node.client("flip", Flag).call(Flag._request_class()).success
