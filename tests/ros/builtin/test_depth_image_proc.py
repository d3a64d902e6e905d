"""Nodelets of depth_image_proc: clouds, metres, and the view of another camera."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros import Time
from gazelle_ros.builtin import registry
from gazelle_ros.builtin.images.depth.disparity import DisparitySettings, disparities, foremost
from gazelle_ros.builtin.images.depth.metric import converted, depths_of
from gazelle_ros.builtin.images.depth.points import cloud_of_depth, coloured_cloud
from gazelle_ros.builtin.images.depth.register import registered
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.image_geometry import PinholeCameraModel
from gazelle_ros.compat.sensor_msgs.point_cloud2 import read_points, split_columns
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, std_msgs, tf2_msgs
from gazelle_ros.tf import StampedTransform

IMAGE, CAMERA = sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo
SIZE = (6, 8)
SLOPE = np.linspace(0.5, 4.0, 48).reshape(SIZE)


def header(frame="depth"):
    return std_msgs.msg.Header(stamp=Time(3), frame_id=frame)


def depth_image(depths, encoding="32FC1", frame="depth"):
    pixels = np.asarray(depths, np.float32)
    if encoding == "16UC1":
        pixels = np.rint(np.nan_to_num(pixels) * 1000.0).astype(np.uint16)
    return CvBridge().cv2_to_imgmsg(pixels, encoding, header(frame))


def camera(focal=10.0, size=SIZE, frame="depth"):
    made = CAMERA(width=size[1], height=size[0], header=header(frame))
    middle = (size[1] - 1) / 2, (size[0] - 1) / 2
    made.P = [focal, 0.0, middle[0], 0.0, 0.0, focal, middle[1], 0.0, 0.0, 0.0, 1.0, 0.0]
    made.K = [focal, 0.0, middle[0], 0.0, focal, middle[1], 0.0, 0.0, 1.0]
    made.R = np.eye(3).ravel().tolist()
    return made


def points_of(cloud):
    return np.array(list(read_points(cloud, "xyz"))).reshape(cloud.height, cloud.width, 3)


@given(st.floats(5.0, 900.0), st.integers(0, 2**32 - 1), st.sampled_from(["32FC1", "16UC1"]))
def test_a_point_is_seen_in_its_pixel_at_its_depth(focal, seed, encoding):
    depths = np.random.default_rng(seed).uniform(0.2, 9.0, SIZE)
    info = camera(focal)
    model = PinholeCameraModel()
    model.fromCameraInfo(info)
    points = points_of(cloud_of_depth(depth_image(depths, encoding), info))
    assert points[..., 2] == pytest.approx(depths, abs=1e-6 if encoding == "32FC1" else 6e-4)
    for row, column in ((0, 0), (2, 5), (5, 7)):
        seen = model.project3dToPixel(points[row, column].tolist())
        assert seen == pytest.approx((column, row), abs=1e-3)


def test_a_cloud_is_laid_out_as_the_image_with_holes():
    depths = SLOPE.copy()
    depths[1, 2], depths[3, 4] = np.nan, np.inf
    cloud = cloud_of_depth(depth_image(depths), camera())
    assert (cloud.height, cloud.width, cloud.point_step, cloud.row_step) == (6, 8, 16, 128)
    assert (cloud.header.frame_id, cloud.is_dense) == ("depth", False)
    holes = np.isnan(points_of(cloud)).all(axis=-1)
    assert np.argwhere(holes).tolist() == [[1, 2], [3, 4]]
    millimetres = depth_image(np.where(holes, np.nan, SLOPE), "16UC1")
    assert np.array_equal(np.isnan(points_of(cloud_of_depth(millimetres, camera())))[..., 2], holes)


def test_points_have_the_colours_of_their_pixels():
    colours = np.random.default_rng(1).integers(0, 256, (*SIZE, 3), np.uint8)
    image = CvBridge().cv2_to_imgmsg(colours[..., ::-1].copy(), "bgr8", header())
    cloud = coloured_cloud(depth_image(SLOPE), image, camera())
    assert (cloud.point_step, [each.offset for each in cloud.fields]) == (32, [0, 4, 8, 16])
    packed = split_columns(cloud)["rgb"].copy().view(np.uint32)
    found = np.stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255], axis=-1)
    assert np.array_equal(found, colours)
    assert np.array_equal(points_of(cloud), points_of(cloud_of_depth(depth_image(SLOPE), camera())))


def test_points_have_the_intensities_of_their_pixels():
    grey = np.arange(48, dtype=np.uint16).reshape(SIZE) * 700
    image = CvBridge().cv2_to_imgmsg(grey, "mono16", header())
    cloud = coloured_cloud(depth_image(SLOPE), image, camera(), intensity=True)
    assert [(each.name, each.offset) for each in cloud.fields][-1] == ("intensity", 12)
    assert np.array_equal(split_columns(cloud)["intensity"].reshape(SIZE), grey)
    assert np.array_equal(points_of(cloud), points_of(cloud_of_depth(depth_image(SLOPE), camera())))
    colours = CvBridge().cv2_to_imgmsg(np.zeros((*SIZE, 3), np.uint8), "rgb8", header())
    with pytest.raises(ValueError, match="intensities are one value a pixel"):
        coloured_cloud(depth_image(SLOPE), colours, camera(), intensity=True)


def test_disparities_are_those_of_a_point_in_both_cameras():
    depths = SLOPE.copy()
    depths[1, 2] = np.nan
    right = camera(40.0)
    right.P[3] = -40.0 * 0.1
    found = disparities(depth_image(depths), right, DisparitySettings(min_range=0.4, max_range=5.0))
    assert (found.f, found.T) == (40.0, 0.1)
    assert (found.min_disparity, found.max_disparity) == pytest.approx((0.8, 10.0))
    shifts = CvBridge().imgmsg_to_cv2(found.image)
    assert shifts[1, 2] == 0.0
    left, other = PinholeCameraModel(), PinholeCameraModel()
    left.fromCameraInfo(camera(40.0))
    other.fromCameraInfo(right)
    for x, y, z in ((0.0, 0.0, SLOPE[2, 3]), (0.1, -0.1, SLOPE[4, 5])):
        apart = left.project3dToPixel((x, y, z))[0] - other.project3dToPixel((x, y, z))[0]
        assert np.isclose(shifts, apart).any()


@pytest.mark.parametrize(("encoding", "distance"), [("32FC1", 0.5), ("16UC1", 500.0)])
def test_what_is_far_behind_the_nearest_pixel_is_cropped(encoding, distance):
    depths = SLOPE.copy()
    depths[0, 0] = np.nan
    found = depths_of(foremost(depth_image(depths, encoding), distance))
    least = np.nanmin(depths)
    kept = found > 0.0
    assert np.array_equal(kept, np.nan_to_num(depths, nan=9.0) <= least + 0.5)
    assert found[kept] == pytest.approx(depths[kept], abs=6e-4)


def test_a_larger_image_colours_a_smaller_depth_image():
    """The camera_info is that of the colours; a pixel of the depth is two by two of them."""
    image = CvBridge().cv2_to_imgmsg(np.full((12, 16), 9, np.uint8), "mono8", header())
    cloud = coloured_cloud(depth_image(np.ones(SIZE)), image, camera(20.0, (12, 16)))
    points = points_of(cloud)
    assert points.shape == (*SIZE, 3)
    assert points[0, 1, 0] - points[0, 0, 0] == pytest.approx(0.1)


def test_metres_become_millimetres_and_back():
    depths = np.array([[0.5, np.nan, 65.5, 70.0]])
    whole = converted(depth_image(depths))
    assert whole.encoding == "16UC1"
    assert CvBridge().imgmsg_to_cv2(whole).tolist() == [[500, 0, 65500, 65535]]
    back = converted(whole)
    assert (back.encoding, back.header.frame_id) == ("32FC1", "depth")
    assert depths_of(back)[0, :3] == pytest.approx([0.5, np.nan, 65.5], nan_ok=True)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: converted(IMAGE(encoding="rgb8")), "the encoding is rgb8"),
        (lambda: cloud_of_depth(depth_image(SLOPE), CAMERA()), "no focal length"),
        (
            lambda: coloured_cloud(depth_image(SLOPE), depth_image(SLOPE, frame="other"), camera()),
            "the frame of the depth is 'depth', that of the colours 'other'",
        ),
    ],
)
def test_what_is_no_depth_image_is_an_error(make, text):
    with pytest.raises(ValueError, match=text):
        make()


# Views of another camera ------------------------------------------------------------------


def beside(x=0.0, turn=(0.0, 0.0, 0.0, 1.0)):
    return StampedTransform(0, (x, 0.0, 0.0), turn)


@pytest.mark.parametrize("encoding", ["32FC1", "16UC1"])
def test_in_its_own_view_a_depth_image_stays(encoding):
    depth = depth_image(SLOPE, encoding)
    image, info = registered(depth, camera(), camera(frame="rgb"), beside())
    assert image.encoding == encoding
    assert depths_of(image) == pytest.approx(depths_of(depth), abs=6e-4)
    assert (image.header.frame_id, info.header.frame_id) == ("rgb", "rgb")
    assert image.header.stamp == info.header.stamp == depth.header.stamp


def test_a_camera_beside_sees_a_wall_shifted_by_focal_length_times_base_over_depth():
    wall = np.full(SIZE, 2.0)
    image, _ = registered(depth_image(wall), camera(), camera(frame="rgb"), beside(x=0.4))
    seen = depths_of(image)
    assert np.isnan(seen[:, :2]).all()
    assert (seen[:, 2:] == 2.0).all()


def test_of_two_points_in_a_pixel_the_nearest_is_seen():
    """From 1 m to the left, a thing at 1 m moves by 10 pixels and covers the wall behind it."""
    depths = np.full((1, 40), 10.0)
    depths[0, 5:9] = 1.0
    wide = camera(size=(1, 40))
    image, _ = registered(
        depth_image(depths), wide, camera(size=(1, 40), frame="rgb"), beside(x=1.0)
    )
    seen = depths_of(image)[0]
    assert (seen[15:19] == 1.0).all()
    assert (seen[19:] == 10.0).all()
    assert np.isnan(seen[6:10]).all()


def test_a_finer_camera_has_holes_unless_they_are_filled():
    fine = camera(20.0, (12, 16), "rgb")
    wall = depth_image(np.full(SIZE, 2.0))
    plain, _ = registered(wall, camera(), fine, beside())
    filled, _ = registered(wall, camera(), fine, beside(), fill=True)
    assert np.isfinite(depths_of(plain)).sum() == 48
    assert (depths_of(filled) == 2.0).all()


def test_points_behind_the_other_camera_are_not_seen():
    back = beside(turn=(0.0, 1.0, 0.0, 0.0))
    image, _ = registered(depth_image(SLOPE), camera(), camera(frame="rgb"), back)
    assert np.isnan(depths_of(image)).all()


# Nodelets ---------------------------------------------------------------------------------


@pytest.fixture
def sender(make_node):
    """Return a function that publishes messages on topics until results have come."""
    node = make_node("driver")

    def send(messages, got):
        publishers = {topic: node.advertise(topic, type(each)) for topic, each in messages.items()}

        def arrived():
            for topic, message in messages.items():
                publishers[topic].publish(message)
            return all(got.values())

        until(arrived)

    return send


def test_nodelets_make_clouds_and_metres_of_depth_images(make_node, listen, sender):
    node = make_node("manager")
    for name in ("point_cloud_xyz", "point_cloud_xyzrgb", "convert_metric"):
        registry.nodelet(f"depth_image_proc/{name}")(node)
    cloud = sensor_msgs.msg.PointCloud2
    got = {
        "points": listen("/points", cloud),
        "coloured": listen("/depth_registered/points", cloud),
        "metres": listen("/image", IMAGE),
    }
    colours = CvBridge().cv2_to_imgmsg(np.full(SIZE, 7, np.uint8), "mono8", header())
    depth = depth_image(SLOPE, "16UC1")
    messages = {
        "/image_rect": depth, "/camera_info": camera(), "/image_raw": depth,
        "/depth_registered/image_rect": depth, "/rgb/image_rect_color": colours,
        "/rgb/camera_info": camera(),
    }  # fmt: skip
    sender(messages, got)
    assert points_of(got["points"][0])[..., 2] == pytest.approx(SLOPE, abs=6e-4)
    assert len(got["coloured"][0].fields) == 4
    assert got["metres"][0].encoding == "32FC1"


@pytest.mark.parametrize("by_colours", [False, True])
def test_the_registering_nodelet_waits_for_its_transform(make_node, listen, sender, by_colours):
    node = make_node("manager")
    node.set_param("~use_rgb_timestamp", by_colours)
    registry.nodelet("depth_image_proc/register")(node)
    link = geometry_msgs.msg.TransformStamped(header=header("rgb"), child_frame_id="depth")
    link.transform.translation.x, link.transform.rotation.w = 0.4, 1.0
    got = {"image": listen("/depth_registered/image_rect", IMAGE),
           "info": listen("/depth_registered/camera_info", CAMERA)}  # fmt: skip
    wall, other = depth_image(np.full(SIZE, 2.0)), camera(frame="rgb")
    own = wall.header.stamp
    other.header.stamp = Time(nsecs=own.to_nsec() + 10_000_000)
    messages = {
        "/depth/image_rect": wall, "/depth/camera_info": camera(),
        "/rgb/camera_info": other,
        "/tf_static": tf2_msgs.msg.TFMessage(transforms=[link]),
    }  # fmt: skip
    sender(messages, got)
    assert np.isnan(depths_of(got["image"][0])).sum() == 12
    assert got["info"][0].header.frame_id == "rgb"
    stamps = {each.header.stamp for found in got.values() for each in found}
    assert stamps == {other.header.stamp if by_colours else own}
