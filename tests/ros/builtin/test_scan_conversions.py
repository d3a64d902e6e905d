"""Clouds and depth images as laser scans, and scans as clouds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import Background, until

from gazelle_ros import Time
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.scans.depth_image import (
    DepthImageToLaserScan,
    DepthScanSettings,
    scan_of_image,
)
from gazelle_ros.builtin.scans.pointcloud import (
    CloudScanSettings,
    laserscan_to_pointcloud,
    nearest_ranges,
    pointcloud_to_laserscan,
    scan_of_cloud,
)
from gazelle_ros.builtin.scans.points import cloud_points
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.sensor_msgs.point_cloud2 import create_cloud_xyz32
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, std_msgs, tf2_msgs
from gazelle_ros.tf import StampedTransform

SCAN, CLOUD = sensor_msgs.msg.LaserScan, sensor_msgs.msg.PointCloud2
ALL = CloudScanSettings(min_height=-10.0)
HALF_TURN = math.pi


def header(frame="laser", stamp=1_000_000_000):
    return std_msgs.msg.Header(stamp=Time(nsecs=stamp), frame_id=frame)


# Clouds ----------------------------------------------------------------------------------

POINTS = st.lists(
    st.tuples(st.floats(0.0, 20.0), st.floats(-HALF_TURN, HALF_TURN), st.floats(-1.0, 1.0)),
    max_size=40,
)


@given(
    POINTS,
    st.floats(-HALF_TURN, -0.1),
    st.floats(0.1, HALF_TURN),
    st.floats(0.01, 0.5),
    st.floats(0.0, 2.0),
    st.floats(3.0, 15.0),
)
def test_each_beam_has_its_nearest_point(polar, first, last, step, nearest, farthest):
    """By the definition: a loop over beams and points."""
    settings = CloudScanSettings(
        angle_min=first, angle_max=last, angle_increment=step, range_min=nearest,
        range_max=farthest, min_height=-0.5, max_height=0.5, use_inf=False,
    )  # fmt: skip
    points = np.array([(r * math.cos(a), r * math.sin(a), z) for r, a, z in polar]).reshape(-1, 3)
    found = nearest_ranges(settings, points)
    count = math.ceil(np.float32(last - first) / np.float32(step))
    expected = [farthest + 1.0] * count
    for x, y, z in points.tolist():
        away, angle = math.hypot(x, y), math.atan2(y, x)
        if abs(z) <= 0.5 and nearest <= away <= farthest and first <= angle <= last:
            beam = min(int((angle - first) / step), count - 1)
            expected[beam] = min(expected[beam], away)
    assert found == pytest.approx(expected, rel=1e-12)


def test_defaults_are_those_of_the_original():
    """A circle of 360 beams; points at or below the sensor are left out; no limit of range."""
    points = np.array([[2.0, 0.01, 0.1], [1.0, 0.01, -0.1], [1.0, 0.01, 0.0], [-3.0, 0.0, 0.1]])
    ranges = nearest_ranges(CloudScanSettings(), points)
    assert len(ranges) == 360
    assert {n: each for n, each in enumerate(ranges) if each < math.inf} == {
        180: pytest.approx(math.hypot(2.0, 0.01)),
        359: 3.0,  # straight behind is the end of the last beam
    }


def test_a_cloud_is_transformed_before_its_heights_are_looked_at():
    cloud = create_cloud_xyz32(header("camera"), [(0.0, 0.0, 2.0), (math.nan, 0.0, 1.0)])
    # The optical frame: z forwards, x to the right.
    to_base = StampedTransform(0, (0.0, 0.0, 0.3), (-0.5, 0.5, -0.5, 0.5))
    scan = scan_of_cloud(CloudScanSettings(min_height=0.2, max_height=0.4), cloud, to_base)
    assert [each for each in scan.ranges if each < math.inf] == [pytest.approx(2.0)]
    assert scan.ranges[180] == pytest.approx(2.0)
    assert scan.range_max == math.inf  # what single precision makes of the greatest number


def send_frame(node, parent, child, x):
    made = geometry_msgs.msg.TransformStamped(header=header(parent), child_frame_id=child)
    made.transform.translation.x, made.transform.rotation.w = x, 1.0
    kind = tf2_msgs.msg.TFMessage
    publisher = node.advertise("/tf_static", kind, latch=True)
    publisher.publish(kind(transforms=[made]))
    return publisher


@pytest.fixture
def run():
    running = []

    def begin(work):
        running.append(Background(work.run))
        return work

    yield begin
    for each in running:
        each.end()


def test_the_node_subscribes_on_demand_and_waits_for_the_transform(make_node, run):
    node = make_node("converter")
    node.set_param("~target_frame", "base")
    node.set_param("~min_height", -1.0)
    run(pointcloud_to_laserscan(node))
    sender = make_node("sender")
    clouds = sender.advertise("/cloud_in", CLOUD)
    assert node.subscription("/cloud_in") is None
    listener = make_node("late_listener")
    got = []
    subscriber = listener.subscribe("/scan", SCAN, got.append)
    until(lambda: clouds.num_connections)
    clouds.publish(create_cloud_xyz32(header(), [(1.0, 0.0, 0.0)]))
    send_frame(sender, "base", "laser", 0.5)
    until(lambda: got)
    assert (got[0].header.frame_id, got[0].header.stamp) == ("base", Time(nsecs=1_000_000_000))
    assert got[0].ranges[180] == pytest.approx(1.5)
    subscriber.close()
    until(lambda: node.subscription("/cloud_in") is None)


@given(st.lists(st.floats(0.0, 12.0), min_size=1, max_size=50))
def test_a_scan_that_became_a_cloud_becomes_the_same_scan(ranges):
    """Beams in the middle of sectors; what is out of range is lost."""
    step = 0.1
    scan = SCAN(
        header=header(), angle_min=-2.5 + step / 2, angle_increment=step,
        range_min=0.5, range_max=10.0, ranges=ranges,
    )  # fmt: skip
    from gazelle_ros.builtin.scans.pointcloud import cloud_of_scan

    cloud = cloud_of_scan(scan, StampedTransform(0))
    settings = CloudScanSettings(
        min_height=-1.0, angle_min=-2.5, angle_max=-2.5 + step * len(ranges), angle_increment=step
    )
    back = scan_of_cloud(settings, cloud, StampedTransform(0)).ranges
    expected = [each if 0.5 <= each < 10.0 else math.inf for each in ranges]
    assert back[: len(ranges)] == pytest.approx(expected, rel=1e-6)


def test_scans_become_clouds_in_the_target_frame(make_node, run, listen):
    node = make_node("converter")
    node.set_param("~target_frame", "base")
    run(laserscan_to_pointcloud(node))
    sender = make_node("sender")
    keep = send_frame(sender, "base", "laser", 0.5)
    scans = sender.advertise("/scan_in", SCAN)
    got = listen("/cloud", CLOUD)
    until(lambda: scans.num_connections)
    scan = SCAN(header=header(), range_max=9.0, angle_increment=1.0, ranges=[1.0, 99.0, 2.0])
    scans.publish(scan)
    until(lambda: got)
    assert got[0].header.frame_id == "base"
    turned = (0.5 + 2.0 * math.cos(2.0), 2.0 * math.sin(2.0), 0.0)
    assert cloud_points(got[0]) == pytest.approx(np.array([(1.5, 0.0, 0.0), turned]))
    assert keep.num_connections


def test_a_wrong_parameter_is_an_error(make_node):
    node = make_node("converter")
    node.set_param("~angle_increment", 0.0)
    with pytest.raises(Error, match="angle_increment must be above 0"):
        pointcloud_to_laserscan(node)
    node.set_param("~angle_increment", "wide")
    with pytest.raises(Error, match="'angle_increment' must be of type float"):
        pointcloud_to_laserscan(node)


def test_a_cloud_without_points_fields_is_named():
    cloud = CLOUD(header=header())
    with pytest.raises(ValueError, match="no field 'x'"):
        cloud_points(cloud)


# Depth images ----------------------------------------------------------------------------

FOCAL, WIDTH, HEIGHT = 100.0, 81, 21
ROOM = DepthScanSettings(range_min=0.1, range_max=10.0, output_frame_id="")


def camera(focal=FOCAL):
    made = sensor_msgs.msg.CameraInfo(header=header("camera"), width=WIDTH, height=HEIGHT)
    made.P = [focal, 0.0, WIDTH // 2, 0.0, 0.0, focal, HEIGHT // 2, 0.0, 0.0, 0.0, 1.0, 0.0]
    return made


def image(depth, encoding="32FC1"):
    made = CvBridge().cv2_to_imgmsg(depth, encoding)
    made.header = header("camera")
    return made


def across():
    return (np.arange(WIDTH) - WIDTH // 2) / FOCAL


@pytest.mark.parametrize(("encoding", "unit"), [("32FC1", 1.0), ("16UC1", 0.001)])
def test_a_wall_ahead_is_as_far_as_its_columns_say(encoding, unit):
    """A wall square to the optical axis has one depth, and the range depth / cos(angle)."""
    kind = np.float32 if encoding == "32FC1" else np.uint16
    depth = np.full((HEIGHT, WIDTH), 2.0 / unit).astype(kind)
    scan = scan_of_image(ROOM, image(depth, encoding), camera())
    assert scan.angle_max == pytest.approx(math.atan(across()[-1]))
    assert scan.angle_min == pytest.approx(-scan.angle_max)
    assert scan.angle_increment == pytest.approx(2 * scan.angle_max / (WIDTH - 1))
    seen = np.array(scan.ranges)
    assert np.isfinite(seen).sum() > WIDTH * 0.9  # beams and columns are not at the same angles
    beams = scan.angle_min + np.arange(WIDTH) * scan.angle_increment
    for angle, away in zip(beams, seen, strict=True):
        if math.isfinite(away):
            last = min(angle + scan.angle_increment, scan.angle_max)
            most, least = sorted((2.0 / math.cos(angle), 2.0 / math.cos(last)), reverse=True)
            assert least - 0.01 <= away <= most + 0.01


def test_the_first_beam_is_that_of_the_rightmost_column():
    depth = np.full((HEIGHT, WIDTH), np.inf, np.float32)
    depth[:, -1] = 1.0
    depth[:, 0] = 3.0
    scan = scan_of_image(ROOM, image(depth), camera())
    edge = math.hypot(across()[0], 1.0)
    assert (scan.ranges[0], scan.ranges[-1]) == pytest.approx((edge, 3.0 * edge))
    assert np.isinf(scan.ranges[40])


def test_the_nearest_of_the_rows_counts_and_others_do_not():
    depth = np.full((HEIGHT, WIDTH), 4.0, np.float32)
    middle = HEIGHT // 2
    depth[middle - 1, :], depth[middle - 2, :] = 3.0, 2.0
    heights = {1: 4.0, 2: 3.0, 3: 3.0, 4: 2.0}
    for height, away in heights.items():
        settings = DepthScanSettings(scan_height=height, range_min=0.1)
        scan = scan_of_image(settings, image(depth), camera())
        assert scan.ranges[WIDTH // 2] == pytest.approx(away, rel=1e-4)
        assert scan.header.frame_id == "camera_depth_frame"


def test_invalid_pixels_are_no_number_and_far_ones_infinite():
    depth = np.full((HEIGHT, WIDTH), np.nan, np.float32)
    assert np.isnan(scan_of_image(ROOM, image(depth), camera()).ranges).all()
    depth[:] = np.inf
    assert np.isinf(scan_of_image(ROOM, image(depth), camera()).ranges).any()
    depth[:] = 0.01  # nearer than range_min
    assert np.isnan(scan_of_image(ROOM, image(depth), camera()).ranges).all()
    zeros = np.zeros((HEIGHT, WIDTH), np.uint16)
    free = DepthScanSettings(range_min=0.0)
    assert np.isnan(scan_of_image(free, image(zeros, "16UC1"), camera()).ranges).all()


@pytest.mark.parametrize(
    ("settings", "encoding", "focal", "words"),
    [
        (ROOM, "mono8", FOCAL, "the encoding is mono8"),
        (ROOM, "32FC1", 0.0, "no focal length"),
        (DepthScanSettings(scan_height=40), "32FC1", FOCAL, "scan_height of 40 is too great"),
    ],
)
def test_what_cannot_be_converted_is_named(settings, encoding, focal, words):
    kind = np.uint8 if encoding == "mono8" else np.float32
    with pytest.raises(ValueError, match=words):
        scan_of_image(settings, image(np.ones((HEIGHT, WIDTH), kind), encoding), camera(focal))


def test_the_node_pairs_images_with_cameras_of_their_time(make_node, listen, run):
    node = make_node("converter", remappings={"image": "camera/depth/image_raw"})
    run(DepthImageToLaserScan(node))
    sender = make_node("sender")
    images = sender.advertise("/camera/depth/image_raw", sensor_msgs.msg.Image)
    cameras = sender.advertise("/camera/depth/camera_info", sensor_msgs.msg.CameraInfo)
    got = listen("/scan", SCAN)
    until(lambda: images.num_connections and cameras.num_connections)
    depth = image(np.full((HEIGHT, WIDTH), 2.0, np.float32))
    early = camera()
    early.header = header("camera", 5)
    cameras.publish(early)
    images.publish(depth)
    cameras.publish(camera())
    until(lambda: got)
    assert got[0].header.stamp == depth.header.stamp
    assert got[0].ranges[WIDTH // 2] == pytest.approx(2.0, rel=1e-4)
    assert node.get_param("~range_max") == 10.0  # dynamic_reconfigure's
