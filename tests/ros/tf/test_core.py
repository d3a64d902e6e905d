"""The tree of frames: times, interpolation, and what it refuses."""

import math
import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros.base.rotations import conjugate, multiply, rotate, slerp
from gazelle_ros.tf import (
    ConnectivityException,
    ExtrapolationException,
    FrameTree,
    InvalidArgumentException,
    LookupException,
    StampedTransform,
    TransformException,
)
from gazelle_ros.tf.describe import as_dot, as_yaml

S = 1_000_000_000
STILL = (0.0, 0.0, 0.0, 1.0)


def turn_z(angle):
    return (0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2))


@pytest.fixture
def tree():
    tree = FrameTree()
    tree.place("map", "base", 10 * S, (1.0, 0.0, 0.0), STILL)
    tree.place("map", "base", 12 * S, (3.0, 0.0, 0.0), turn_z(1.0))
    tree.place("base", "laser", 0, (0.0, 0.5, 0.0), turn_z(math.pi / 2), static=True)
    return tree


unit = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: sum(c * c for c in q) > 0.01)


def normal(q):
    norm = math.sqrt(sum(c * c for c in q))
    return tuple(c / norm for c in q)


def test_a_time_between_two_is_interpolated(tree):
    found = tree.lookup("map", "base", 11 * S)
    assert found.translation == pytest.approx((2.0, 0.0, 0.0))
    assert found.rotation == pytest.approx(turn_z(0.5))
    assert found.stamp == 11 * S


def test_time_zero_means_the_latest_common_time(tree):
    tree.place("map", "other", 11 * S, (0.0, 0.0, 0.0), STILL)
    found = tree.lookup("other", "laser", 0)
    assert found.stamp == 11 * S
    assert tree.latest_common_time("other", "laser") == 11 * S
    assert tree.latest_common_time("base", "laser") == 0


def test_there_and_back_is_nowhere(tree):
    there, back = tree.lookup("map", "laser", 11 * S), tree.lookup("laser", "map", 11 * S)
    assert multiply(there.rotation, back.rotation) == pytest.approx(STILL)
    assert rotate(back.rotation, there.translation) == pytest.approx(
        tuple(-c for c in back.translation)
    )


@pytest.mark.parametrize(
    ("stamp", "text"),
    [
        (13 * S, "extrapolation 1.000000000s into the future.  Requested time 13.000000000"),
        (9 * S, "extrapolation 1.000000000s into the past.  Requested time 9.000000000"),
    ],
)
def test_times_outside_are_refused_by_tf2s_text(tree, stamp, text):
    with pytest.raises(ExtrapolationException, match=text) as caught:
        tree.lookup("map", "laser", stamp)
    assert str(caught.value).endswith("transform from frame [laser] to frame [map]")


def test_one_placement_is_not_extrapolated():
    tree = FrameTree()
    tree.place("a", "b", 5 * S, (0.0, 0.0, 0.0), STILL)
    with pytest.raises(ExtrapolationException, match=r"but only time 5.000000000 is in the buffer"):
        tree.lookup("a", "b", 6 * S)


def test_static_frames_hold_at_any_time(tree):
    assert tree.lookup("base", "laser", 999 * S).translation == (0.0, 0.5, 0.0)


def test_unknown_frames_and_bad_names(tree):
    with pytest.raises(
        LookupException, match='"nowhere" passed to lookupTransform argument target'
    ):
        tree.lookup("nowhere", "base")
    with pytest.raises(InvalidArgumentException, match="cannot be empty"):
        tree.lookup("", "base")
    with pytest.raises(InvalidArgumentException, match="cannot start with a '/'"):
        tree.lookup("/map", "base")


def test_two_trees_are_not_connected(tree):
    tree.place("x", "y", 11 * S, (0.0, 0.0, 0.0), STILL)
    for stamp in (0, 11 * S):
        with pytest.raises(ConnectivityException, match="two or more unconnected trees"):
            tree.lookup("map", "y", stamp)
    with pytest.raises(TransformException):
        tree.latest_common_time("map", "y")


def test_a_loop_is_found():
    tree = FrameTree()
    for parent, child in ("ab", "bc", "ca"):
        tree.place(parent, child, S, (0.0, 0.0, 0.0), STILL)
    tree.place("w", "x", S, (0.0, 0.0, 0.0), STILL)
    for stamp in (0, S):
        with pytest.raises(LookupException, match="contains a loop"):
            tree.lookup("w", "c", stamp)


