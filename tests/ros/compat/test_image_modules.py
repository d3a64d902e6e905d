"""cv_bridge, image_geometry and ros_numpy."""

import importlib
import importlib.util

import numpy as np
import pytest

import gazelle_ros as ros
from gazelle_ros.messages import load_message


@pytest.fixture(autouse=True)
def installed():
    with ros.install():
        yield


@pytest.fixture
def bridge():
    return importlib.import_module("cv_bridge").CvBridge()


@pytest.fixture
def ros_numpy():
    return importlib.import_module("ros_numpy")


COLOURS = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)


@pytest.mark.parametrize("kind", ["u1", "i1", "u2", "i2", "i4", "f4", "f8"])
@pytest.mark.parametrize("channels", [1, 3])
def test_an_array_of_any_type_goes_there_and_back(bridge, kind, channels):
    image = np.arange(2 * 5 * channels).astype(kind).reshape(2, 5, channels).squeeze()
    message = bridge.cv2_to_imgmsg(image)
    assert (message.height, message.width) == (2, 5)
    assert message.step == 5 * channels * np.dtype(kind).itemsize
    back = bridge.imgmsg_to_cv2(message)
    assert back.dtype == image.dtype
    np.testing.assert_array_equal(back, image)


def test_channels_are_swapped_added_and_left_out(bridge):
    message = bridge.cv2_to_imgmsg(COLOURS, "rgb8")
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(message, "bgr8"), COLOURS[:, :, ::-1])
    with_alpha = bridge.imgmsg_to_cv2(message, "bgra8")
    assert (with_alpha[:, :, 3] == 255).all()
    np.testing.assert_array_equal(with_alpha[:, :, 2], COLOURS[:, :, 0])
    grey = bridge.cv2_to_imgmsg(COLOURS[:, :, 0], "mono8")
    assert bridge.imgmsg_to_cv2(grey, "rgb8").tolist()[0][1] == [3, 3, 3]
    plain = bridge.cv2_to_imgmsg(COLOURS)
    assert plain.encoding == "8UC3"
    np.testing.assert_array_equal(bridge.imgmsg_to_cv2(plain, "bgr8"), COLOURS)


def test_rows_may_be_padded_and_bytes_swapped(bridge):
    message = load_message("sensor_msgs/Image")(
        height=2, width=1, step=4, encoding="mono16", is_bigendian=1, data=bytes(range(8))
    )
    image = bridge.imgmsg_to_cv2(message)
    assert image.tolist() == [[0x0001], [0x0405]]
    assert image.dtype.isnative


def test_what_cannot_be_converted_is_an_error(bridge):
    error = importlib.import_module("cv_bridge").CvBridgeError
    with pytest.raises(error, match="incompatible type 8UC3"):
        bridge.cv2_to_imgmsg(COLOURS, "mono8")
    message = bridge.cv2_to_imgmsg(COLOURS, "rgb8")
    with pytest.raises(error, match="unrecognized"):
        bridge.imgmsg_to_cv2(message, "ultra9")
    message.height = 9
    with pytest.raises(error, match="more than its 24 bytes"):
        bridge.imgmsg_to_cv2(message)
    with pytest.raises(TypeError):
        bridge.cv2_to_imgmsg([[1]])


def test_grey_weighs_colours_as_opencv_does(bridge):
    colours = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255], [10, 20, 30]]])
    message = bridge.cv2_to_imgmsg(colours.astype(np.uint8), "rgb8")
    assert bridge.imgmsg_to_cv2(message, "mono8").tolist() == [[76, 150, 29, 255, 18]]
    deep = bridge.cv2_to_imgmsg((colours * 257).astype(np.uint16), "rgb16")
    assert bridge.imgmsg_to_cv2(deep, "mono16")[0, 3] == 65535
    assert bridge.imgmsg_to_cv2(deep, "mono8").tolist() == [[76, 150, 29, 255, 18]]


MOSAICS = ["rggb", "bggr", "gbrg", "grbg"]


