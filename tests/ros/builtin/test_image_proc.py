"""Nodelets of image_proc: colours, rectification, parts and other sizes of images."""

from __future__ import annotations

import numpy as np
import pytest
from ros.graph import Background, until

from gazelle_ros import Time
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin import registry
from gazelle_ros.builtin.images.crop_decimate import CropDecimate, CropSettings, cropped
from gazelle_ros.builtin.images.debayer import Debayer, colour_image, mono_image
from gazelle_ros.builtin.images.image_proc import ImageProc
from gazelle_ros.builtin.images.rectify import Rectify
from gazelle_ros.builtin.images.resize import Resize, ResizeSettings, resized_camera, resized_image
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.image_geometry import PinholeCameraModel
from gazelle_ros.msgs import sensor_msgs

IMAGE, CAMERA = sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo
SIZE = (24, 32)


def image_of(pixels, encoding, stamp=7):
    made = CvBridge().cv2_to_imgmsg(np.ascontiguousarray(pixels), encoding)
    made.header.frame_id, made.header.stamp = "optical", Time(stamp)
    return made


def pixels_of(image):
    return CvBridge().imgmsg_to_cv2(image)


def colours(kind=np.uint8):
    return np.random.default_rng(2).integers(0, 200, (*SIZE, 3)).astype(kind)


def camera(distortion=(-0.2, 0.1, 0.001, 0.001, 0.0), stamp=7):
    made = CAMERA(width=SIZE[1], height=SIZE[0], distortion_model="plumb_bob", D=list(distortion))
    made.K = [30.0, 0.0, 15.5, 0.0, 30.0, 11.5, 0.0, 0.0, 1.0]
    made.R = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    made.P = [28.0, 0.0, 15.5, 0.0, 0.0, 28.0, 11.5, 0.0, 0.0, 0.0, 1.0, 0.0]
    made.header.frame_id, made.header.stamp = "optical", Time(stamp)
    return made


class CameraGraph:
    """A camera's topics, and a listener for the results."""

    def __init__(self, make_node, listen, namespace="/camera"):
        self._node = make_node("driver")
        self._listen = listen
        self.image = self._node.advertise(f"{namespace}/image_raw", IMAGE)
        self.camera = self._node.advertise(f"{namespace}/camera_info", CAMERA)

    def results(self, *topics):
        """Return what comes on topics of image_proc, once all are connected."""
        kinds = {"camera_info": CAMERA}
        return {each: self._listen(each, kinds.get(each.split("/")[-1], IMAGE)) for each in topics}

    def send_until(self, got, image=None, info=None):
        """Send the camera's messages until each topic has brought one."""

        def arrived():
            self.image.publish(image or image_of(colours(), "rgb8"))
            self.camera.publish(info or camera())
            return all(got.values())

        until(arrived)


@pytest.fixture
def graph(make_node, listen):
    return CameraGraph(make_node, listen)


@pytest.fixture
def in_camera(make_node):
    """Return a function that starts a nodelet in the camera's namespace."""
    running = []

    def start(make, name="tested", **parameters):
        node = make_node(name, namespace="/camera")
        for key, value in parameters.items():
            node.set_param(f"~{key}", value)
        running.append(Background(make(node).run))

    yield start
    for each in running:
        each.end()


def test_image_proc_publishes_grey_and_colours_raw_and_rectified(graph, in_camera):
    in_camera(ImageProc, "image_proc", queue_size=3)
    names = ("image_mono", "image_color", "image_rect", "image_rect_color")
    got = graph.results(*(f"/camera/{each}" for each in names))
    graph.send_until(got)
    mono, colour, rect, rect_colour = (got[f"/camera/{each}"][0] for each in names)
    assert [each.encoding for each in (mono, colour, rect, rect_colour)] == [
        "mono8", "rgb8", "mono8", "rgb8",
    ]  # fmt: skip
    assert rect.header.frame_id == "optical"
    wanted = np.zeros_like(pixels_of(colour))
    model = PinholeCameraModel()
    model.fromCameraInfo(camera())
    model.rectifyImage(pixels_of(colour), wanted, 1)
    assert np.array_equal(pixels_of(rect_colour), wanted)
    assert not np.array_equal(wanted, pixels_of(colour))


