"""Names resolve, remap and are refused as ROS 1 does it."""

from __future__ import annotations

import pytest

from gazelle_ros import names
from gazelle_ros.errors import InvalidNameError


@pytest.mark.parametrize(
    ("name", "node", "expected"),
    [
        ("t", "/n", "/t"),
        ("/t", "/n", "/t"),
        ("~t", "/n", "/n/t"),
        ("", "/n", "/"),
        ("a/b", "/n", "/a/b"),
        ("t", "/ns/n", "/ns/t"),
        ("/t", "/ns/n", "/t"),
        ("~t", "/ns/n", "/ns/n/t"),
        ("~/t", "/ns/n", "/ns/n/t"),
        ("", "/ns/n", "/ns/"),
        ("t/", "/n", "/t"),
        ("//a//b", "/n", "/a/b"),
    ],
)
def test_resolution(name, node, expected):
    assert names.resolve(name, node) == expected


def test_remapping_goes_by_whole_resolved_names():
    mappings = names.resolve_remappings(
        {"foo": "bar", "~p": "/glob", "ns2": "ns3", "_rate": "5", "__name": "x"}, "/ns/n"
    )
    assert mappings == {"/ns/foo": "/ns/bar", "/ns/n/p": "/glob", "/ns/ns2": "/ns/ns3"}
    assert names.resolve("foo", "/ns/n", mappings) == "/ns/bar"
    assert names.resolve("~foo", "/ns/n", mappings) == "/ns/n/foo"
    assert names.resolve("~p", "/ns/n", mappings) == "/glob"
    assert names.resolve("ns2/t", "/ns/n", mappings) == "/ns/ns2/t"


def test_arguments_are_split_from_remappings():
    plain, mappings = names.split_arguments(["--x", "a:=b", "y", "_p:=1:=2", ":=z"])
    assert plain == ["--x", "y"]
    assert mappings == {"a": "b", "_p": "1:=2"}


@pytest.mark.parametrize("name", ["", "1a", "a b", "a-b", "é", "/a//b", "a.b", "-"])
def test_illegal_names(name):
    with pytest.raises(InvalidNameError):
        names.check(name)


@pytest.mark.parametrize("name", ["a", "/a", "~a", "/a/b_c", "A9", "/", "~"])
def test_legal_names(name):
    assert names.check(name) == name


@pytest.mark.parametrize(
    ("text", "expected"), [("", "/"), ("/", "/"), ("a", "/a/"), ("/a/", "/a/"), ("a/b", "/a/b/")]
)
def test_namespaces_have_slashes_at_both_ends(text, expected):
    assert names.as_namespace(text) == expected
