"""XML-RPC documents: the standard library reads what is written and writes what is read."""

from __future__ import annotations

import contextlib
import xmlrpc.client

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.base.package_folders import package_folders
from gazelle_ros.compat.rospkg.manifest import InvalidManifest, parse_manifest_file
from gazelle_ros.errors import FaultError, MarshalError, ProtocolError
from gazelle_ros.launch.document import parse_element
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.xmlrpc.http import MessageReader, request, response
from gazelle_ros.xmlrpc.reading import read_call, read_response
from gazelle_ros.xmlrpc.writing import write_call, write_fault, write_response

# The standard library turns a lone carriage return into a line feed, as XML says.
TEXTS = st.text(
    st.characters(blacklist_categories=("Cs", "Cc"), blacklist_characters="\ufffe\uffff"),
    max_size=30,
)
SCALARS = st.booleans() | st.integers(-(2**31), 2**31 - 1) | st.floats(allow_nan=False) | TEXTS
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(TEXTS, inner, max_size=4),
    max_leaves=12,
)


@given(st.lists(VALUES, max_size=4))
def test_the_standard_library_reads_our_calls(params):
    read, method = xmlrpc.client.loads(write_call("getParam", params))
    assert method == "getParam"
    assert list(read) == params


@given(st.lists(VALUES, max_size=4))
def test_we_read_the_standard_librarys_calls(params):
    document = xmlrpc.client.dumps(tuple(params), "setParam").encode()
    assert read_call(document) == ("setParam", params)


@given(VALUES)
def test_answers_survive_both_ways(value):
    assert read_response(write_response(value)) == value
    assert xmlrpc.client.loads(write_response(value))[0] == (value,)


@given(st.binary(max_size=300))
def test_noise_is_refused_not_crashed_on(noise):
    for read in (read_call, read_response):
        with contextlib.suppress(MarshalError, FaultError):
            read(noise)


@given(st.data())
def test_spoiled_documents_are_refused_not_crashed_on(data):
    document = write_call("setParam", ("/a", {"x": [1, 2.5, "y", True]}))
    start = data.draw(st.integers(0, len(document)))
    stop = data.draw(st.integers(start, len(document)))
    spoiled = document[:start] + data.draw(st.binary(max_size=20)) + document[stop:]
    with contextlib.suppress(MarshalError):
        read_call(spoiled)


@given(st.lists(st.binary(max_size=200), max_size=5), st.integers(1, 50))
def test_requests_are_found_however_the_stream_is_cut(bodies, step):
    stream = b"".join(request("h", "/RPC2", body) for body in bodies)
    reader, found = MessageReader(), []
    for start in range(0, len(stream), step):
        reader.feed(stream[start : start + step])
        while (message := reader.next()) is not None:
            found.append(message.body)
    assert found == bodies
    assert not reader


@given(st.binary(max_size=400))
def test_noise_is_no_http(noise):
    reader = MessageReader()
    reader.feed(noise)
    with contextlib.suppress(ProtocolError):
        reader.next()


@pytest.mark.parametrize("encoding", ["utf-7", "utf-32", "rot13", "idna", "nonsense", "mbcs"])
def test_an_encoding_that_the_parser_refuses_is_one_error(encoding, tmp_path):
    head = f"<?xml version='1.0' encoding='{encoding}'?>".encode()
    with pytest.raises(MarshalError, match="not an XML-RPC document"):
        read_call(head + b"<methodCall><methodName>x</methodName><params/></methodCall>")
    with pytest.raises(LaunchError, match="the encoding cannot be read"):
        parse_element(head + b"<launch/>", "x.launch")
    (tmp_path / "package.xml").write_bytes(head + b"<package><name>x</name></package>")
    with pytest.raises(InvalidManifest, match=r"package\.xml"):
        parse_manifest_file(str(tmp_path))
    assert list(package_folders(tmp_path))


@pytest.mark.parametrize(
    "value", [None, 2**31, -(2**31) - 1, {1: 2}, "bell \a", object(), {"a": [None]}]
)
def test_what_xmlrpc_cannot_carry_is_refused_by_the_writer(value):
    with pytest.raises(MarshalError):
        write_call("setParam", ("/x", value))


def test_numpy_numbers_dates_and_bytes_are_carried():
    numpy = pytest.importorskip("numpy")
    value = [numpy.float64(1.5), numpy.int32(3), numpy.array([1, 2]), b"\0\1"]
    got = read_response(write_response(value))
    assert got[:3] == [1.5, 3, [1, 2]]
    assert got[3].data == b"\0\1"
    date = xmlrpc.client.DateTime("20200102T03:04:05")
    assert read_response(write_response(date)) == date


def test_a_fault_is_raised():
    with pytest.raises(FaultError, match="fault 3: no"):
        read_response(write_fault(3, "no"))


@pytest.mark.parametrize(
    "document",
    [
        "<methodCall/>",
        "<methodCall><methodName>x</methodName><value/></methodCall>",
        (
            "<methodCall><methodName>x</methodName><params><param><value><int>x</int></value>"
            "</param></params></methodCall>"
        ),
        (
            "<methodCall><methodName>x</methodName><params><param><value><int>1</int><int>2</int>"
            "</value></param></params></methodCall>"
        ),
        (
            "<methodCall><methodName>x</methodName><params><param><value><struct><member>"
            "<value>1</value></member></struct></value></param></params></methodCall>"
        ),
        "<!DOCTYPE x><methodCall><methodName>x</methodName></methodCall>",
        "<methodResponse/>",
    ],
)
def test_malformed_calls_are_refused(document):
    with pytest.raises(MarshalError):
        read_call(document.encode())


def test_a_value_without_type_is_a_string():
    document = (
        b"<methodCall><methodName> x </methodName><params><param><value> a </value></param>"
        b"<param><value/></param></params></methodCall>"
    )
    assert read_call(document) == ("x", [" a ", ""])


def test_old_http_ends_the_connection_and_new_keeps_it():
    reader = MessageReader(response=True)
    reader.feed(b"HTTP/1.0 200 OK\r\n\r\nrest of the stream")
    assert reader.next() is None
    assert reader.end().body == b"rest of the stream"
    reader = MessageReader(response=True)
    reader.feed(response(200, b"x"))
    message = reader.next()
    assert message.keep_alive
    assert message.body == b"x"
