"""Messages as JSON and CBOR, and back."""

from __future__ import annotations

import base64
import io
import json
import math

import cbor2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle_ros import load_message
from gazelle_ros.messages import MessageException, register
from gazelle_ros.rosbridge.cbor import cbor_values
from gazelle_ros.rosbridge.fragments import FragmentBuffer, split_text, text_as_png, text_of_png
from gazelle_ros.rosbridge.values import fill_message, json_values
from gazelle_ros.time import Time

NOW = Time(5, 6)
TYPES = {
    "a": ("bool", st.booleans()),
    "b": ("int8", st.integers(-128, 127)),
    "c": ("uint8", st.integers(0, 255)),
    "d": ("uint64", st.integers(0, 2**64 - 1)),
    "e": ("float64", st.floats(allow_infinity=False)),
    "f": ("string", st.text(st.characters(exclude_categories=["Cs"]))),
    "g": ("int64[]", st.lists(st.integers(-(2**63), 2**63 - 1))),
    "h": (
        "float32[3]",
        st.lists(st.floats(width=32, allow_infinity=False), min_size=3, max_size=3),
    ),
    "i": ("uint8[]", st.binary()),
    "j": ("char[2]", st.binary(min_size=2, max_size=2)),
    "k": ("string[]", st.lists(st.text(st.characters(exclude_categories=["Cs"])))),
    "l": ("bool[]", st.lists(st.booleans())),
    "m": ("byte[]", st.lists(st.integers(-128, 127))),
}
register(
    "bridge_test", "All", "".join(f"{kind} {name}\n" for name, (kind, _) in TYPES.items()), "msg"
)
ALL = load_message("bridge_test/All")


