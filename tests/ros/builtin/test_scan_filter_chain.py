"""The node scan_to_scan_filter_chain: chains from parameters, transforms, reconfiguration."""

from __future__ import annotations

import math

import pytest
from ros.graph import Background, until

from gazelle_ros import Time
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.scans.filters.chain import ScanFilterChain
from gazelle_ros.msgs import dynamic_reconfigure, geometry_msgs, sensor_msgs, std_msgs, tf2_msgs

SCAN = sensor_msgs.msg.LaserScan
NEAR = {
    "name": "near",
    "type": "laser_filters/LaserScanRangeFilter",
    "params": {"lower_threshold": 1.0, "lower_replacement_value": math.nan},
}
BOX = {
    "name": "box",
    "type": "laser_filters/LaserScanBoxFilter",
    "params": {"box_frame": "base", "min_x": 1.9, "max_x": 3.1},
}


@pytest.fixture
def chain(make_node, listen):
    """Return a function that makes the node of a chain, and sends scans through it."""
    running = []
    sender = make_node("sender")
    scans = sender.advertise("/scan", SCAN)

    def begin(filters, **parameters):
        node = make_node("laser_filter")
        for name, value in ({"scan_filter_chain": filters} | parameters).items():
            node.set_param(f"~{name}", value)
        work = ScanFilterChain(node)
        running.append(Background(work.run))
        got = listen("/scan_filtered", SCAN)
        until(lambda: scans.num_connections and work._output.num_connections)

        def send(*ranges, stamp=1):
            scan = SCAN(
                header=std_msgs.msg.Header(stamp=Time(stamp), frame_id="laser"),
                angle_increment=0.01, range_min=0.1, range_max=10.0, scan_time=0.1, ranges=ranges,
            )  # fmt: skip
            scans.publish(scan)
            return scan

        return work, send, got

    yield begin
    for each in running:
        each.end()


def test_filters_are_applied_in_their_order(chain):
    shorter = {
        "name": "shorter",
        "type": "LaserScanAngularBoundsFilter",
        "params": {"lower_angle": -1.0, "upper_angle": 0.015},
    }
    _, send, got = chain([NEAR, shorter])
    scan = send(0.5, 2.0, 3.0)
    until(lambda: got)
    assert list(got[0].ranges) == pytest.approx([math.nan, 2.0], nan_ok=True)
    assert (got[0].header.stamp, got[0].header.frame_id) == (scan.header.stamp, "laser")
    assert got[0].angle_max == pytest.approx(0.01)
    assert (got[0].range_max, got[0].scan_time) == pytest.approx((10.0, 0.1))


def test_a_scan_waits_for_the_frame_of_a_box(chain, make_node):
    _, send, got = chain([BOX])
    send(1.0, 2.0)
    made = geometry_msgs.msg.TransformStamped(
        header=std_msgs.msg.Header(frame_id="base"), child_frame_id="laser"
    )
    made.transform.translation.x, made.transform.rotation.w = 1.0, 1.0
    kind = tf2_msgs.msg.TFMessage
    publisher = make_node("frames").advertise("/tf_static", kind, latch=True)
    publisher.publish(kind(transforms=[made]))
    until(lambda: got)
    assert list(got[0].ranges) == pytest.approx([math.nan, math.nan], nan_ok=True)
    send(0.5, 2.5, stamp=2)
    until(lambda: len(got) == 2)
    assert list(got[1].ranges) == [0.5, 2.5]


def test_a_filter_is_changed_by_reconfiguration(chain, make_node):
    work, send, got = chain([NEAR])
    client = make_node("tuner")
    kind = dynamic_reconfigure.srv.Reconfigure
    request = kind._request_class()
    request.config.doubles = [dynamic_reconfigure.msg.DoubleParameter("lower_threshold", 2.5)]
    client.client("/laser_filter/near/set_parameters", kind).call(request)
    assert work.filters[0].lower_threshold == 2.5
    send(2.0, 3.0)
    until(lambda: got)
    assert list(got[0].ranges) == pytest.approx([math.nan, 3.0], nan_ok=True)


def test_a_scan_that_cannot_be_filtered_is_left_out_and_named(chain, caplog):
    _, send, got = chain([{"name": "speckle", "type": "laser_filters/LaserScanSpeckleFilter"}])
    send(1.0)
    until(lambda: "1 beams are too few for a filter_window of 4" in caplog.text)
    send(*[1.0] * 6)
    until(lambda: got)
    assert list(got[0].ranges) == [1.0] * 6


@pytest.mark.parametrize(
    ("filters", "words"),
    [
        ("many", "scan_filter_chain is not set to a list"),
        ([NEAR, NEAR], "two filters 'near'"),
        (
            [NEAR, {"name": "other", "type": "Nothing"}],
            r"scan_filter_chain\[1\] has the unknown type",
        ),
    ],
)
def test_a_wrong_chain_is_an_error(make_node, filters, words):
    node = make_node("laser_filter")
    node.set_param("~scan_filter_chain", filters)
    with pytest.raises(RosError, match=words):
        ScanFilterChain(node)


def test_unknown_parameters_are_warned_of(chain, caplog):
    wrong = NEAR | {"params": {"lower_treshold": 1.0}}
    chain([wrong], tf_message_filter_target_fram="base")
    assert "did you mean 'lower_threshold'" in caplog.text
    assert "did you mean 'tf_message_filter_target_frame'" in caplog.text