@pytest.mark.parametrize(
    ("parent", "child", "translation", "rotation", "word"),
    [
        ("a", "a", (0.0, 0.0, 0.0), STILL, "TF_SELF_TRANSFORM"),
        ("a", "", (0.0, 0.0, 0.0), STILL, "TF_NO_CHILD_FRAME_ID"),
        ("", "a", (0.0, 0.0, 0.0), STILL, "TF_NO_FRAME_ID"),
        ("a", "b", (math.nan, 0.0, 0.0), STILL, "TF_NAN_INPUT"),
        ("a", "b", (0.0, -math.inf, 0.0), STILL, "TF_NAN_INPUT"),
        ("a", "b", (10**400, 0.0, 0.0), STILL, "TF_NAN_INPUT"),
        ("a", "b", (0.0, 0.0, 0.0), (0, 0, 0, 10**400), "TF_NAN_INPUT"),
        ("a", "b", (1.0, 2.0), STILL, "3 and 4 numbers"),
        ("a", "b", (), STILL, "3 and 4 numbers"),
        ("a", "b", 1.0, STILL, "3 and 4 numbers"),
        ("a", "b", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), "3 and 4 numbers"),
        ("a", "b", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), "TF_DENORMALIZED_QUATERNION"),
    ],
)
def test_impossible_placements_are_refused_and_logged(
    caplog, parent, child, translation, rotation, word
):
    tree = FrameTree()
    assert not tree.place(parent, child, S, translation, rotation, authority="me")
    assert word in caplog.text
    assert tree.names() == []


@pytest.mark.parametrize("number", [math.nan, math.inf, 10**400])
def test_transforms_are_of_finite_numbers(number):
    for parts in (((number, 0.0, 0.0), STILL), ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, number))):
        with pytest.raises(InvalidArgumentException, match="must be finite"):
            StampedTransform(S, *parts)


def test_old_and_repeated_data_is_ignored(tree, caplog):
    assert not tree.place("map", "base", 12 * S, (9.0, 0.0, 0.0), STILL)
    assert not tree.place("map", "base", 1 * S, (9.0, 0.0, 0.0), STILL)
    assert "TF_REPEATED_DATA" in caplog.text
    assert "TF_OLD_DATA" in caplog.text
    assert tree.lookup("map", "base").translation == (3.0, 0.0, 0.0)


def test_late_data_finds_its_place(tree):
    assert tree.place("map", "base", 11 * S, (7.0, 0.0, 0.0), STILL)
    assert tree.lookup("map", "base", 11 * S).translation == (7.0, 0.0, 0.0)


def test_only_the_last_seconds_are_kept():
    tree = FrameTree(2 * S)
    for tick in range(2000):
        tree.place("a", "b", S + tick * S // 100, (float(tick), 0.0, 0.0), STILL)
    newest = S + 1999 * S // 100
    assert tree.lookup("a", "b", newest - 2 * S).translation == pytest.approx((1799.0, 0, 0))
    with pytest.raises(ExtrapolationException, match="into the past"):
        tree.lookup("a", "b", newest - 2 * S - 1)
    assert tree.known()[0][2].span()[0] == 201


def test_clear_keeps_static_frames(tree):
    tree.clear()
    assert tree.names() == ["base", "map", "laser"]
    assert tree.lookup("base", "laser").translation == (0.0, 0.5, 0.0)
    with pytest.raises(ConnectivityException):
        tree.lookup("map", "base")


def test_a_frame_may_change_its_parent():
    tree = FrameTree()
    tree.place("p", "x", 1 * S, (1.0, 0.0, 0.0), STILL)
    tree.place("q", "x", 3 * S, (2.0, 0.0, 0.0), STILL)
    assert tree.lookup("p", "x", 2 * S).translation == (1.0, 0.0, 0.0)
    assert tree.lookup("q", "x", 0).translation == (2.0, 0.0, 0.0)


def test_lookups_through_a_fixed_frame(tree):
    moved = tree.lookup_full("base", 12 * S, "base", 10 * S, "map")
    assert moved.translation == pytest.approx(rotate(conjugate(turn_z(1.0)), (-2.0, 0.0, 0.0)))
    assert moved.stamp == 12 * S


def test_the_chain_names_the_way(tree):
    tree.place("map", "other", 11 * S, (0.0, 0.0, 0.0), STILL)
    assert tree.chain("other", 0, "laser", 0, "map") == ["laser", "base", "map", "other"]
    assert tree.chain("laser", 0, "other", 0, "map") == ["other", "map", "base", "laser"]


def test_descriptions_name_every_frame(tree):
    assert as_yaml(tree).count("parent:") == 2
    assert as_yaml(FrameTree()) == "{}"
    assert '"map" -> "base"' in as_dot(tree)
    assert "( 1.000 sec old)" in as_dot(tree, 13 * S)


@given(unit, unit, st.floats(0, 1))
def test_slerp_turns_evenly_and_keeps_the_norm(a, b, ratio):
    a, b = normal(a), normal(b)
    between = slerp(a, b, ratio)
    assert sum(c * c for c in between) == pytest.approx(1.0, abs=1e-9)
    whole = 2 * math.acos(min(1.0, abs(np.dot(a, b))))
    part = 2 * math.acos(min(1.0, abs(np.dot(a, between))))
    assert part == pytest.approx(ratio * whole, abs=1e-6)


def test_a_hundred_frames_at_a_hundred_hertz_cost_little():
    def filled():
        tree = FrameTree()
        start = time.process_time()
        for tick in range(1, 51):
            for joint in range(100):
                place = (0.0, 0.0, 0.1)
                tree.place(f"link{joint}", f"link{joint + 1}", tick * S // 100, place, STILL)
        end = time.process_time()
        tree.lookup("link0", "link100")
        return end - start

    # Half a second's worth. What else runs on the processor makes it slower, never faster.
    assert min(filled() for _ in range(5)) < 0.4
