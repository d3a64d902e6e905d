"""Joints by the links that they connect."""

from typing import NamedTuple

import pytest

from gazelle.kinematics.joint_graph import JointGraph


class Joint(NamedTuple):
    name: str
    parent: str
    child: str


def graph(text):
    """Return joints such as ``a>b``, named ``ab``."""
    pairs = [pair.split(">") for pair in text.split()]
    return JointGraph(Joint(parent + child, parent, child) for parent, child in pairs)


def names(joints):
    return " ".join(joint.name for joint in joints)


@pytest.mark.parametrize(
    ("text", "root", "expected"),
    [
        ("a>b b>c a>d b>e", "a", "ab bc be ad"),
        ("a>b b>c a>d b>e", "b", "bc be"),
        ("b>c a>d a>b", "a", "ad ab bc"),
        ("a>b", "x", ""),
        ("a>b b>a", "a", "ab ba"),
        ("a>b b>c c>b", "a", "ab bc"),
    ],
)
def test_joints_beyond_a_link_come_depth_first(text, root, expected):
    assert names(graph(text).outwards(root)) == expected


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [
        ("c", "d", "bc ab ad"),
        ("a", "e", "be ab"),
        ("c", "e", "bc be"),
        ("c", "c", ""),
        ("x", "d", "ad"),
    ],
)
def test_the_way_between_two_links_leads_over_their_common_link(first, second, expected):
    found = graph("a>b b>c a>d b>e")
    assert names(found.between(first, second)) == expected
    assert set(found.between(second, first)) == set(found.between(first, second))


@pytest.mark.parametrize(
    ("text", "link", "closing"),
    [
        ("a>b b>c", "c", None),
        ("a>b b>a", "a", "ab"),
        ("a>b b>c c>a c>d", "d", "ca"),
        ("a>a", "a", "aa"),
    ],
)
def test_a_ring_is_named_by_the_joint_that_closes_it(text, link, closing):
    found = graph(text).ring(link)
    assert (None if found is None else found.name) == closing


def test_of_two_joints_that_hold_one_link_the_first_does():
    found = graph("a>c b>c a>b")
    assert names(found.rest) == "bc"
    assert names(found.inwards("c")) == "ac"
    assert found.roots("abc") == ["a"]
