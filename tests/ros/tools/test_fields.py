"""Parts of messages, as tools name them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle_ros import load_message
from gazelle_ros.tools.errors import ToolError
from gazelle_ros.tools.fields import parse_path, type_at, value_at

SCAN = load_message("sensor_msgs/LaserScan")


def test_paths_lead_to_parts_of_messages():
    scan = SCAN(ranges=[1.0, 2.0, 3.0])
    scan.header.frame_id = "base"
    cases = {
        "/header/frame_id": "base",
        "/ranges": [1.0, 2.0, 3.0],
        "/ranges[1]": 2.0,
        "ranges[-1]": 3.0,
        "": scan,
    }
    for path, value in cases.items():
        assert value_at(scan, parse_path(path)) == value
    markers = load_message("visualization_msgs/MarkerArray")()
    marker = load_message("visualization_msgs/Marker")
    markers.markers = [marker(id=number) for number in range(4)]
    assert value_at(markers, parse_path("/markers[1:3]/id")) == [1, 2]
    assert value_at(markers, parse_path("/markers[::2]/id")) == [0, 2]


@pytest.mark.parametrize("path", ["/a b", "/a[", "/a[x]", "/a[]", "/a[1:2:3:4]"])
def test_malformed_paths_are_refused(path):
    with pytest.raises(ToolError):
        parse_path(path)


def test_missing_fields_are_named_with_the_closest():
    with pytest.raises(ToolError, match="did you mean 'ranges'"):
        value_at(SCAN(), parse_path("/range"))
    with pytest.raises(ToolError, match="out of range"):
        value_at(SCAN(), parse_path("/ranges[5]"))
    with pytest.raises(ToolError, match="has no field"):
        type_at(SCAN, parse_path("/header/nope"))


def test_types_of_parts_are_known():
    assert type_at(SCAN, parse_path("/header/stamp")) == "time"
    assert type_at(SCAN, parse_path("/ranges")) == "float32[]"
    assert type_at(SCAN, parse_path("/ranges[0]")) == "float32"


@given(st.text(alphabet="/ab[]:-01 ", max_size=12))
def test_any_path_is_parsed_or_refused(path):
    try:
        parse_path(path)
    except ToolError:
        return