def over_the_wire(message):
    """Return a message as it comes from the graph: arrays are views of their bytes."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return type(message)().deserialize(buffer.getvalue(), numpy=True)


def same(one, other):
    if isinstance(one, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    return one == other


@settings(max_examples=40)
@given(st.fixed_dictionaries({name: values for name, (_, values) in TYPES.items()}))
def test_any_message_comes_back_from_json(values):
    message = over_the_wire(ALL(**values))
    text = json.dumps(json_values(message), allow_nan=False)
    back = fill_message(ALL(), json.loads(text), NOW)
    for name, value in values.items():
        assert same(value, getattr(back, name)), name


@settings(max_examples=40)
@given(st.fixed_dictionaries({name: values for name, (_, values) in TYPES.items()}))
def test_any_message_is_whole_in_cbor(values):
    found = cbor2.loads(cbor2.dumps(cbor_values(over_the_wire(ALL(**values)))))
    kinds = {78: "<i4", 79: "<i8", 85: "<f4", 86: "<f8", 72: "i1"}
    for name, value in values.items():
        got = found[name]
        if hasattr(got, "tag"):
            got = np.frombuffer(got.value, kinds[got.tag]).tolist()
        assert same(value, got), name


def test_nothing_infinite_is_in_json():
    scan = load_message("sensor_msgs/LaserScan")(
        ranges=[1.0, math.inf, math.nan, -math.inf], range_max=math.inf
    )
    values = json_values(over_the_wire(scan))
    assert values["ranges"] == [1.0, None, None, None]
    assert values["range_max"] is None
    back = fill_message(load_message("sensor_msgs/LaserScan")(), {"ranges": [None, 2]}, NOW)
    assert math.isnan(back.ranges[0])
    assert back.ranges[1] == 2.0


def test_bytes_are_base64_or_a_list():
    kind = load_message("sensor_msgs/Image")
    assert json_values(over_the_wire(kind(data=b"\0\xff\x10")))["data"] == "AP8Q"
    for given_ in ("AP8Q", [0, 255, 16]):
        assert fill_message(kind(), {"data": given_}, NOW).data == b"\0\xff\x10"


def test_times_and_headers():
    twist = fill_message(load_message("geometry_msgs/TwistStamped")(), {}, NOW)
    assert twist.header.stamp == NOW
    given_ = {"header": {"frame_id": "odom", "stamp": {"secs": 1, "nsecs": 2}}}
    twist = fill_message(load_message("geometry_msgs/TwistStamped")(), given_, NOW)
    assert (twist.header.frame_id, twist.header.stamp) == ("odom", Time(1, 2))
    only = fill_message(load_message("geometry_msgs/TwistStamped")(), {"header": {}}, NOW)
    assert only.header.stamp == NOW
    assert fill_message(load_message("std_msgs/Time")(), {"data": "now"}, NOW).data == NOW
    assert json_values(load_message("std_msgs/Duration")()) == {"data": {"secs": 0, "nsecs": 0}}


@pytest.mark.parametrize(
    ("kind", "values", "said"),
    [
        ("std_msgs/String", {"data": 5}, "requires a string for field data, but got a int"),
        ("std_msgs/String", {"dat": ""}, "does not have a field dat"),
        ("std_msgs/String", [], "Expected a JSON object"),
        ("std_msgs/Int32", {"data": 1.5}, "requires a int32"),
        ("std_msgs/Int32", {"data": True}, "requires a int32"),
        ("std_msgs/Int32", {"data": "1"}, "requires a int32"),
        ("std_msgs/Int32", {"data": None}, "requires a int32"),
        ("std_msgs/Int8", {"data": 128}, "does not fit"),
        ("std_msgs/UInt16", {"data": -1}, "does not fit"),
        ("std_msgs/Float64", {"data": "1"}, "requires a float64"),
        ("std_msgs/Float64", {"data": 10**400}, "requires a float64"),
        ("std_msgs/Bool", {"data": 1}, "requires a bool"),
        ("geometry_msgs/Twist", {"linear": {"x": "fast"}}, "for field linear.x"),
        ("geometry_msgs/Twist", {"linear": {"w": 1}}, "field linear.w"),
        ("geometry_msgs/Twist", {"linear": 3}, "linear"),
        ("geometry_msgs/Polygon", {"points": [{"x": 0}, {"x": []}]}, "points[1].x"),
        ("geometry_msgs/PoseWithCovariance", {"covariance": [0.0]}, "36 items"),
        ("sensor_msgs/Image", {"data": "§"}, "base64"),
        ("sensor_msgs/Image", {"data": [256]}, "does not fit"),
        ("std_msgs/Time", {"data": 3.5}, "secs and nsecs"),
        ("std_msgs/Time", {"data": {"secs": -1}}, "does not fit"),
        ("std_msgs/Time", {"data": {"seconds": 1}}, "secs and nsecs"),
        ("tf2_msgs/TFMessage", {"transforms": {}}, "transforms"),
    ],
)
def test_what_does_not_fit_is_said(kind, values, said):
    with pytest.raises(MessageException) as caught:
        fill_message(load_message(kind)(), values, NOW)
    assert said in str(caught.value)


@given(st.text(st.characters(exclude_categories=["Cs"])), st.integers(1, 50))
def test_fragments_and_pngs_give_the_text_back(text, size):
    pieces = split_text(text, size, "x")
    if len(pieces) > 1:
        buffer = FragmentBuffer(10_000, 60.0)
        found = None
        for piece in reversed(pieces):
            each = json.loads(piece)
            assert each["op"] == "fragment"
            found = buffer.add(each["id"], each["num"], each["total"], each["data"])
        assert found == text
    assert text_of_png(text_as_png(text), 10_000).rstrip("\n") == text.rstrip("\n")


def test_impossible_fragments_are_refused():
    buffer = FragmentBuffer(100, 60.0)
    for number, total in ((0, 0), (3, 3), (-1, 2)):
        with pytest.raises(Exception, match="is invalid"):
            buffer.add("x", number, total, "")
    buffer.add("x", 0, 3, "")
    with pytest.raises(Exception, match="different totals"):
        buffer.add("x", 1, 4, "")
    with pytest.raises(Exception, match="wait for their fragments"):
        buffer.add("long", 0, 2, "x" * 101)
    forgetful = FragmentBuffer(100, -1.0)
    assert forgetful.add("x", 0, 2, "a") is None
    assert forgetful.add("x", 1, 2, "b") is None  # the first is forgotten
    with pytest.raises(Exception, match="not a PNG"):
        text_of_png(base64.b64encode(b"nothing").decode(), 100)
    with pytest.raises(Exception, match="more than 10 bytes"):
        text_of_png(text_as_png("x" * 100), 10)