def mosaic_of(colours, order):
    """Return the mosaic of an image in red, green and blue."""
    made = np.empty(colours.shape[:2], colours.dtype)
    for place, colour in enumerate(order):
        some = slice(place // 2, None, 2), slice(place % 2, None, 2)
        made[some] = colours[(*some, "rgb".index(colour))]
    return made


@pytest.mark.parametrize("kind", ["u1", "u2"])
@pytest.mark.parametrize("order", MOSAICS)
def test_a_mosaic_of_slopes_has_its_colours_again(bridge, order, kind):
    """Means of neighbours are exact where colours change evenly; the rim is that beside it."""
    rows, columns = np.mgrid[0:9, 0:12]
    colours = np.stack([4 * columns, 60 + 2 * rows, 120 - 2 * columns], axis=-1).astype(kind)
    bits = 8 if kind == "u1" else 16
    message = bridge.cv2_to_imgmsg(mosaic_of(colours, order), f"bayer_{order}{bits}")
    found = bridge.imgmsg_to_cv2(message, f"rgb{bits}")
    np.testing.assert_array_equal(found[1:-1, 1:-1], colours[1:-1, 1:-1])
    np.testing.assert_array_equal(found[0], found[1])
    np.testing.assert_array_equal(found[:, -1], found[:, -2])
    turned = bridge.imgmsg_to_cv2(message, f"bgr{bits}")
    np.testing.assert_array_equal(turned, found[..., ::-1])


@pytest.mark.parametrize("order", MOSAICS)
def test_a_mosaic_has_the_colours_that_opencv_finds(order):
    cv2 = pytest.importorskip("cv2")
    demosaic = importlib.import_module("cv_bridge.mosaics").demosaic
    image = np.random.default_rng(3).integers(0, 256, (10, 13), np.uint8)
    # OpenCV names mosaics by the second row, beginning with its second pixel.
    letters = {"rggb": "BG", "bggr": "RG", "gbrg": "GR", "grbg": "GB"}[order]
    wanted = cv2.cvtColor(image, getattr(cv2, f"COLOR_Bayer{letters}2RGB"))
    np.testing.assert_array_equal(demosaic(image, order), wanted)


def test_yuv_asks_for_opencv_or_uses_it(bridge):
    message = load_message("sensor_msgs/Image")(
        height=1, width=2, step=4, encoding="yuv422", data=bytes([128, 90, 128, 90])
    )
    if importlib.util.find_spec("cv2") is None:
        error = importlib.import_module("cv_bridge").CvBridgeError
        with pytest.raises(error, match="pip install opencv"):
            bridge.imgmsg_to_cv2(message, "bgr8")
    else:
        assert bridge.imgmsg_to_cv2(message, "bgr8").shape == (1, 2, 3)


def test_types_have_opencvs_numbers():
    number = importlib.import_module("cv_bridge").getCvType
    assert [number(name) for name in ("mono8", "8UC3", "bgr8", "32FC1", "64FC4", "mono16")] == [
        0,
        16,
        16,
        5,
        30,
        2,
    ]


def camera_info(shift=0.0):
    made = load_message("sensor_msgs/CameraInfo")(width=640, height=480)
    made.K = [500, 0, 320, 0, 510, 240, 0, 0, 1]
    made.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    made.P = [500, 0, 320, shift, 0, 510, 240, 0, 0, 0, 1, 0]
    made.header.frame_id = "optical"
    return made


def test_a_camera_sees_points_where_its_matrix_says():
    model = importlib.import_module("image_geometry").PinholeCameraModel()
    model.fromCameraInfo(camera_info())
    assert model.project3dToPixel((1.0, 0.5, 2.0)) == pytest.approx((570.0, 367.5))
    ray = np.array(model.projectPixelTo3dRay((570.0, 367.5)))
    np.testing.assert_allclose(ray, np.array([1, 0.5, 2]) / np.linalg.norm([1, 0.5, 2]))
    assert (model.fx(), model.fy(), model.cx(), model.cy()) == (500, 510, 320, 240)
    assert model.tfFrame() == "optical"
    assert np.isnan(model.project3dToPixel((1.0, 1.0, 0.0))[0])


def test_a_part_of_the_image_and_binning_move_the_pixels():
    info = camera_info()
    info.binning_x, info.roi.x_offset = 2, 100
    model = importlib.import_module("image_geometry").PinholeCameraModel()
    model.fromCameraInfo(info)
    assert model.cx() == 110
    assert model.fx() == 250
    assert model.fullProjectionMatrix()[0, 2] == 320


def test_two_cameras_measure_depth():
    model = importlib.import_module("image_geometry").StereoCameraModel()
    model.fromCameraInfo(camera_info(), camera_info(-500 * 0.1))
    left, right = model.project3dToPixel((1.0, 0.5, 2.0))
    disparity = left[0] - right[0]
    assert disparity == pytest.approx(25.0)
    assert model.getDisparity(2.0) == pytest.approx(25.0)
    assert model.projectPixelTo3d(left, disparity) == pytest.approx((1.0, 0.5, 2.0))


@pytest.mark.parametrize("name", ["Vector3", "Point", "Quaternion"])
def test_rows_of_numbers_become_messages_and_back(ros_numpy, name):
    kind = load_message(f"geometry_msgs/{name}")
    numbers = np.arange(1.0, len(kind.__slots__) + 1)
    np.testing.assert_array_equal(ros_numpy.numpify(ros_numpy.msgify(kind, numbers)), numbers)


@pytest.mark.parametrize("name", ["Transform", "Pose"])
def test_matrices_become_messages_and_back(ros_numpy, name):
    matrix = np.array([[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1.0]])
    message = ros_numpy.msgify(load_message(f"geometry_msgs/{name}"), matrix)
    np.testing.assert_allclose(ros_numpy.numpify(message), matrix, atol=1e-12)


def test_points_may_be_homogeneous(ros_numpy):
    point, vector = (load_message(f"geometry_msgs/{n}")(1, 2, 3) for n in ("Point", "Vector3"))
    assert ros_numpy.numpify(point, hom=True).tolist() == [1, 2, 3, 1]
    assert ros_numpy.numpify(vector, hom=True).tolist() == [1, 2, 3, 0]


def test_clouds_become_records_and_back(ros_numpy):
    records = np.zeros(5, [("x", "f4"), ("y", "f4"), ("z", "f4"), ("rgb", "f4"), ("n", "u1", (3,))])
    records["x"] = range(5)
    records["y"][2] = np.nan
    records["n"] = 7
    message = ros_numpy.msgify(load_message("sensor_msgs/PointCloud2"), records, frame_id="map")
    assert (message.header.frame_id, message.width, message.is_dense) == ("map", 5, False)
    back = ros_numpy.numpify(message)
    assert back.dtype == records.dtype
    np.testing.assert_array_equal(back["x"], records["x"])
    np.testing.assert_array_equal(back["n"], records["n"])
    clouds = ros_numpy.point_cloud2
    assert clouds.pointcloud2_to_xyz_array(message).tolist() == [
        [0, 0, 0],
        [1, 0, 0],
        [3, 0, 0],
        [4, 0, 0],
    ]


def test_colours_are_split_and_merged(ros_numpy):
    clouds = ros_numpy.point_cloud2
    records = np.zeros(2, [("x", "f4"), ("r", "u1"), ("g", "u1"), ("b", "u1")])
    records["r"], records["g"], records["b"] = (1, 4), (2, 5), (3, 6)
    merged = clouds.merge_rgb_fields(records)
    assert merged["rgb"].view(np.uint32).tolist() == [0x010203, 0x040506]
    split = clouds.split_rgb_field(merged)
    assert [split[c].tolist() for c in "rgb"] == [[1, 4], [2, 5], [3, 6]]


def test_maps_have_unknown_cells_masked(ros_numpy):
    cells = np.array([[0, 100, -1], [50, -1, 0]], np.int8)
    grid = ros_numpy.msgify(load_message("nav_msgs/OccupancyGrid"), cells)
    assert (grid.info.width, grid.info.height) == (3, 2)
    back = ros_numpy.numpify(grid)
    assert back.mask.tolist() == (cells == -1).tolist()
    again = ros_numpy.msgify(load_message("nav_msgs/OccupancyGrid"), back)
    assert list(again.data) == cells.ravel().tolist()


def test_images_go_there_and_back(ros_numpy):
    message = ros_numpy.msgify(load_message("sensor_msgs/Image"), COLOURS, encoding="rgb8")
    np.testing.assert_array_equal(ros_numpy.numpify(message), COLOURS)


def test_types_nobody_registered_are_named(ros_numpy):
    with pytest.raises(ValueError, match="String"):
        ros_numpy.numpify(load_message("std_msgs/String")())
    assert ros_numpy.numpify(None) is None
