"""Nodes of image_view: images as files, and as the page shows them."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image as Picture
from ros.graph import until

from gazelle_ros import Time, load_service
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.images.files import NumberedNames, write_calibration, write_image
from gazelle_ros.builtin.images.saving import ImageExtractor, ImageSaver
from gazelle_ros.builtin.images.view import ImageView, ViewSettings, shown_image
from gazelle_ros.clock import SimulatedClock
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import sensor_msgs

IMAGE, CAMERA = sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo
COLOURS = np.arange(24, dtype=np.uint8).reshape(2, 4, 3) * 10


def image_of(pixels, encoding):
    made = CvBridge().cv2_to_imgmsg(np.ascontiguousarray(pixels), encoding)
    made.header.stamp = Time(12, 500_000_000)
    return made


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def files(folder):
    # Without those that are being written.
    return sorted(each.name for each in folder.iterdir() if each.name[0] != ".")


@pytest.mark.parametrize(
    ("pattern", "names"),
    [
        ("left%04i.%s", ["left0000.jpg", "left0001.jpg"]),
        ("frame%d.png", ["frame0.png", "frame1.png"]),
        ("same.png", ["same.png", "same.png"]),
    ],
)
def test_names_are_numbered_as_in_c(pattern, names):
    found = NumberedNames(pattern)
    made = []
    for _ in range(2):
        made.append(found.next().name)
        found.count += 1
    assert made == names


@pytest.mark.parametrize(
    ("pattern", "text"), [("a%i%i%i.jpg", "is not a pattern"), ("frame%i", "no kind of image")]
)
def test_a_wrong_pattern_is_an_error(pattern, text):
    with pytest.raises(Error, match=text):
        NumberedNames(pattern)


@pytest.mark.parametrize("encoding", ["bgr8", "rgb8", "bgra8", "mono8", "mono16"])
def test_a_file_has_the_colours_of_the_image(folder, encoding):
    sent = image_of(COLOURS, "rgb8")
    if encoding == "mono16":
        sent = image_of(COLOURS[..., 0].astype(np.uint16) * 300, "mono16")
    write_image(folder / "a.png", sent, encoding)
    with Picture.open(folder / "a.png") as picture:
        found = np.asarray(picture)
    if encoding.startswith("mono"):
        assert np.array_equal(found, CvBridge().imgmsg_to_cv2(sent, encoding))
    else:
        assert np.array_equal(found[..., :3], COLOURS)


@pytest.mark.parametrize(
    ("name", "encoding", "text"),
    [
        ("a.jpg", "mono16", "cannot be written"),
        ("a.xyz", "bgr8", "cannot be written"),
        ("none/a.png", "bgr8", "cannot be written"),
        ("a.png", "rgb9", "unrecognized image encoding"),
    ],
)
def test_what_cannot_be_written_is_an_error_and_leaves_nothing(folder, name, encoding, text):
    sent = image_of(COLOURS[..., 0].astype(np.uint16), "mono16")
    with pytest.raises(Error, match=text):
        write_image(
            folder / name, sent if encoding == "mono16" else image_of(COLOURS, "rgb8"), encoding
        )
    assert files(folder) == []


def test_a_calibration_is_written_as_ini(folder):
    camera = CAMERA(width=640, height=480, D=[0.1, -0.2, 0.0, 0.0, 0.0])
    camera.K = [500.0, 0.0, 320.0, 0.0, 500.0, 240.0, 0.0, 0.0, 1.0]
    camera.P = [450.0, 0.0, 320.0, 0.0, 0.0, 450.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    write_calibration(folder / "a.ini", camera)
    text = (folder / "a.ini").read_text(encoding="utf-8")
    assert "width\n640\n\nheight\n480\n" in text
    assert "camera matrix\n500.00000 0.00000 320.00000\n0.00000 500.00000 240.00000\n" in text
    assert "distortion\n0.10000 -0.20000 0.00000 0.00000 0.00000\n" in text
    assert "projection\n450.00000 0.00000 320.00000 0.00000\n" in text


@pytest.fixture
def sender(make_node):
    publisher = make_node("camera").advertise("/camera/image", IMAGE)

    def send():
        publisher.publish(image_of(COLOURS, "rgb8"))

    return send


def saver(make_node, **parameters):
    node = make_node("saver", remappings={"/image": "/camera/image"})
    for name, value in parameters.items():
        node.set_param(f"/saver/{name}", value)
    return ImageSaver(node)


def test_each_image_is_saved_with_its_camera(make_node, sender, folder):
    made = saver(make_node, filename_format="%i.%s", stamped_filename=True)
    made._take_camera(CAMERA(width=4))

    def saved():
        sender()
        return len(files(folder)) >= 4

    until(saved)
    assert files(folder)[:2] == ["12.5000000.ini", "12.5000000.jpg"]


def test_only_the_image_after_a_request_is_saved(make_node, sender, folder):
    made = saver(make_node, save_all_image=False)
    made._take(image_of(COLOURS, "rgb8"))
    assert files(folder) == []
    kind = load_service("std_srvs/Empty")
    make_node("caller").client("/saver/save", kind).call(kind._request_class())

    def saved():
        sender()
        return files(folder)

    until(saved)
    made._take(image_of(COLOURS, "rgb8"))
    assert files(folder) == ["left0000.jpg"]


def test_images_are_saved_from_start_to_end(make_node, folder):
    made = saver(make_node, request_start_end=True)
    kind = load_service("std_srvs/Trigger")
    caller = make_node("caller")
    made._take(image_of(COLOURS, "rgb8"))
    assert caller.client("/saver/start", kind).call(kind._request_class()).success
    made._take(image_of(COLOURS, "rgb8"))
    made._take(image_of(COLOURS, "rgb8"))
    assert caller.client("/saver/end", kind).call(kind._request_class()).success
    made._take(image_of(COLOURS, "rgb8"))
    assert files(folder) == ["left0000.jpg", "left0001.jpg"]


def test_an_image_that_cannot_be_saved_is_warned_of_once(make_node, folder, caplog):
    made = saver(make_node)
    for _ in range(3):
        made._take(image_of(COLOURS[..., 0].astype(np.float32), "32FC1"))
    assert caplog.text.count("is not a color format") == 1
    assert files(folder) == []


def test_images_are_extracted_at_a_rate(make_node, folder):
    clock = SimulatedClock()
    node = make_node("extract", clock=clock)
    node.set_param("/extract/sec_per_frame", 0.5)
    made = ImageExtractor(node)
    for now in (1.0, 1.3, 1.5, 1.7, 2.0):
        clock.set(round(now * 1e9))
        made._take(image_of(COLOURS, "rgb8"))
    assert files(folder) == ["frame0000.jpg", "frame0001.jpg", "frame0002.jpg"]


def test_image_view_names_the_page_and_publishes_what_is_shown(make_node, sender, listen, caplog):
    ImageView(make_node("view", remappings={"/image": "/camera/image"}))
    assert "/view opens no window: `gazelle view` shows /camera/image on its page" in caplog.text
    got = listen("/view/output", IMAGE)

    def shown():
        sender()
        return got

    until(shown)
    assert got[0].encoding == "bgr8"
    assert np.array_equal(CvBridge().imgmsg_to_cv2(got[0], "rgb8"), COLOURS)


@pytest.mark.parametrize(
    ("settings", "kind", "values", "grey"),
    [
        (ViewSettings(), np.uint8, [0, 7, 255], [0, 7, 255]),
        (ViewSettings(), np.uint16, [0, 257, 65535], [0, 1, 255]),
        (ViewSettings(), np.float32, [0.0, 10.0, np.nan], [0, 255, 0]),
        (ViewSettings(max_image_value=5.0), np.float32, [1.0, 5.0, 9.0], [51, 255, 255]),
        (ViewSettings(do_dynamic_scaling=True), np.uint16, [100, 200, 300], [0, 128, 255]),
        (ViewSettings(do_dynamic_scaling=True), np.float32, [2.0, 2.0, 2.0], [0, 0, 0]),
    ],
)
def test_grey_is_stretched_to_what_a_screen_shows(settings, kind, values, grey):
    encoding = {np.uint8: "mono8", np.uint16: "16UC1", np.float32: "32FC1"}[kind]
    found = shown_image(settings, image_of(np.array([values], kind), encoding))
    assert CvBridge().imgmsg_to_cv2(found)[0, :, 0].tolist() == grey