def test_without_distortion_an_image_passes_as_it_is(graph, in_camera, make_node):
    in_camera(lambda node: Rectify(node, "image_raw"))
    got = graph.results("/camera/image_rect")
    sent = image_of(colours(), "rgb8")
    graph.send_until(got, sent, camera([0.0] * 5))
    assert got["/camera/image_rect"][0].data == sent.data


def test_frames_of_rectified_images_may_have_a_suffix(graph, in_camera):
    in_camera(lambda node: Rectify(node, "image_raw"), rectified_frame_suffix="_rect")
    got = graph.results("/camera/image_rect")
    graph.send_until(got)
    assert got["/camera/image_rect"][0].header.frame_id == "optical_rect"


def test_a_camera_without_calibration_is_named(graph, in_camera, caplog):
    in_camera(lambda node: Rectify(node, "image_raw"))
    got = graph.results("/camera/image_rect")

    def named():
        graph.image.publish(image_of(colours(), "rgb8"))
        graph.camera.publish(CAMERA(header=camera().header))
        return (
            "/camera/tested: an image cannot be converted: the camera is not calibrated"
            in caplog.text
        )

    until(named)
    assert not got["/camera/image_rect"]


def test_a_mosaic_becomes_colours_and_grey():
    plain = np.full(SIZE, 90, np.uint8)
    raw = image_of(plain, "bayer_grbg8")
    colour, grey = colour_image(raw), mono_image(raw)
    assert (colour.encoding, grey.encoding) == ("bgr8", "mono8")
    assert (pixels_of(colour) == 90).all()
    assert (pixels_of(grey) == 90).all()
    assert colour.header.stamp == raw.header.stamp
    deep = image_of(plain.astype(np.uint16), "bayer_rggb16")
    assert (colour_image(deep).encoding, mono_image(deep).encoding) == ("bgr16", "mono16")


def test_grey_and_coloured_images_stay():
    grey, colour = image_of(colours()[..., 0], "mono8"), image_of(colours(), "bgr8")
    assert mono_image(grey) is colour_image(grey) is grey
    assert colour_image(colour) is colour


def test_pixels_without_colours_are_an_error():
    for make in (mono_image, colour_image):
        with pytest.raises(Error, match="images of encoding '8UC3' have no colours"):
            make(image_of(colours(), "8UC3"))


def test_methods_other_than_bilinear_are_named(make_node, caplog):
    node = make_node("debayer")
    node.set_param("/debayer/debayer", 3)
    Debayer(node)
    assert "are interpolated linearly, not by method 3" in caplog.text


def test_a_part_is_cut_out_and_decimated():
    settings = CropSettings(
        decimation_x=2, decimation_y=3, x_offset=4, y_offset=6, width=20, height=12
    )
    image, info = cropped(settings, image_of(colours(), "rgb8"), camera())
    assert np.array_equal(pixels_of(image), colours()[6:18:3, 4:24:2])
    assert (info.binning_x, info.binning_y) == (2, 3)
    roi = info.roi
    assert (roi.x_offset, roi.y_offset, roi.width, roi.height, roi.do_rectify) == (
        4,
        6,
        20,
        12,
        True,
    )
    model, whole = PinholeCameraModel(), PinholeCameraModel()
    model.fromCameraInfo(info)
    whole.fromCameraInfo(camera())
    u, v = whole.project3dToPixel((0.1, 0.2, 1.0))
    assert model.project3dToPixel((0.1, 0.2, 1.0)) == pytest.approx(((u - 4) / 2, (v - 6) / 3))


def test_by_default_all_stays_and_frames_may_be_renamed():
    image, info = cropped(
        CropSettings(target_frame_id="other"), image_of(colours(), "rgb8"), camera()
    )
    assert np.array_equal(pixels_of(image), colours())
    assert {image.header.frame_id, info.header.frame_id} == {"other"}
    assert (info.roi.do_rectify, info.binning_x) == (False, 1)


def test_areas_are_means_and_mosaics_become_colours():
    settings = CropSettings(decimation_x=2, decimation_y=2, interpolation=3)
    grey = image_of(colours()[..., 0].astype(np.float32), "32FC1")
    means = colours()[..., 0].reshape(12, 2, 16, 2).mean(axis=(1, 3))
    assert pixels_of(cropped(settings, grey, camera())[0]) == pytest.approx(means)
    mosaic = np.zeros(SIZE, np.uint8)
    mosaic[::2, ::2], mosaic[::2, 1::2], mosaic[1::2, ::2], mosaic[1::2, 1::2] = 10, 20, 40, 30
    image, _ = cropped(settings, image_of(mosaic, "bayer_rggb8"), camera())
    assert image.encoding == "bgr8"
    assert np.unique(pixels_of(image).reshape(-1, 3), axis=0).tolist() == [[30, 30, 10]]


@pytest.mark.parametrize(
    ("fields", "encoding", "text"),
    [
        ({"x_offset": 40}, "mono8", "beyond 32 x 24"),
        ({"decimation_x": 3}, "bayer_rggb8", "even numbers"),
        ({"width": 2, "decimation_x": 4}, "mono8", "nothing is left of 2 x 24"),
    ],
)
def test_a_part_without_pixels_is_an_error(fields, encoding, text):
    with pytest.raises(ValueError, match=text):
        cropped(CropSettings(**fields), image_of(np.zeros(SIZE, np.uint8), encoding), camera())


@pytest.mark.parametrize(
    ("old", "new", "namespace"),
    [
        ("/other", "/another", "camera_out"),
        ("/camera_out", "/small", "small"),
        ("/camera_out/image_raw", "/small/image_raw", "small"),
    ],
)
def test_a_part_has_topics_of_its_own(graph, make_node, old, new, namespace):
    node = make_node("crop", remappings={old: new})
    node.set_param("/crop/decimation_x", 2)
    CropDecimate(node)
    got = graph.results(f"/{namespace}/image_raw", f"/{namespace}/camera_info")
    graph.send_until(got)
    assert got[f"/{namespace}/image_raw"][0].width == 16
    assert got[f"/{namespace}/camera_info"][0].binning_x == 2


def test_parameters_out_of_their_limits_become_the_nearest_ones(make_node):
    node = make_node("crop")
    node.set_param("/crop/decimation_x", 99)
    node.set_param("/crop/interpolation", -3)
    made = CropDecimate(node)._tuned.settings
    assert (made.decimation_x, made.decimation_y, made.interpolation) == (16, 1, 0)
    assert node.get_param("/crop/decimation_x") == 16


def test_a_camera_of_another_size_sees_the_same():
    settings = ResizeSettings(scale_width=0.5, scale_height=2.0)
    info = resized_camera(settings, camera())
    assert (info.width, info.height) == (16, 48)
    model, whole = PinholeCameraModel(), PinholeCameraModel()
    model.fromCameraInfo(info)
    whole.fromCameraInfo(camera())
    u, v = whole.project3dToPixel((0.1, 0.2, 1.0))
    assert model.project3dToPixel((0.1, 0.2, 1.0)) == pytest.approx((u / 2, v * 2))
    image = resized_image(settings, image_of(colours(), "rgb8"))
    assert pixels_of(image).shape == (48, 16, 3)
    fixed = ResizeSettings(use_scale=False, width=64)
    assert (resized_camera(fixed, camera()).width, resized_camera(fixed, camera()).height) == (
        64,
        24,
    )
    with pytest.raises(Error, match="cannot become"):
        resized_image(ResizeSettings(scale_width=0.001), image_of(colours(), "rgb8"))


def test_images_and_cameras_are_resized_on_topics_of_the_nodelet(graph, make_node):
    node = make_node(
        "small", remappings={"/image": "/camera/image_raw", "/camera_info": "/camera/camera_info"}
    )
    node.set_param("/small/scale_width", 0.25)
    Resize(node)
    got = graph.results("/small/image", "/small/camera_info")
    graph.send_until(got)
    assert got["/small/image"][0].width == got["/small/camera_info"][0].width == 8


@pytest.mark.parametrize("name", ["rectify", "debayer", "crop_decimate", "resize"])
def test_nodelets_are_found_by_name(name, make_node):
    assert registry.nodelet(f"image_proc/{name}")(make_node("made")) is not None
