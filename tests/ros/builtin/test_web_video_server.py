"""Images of topics by HTTP, as a browser asks for them."""

from __future__ import annotations

import io
import urllib.error
import urllib.request

import numpy as np
import pytest
from PIL import Image as Pictures
from ros.graph import Background, until

from gazelle_ros import Time
from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.images.compression import CompressionSettings, compress
from gazelle_ros.builtin.web_video.server import WebVideoServer
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import sensor_msgs, std_msgs

IMAGE, PACKED = sensor_msgs.msg.Image, sensor_msgs.msg.CompressedImage
RGB = np.zeros((24, 32, 3), np.uint8)
RGB[:12, :16] = (250, 10, 30)
RGB[12:, 16:] = (20, 200, 90)


def image_of(pixels, encoding="rgb8"):
    header = std_msgs.msg.Header(stamp=Time(3, 500_000_000), frame_id="camera")
    return CvBridge().cv2_to_imgmsg(pixels, encoding, header)


@pytest.fixture
def serve(make_node):
    """Return a function that starts a server on any port, and returns its address."""
    running = []

    def begin(**parameters):
        node = make_node("web_video_server")
        for name, value in {"port": 0, "verbose": False, **parameters}.items():
            node.set_param(f"~{name}", value)
        made = WebVideoServer(node)
        running.append(Background(made.run))
        return f"http://127.0.0.1:{made.port}"

    yield begin
    for each in running:
        each.end()


@pytest.fixture
def camera(make_node):
    """Return a function that publishes an image, latched."""
    node = make_node("camera")

    def publish(topic, message):
        publisher = node.advertise(topic, type(message), latch=True)
        publisher.publish(message)
        return publisher

    return publish


def fetch(address, **headers):
    request = urllib.request.Request(address, headers=headers)
    with urllib.request.urlopen(request, timeout=20) as answer:
        return answer.headers, answer.read()


def pixels_of(data):
    with Pictures.open(io.BytesIO(data)) as picture:
        return np.asarray(picture), picture.format


def parts_of(address, count):
    """Return headers and data of the first parts of a stream."""
    found = []
    with urllib.request.urlopen(address, timeout=20) as answer:
        assert "boundary=boundarydonotcross" in answer.headers["Content-type"]
        assert answer.readline() == b"--boundarydonotcross\r\n"
        while len(found) < count:
            lines = iter(answer.readline, b"\r\n")
            headers = dict(line.decode().strip().split(": ", 1) for line in lines)
            found.append((headers, answer.read(int(headers["Content-Length"]))))
            assert answer.read(2) == b"\r\n"
            assert answer.readline() == b"--boundarydonotcross\r\n"
    return found


def test_a_snapshot_is_a_jpeg_of_the_image(serve, camera):
    address = serve()
    camera("/camera/image", image_of(RGB))
    headers, data = fetch(f"{address}/snapshot?topic=/camera/image")
    pixels, kind = pixels_of(data)
    assert (kind, headers["Content-type"]) == ("JPEG", "image/jpeg")
    assert headers["X-Timestamp"] == "3.500000"
    inner = np.s_[2:10, 2:14]  # away from the edges, which JPEG blurs
    assert np.abs(pixels[inner].astype(int) - RGB[inner]).max() < 8
    turned, _ = pixels_of(fetch(f"{address}/snapshot?topic=camera/image&invert")[1])
    assert np.abs(turned[::-1, ::-1][inner].astype(int) - RGB[inner]).max() < 8


@pytest.mark.parametrize("query", ["&width=64", "&width=8&height=6&quality=20"])
def test_pictures_have_the_size_asked_for(serve, camera, query):
    address = serve()
    camera("/camera/image", image_of(RGB))
    pixels, _ = pixels_of(fetch(f"{address}/snapshot?topic=/camera/image{query}")[1])
    assert pixels.shape == ((24, 64, 3) if "64" in query else (6, 8, 3))


def test_streams_of_jpeg_png_and_compressed_images(serve, camera):
    address = serve(publish_rate=20.0)
    raw = image_of(RGB)
    camera("/camera/image", raw)
    packed = compress(raw, CompressionSettings("png"))
    camera("/camera/image/compressed", packed)
    for kind, mime in (("mjpeg", "jpeg"), ("png", "png"), ("ros_compressed", "png")):
        # The same image again and again, as it is not published a second time.
        parts = parts_of(f"{address}/stream?topic=/camera/image&type={kind}", 3)
        for headers, data in parts:
            assert headers["Content-type"] == f"image/{mime}"
            assert headers["X-Timestamp"] == "3.500000"
            if kind == "png":
                assert (pixels_of(data)[0] == RGB).all()
            if kind == "ros_compressed":
                assert data == bytes(packed.data)
    compressed = f"{address}/snapshot?topic=/camera/image&default_transport=compressed"
    assert pixels_of(fetch(compressed)[1])[0].shape == RGB.shape


def test_depths_are_scaled_to_white_and_alpha_is_kept(serve, camera):
    address = serve(publish_rate=20.0, default_stream_type="png")
    depth = np.array([[0.0, 1.0], [2.0, np.nan]], np.float32)
    camera("/depth/image", image_of(depth, "32FC1"))
    alpha = np.dstack((RGB, np.full(RGB.shape[:2], 77, np.uint8)))
    camera("/alpha/image", image_of(alpha, "rgba8"))
    ((_, data),) = parts_of(f"{address}/stream?topic=/depth/image", 1)
    assert pixels_of(data)[0].tolist() == [[0, 128], [255, 0]]
    ((_, data),) = parts_of(f"{address}/stream?topic=/alpha/image", 1)
    assert (pixels_of(data)[0] == alpha).all()


def test_without_compressed_images_a_stream_is_mjpeg(serve, camera):
    address = serve()
    camera("/camera/image", image_of(RGB))
    ((headers, _),) = parts_of(f"{address}/stream?topic=/camera/image&type=ros_compressed", 1)
    assert headers["Content-type"] == "image/jpeg"


def test_the_pages_list_streams_and_show_one(serve, camera):
    address = serve()
    camera("/front/image_raw", image_of(RGB))
    camera("/front/camera_info", sensor_msgs.msg.CameraInfo())
    camera("/lone", image_of(RGB))
    _, page = fetch(f"{address}/")
    text = page.decode()
    assert '<li>/front/<ul><li><a href="/stream_viewer?topic=/front/image_raw">image_raw' in text
    assert '<a href="/snapshot?topic=/lone">Snapshot</a>' in text
    _, page = fetch(f"{address}/stream_viewer?topic=/lone%3Cscript%3E&width=10")
    assert '<img src="/stream?topic=/lone%3Cscript%3E&amp;width=10">' in page.decode()
    assert "<h1>/lone&lt;script&gt;</h1>" in page.decode()


@pytest.mark.parametrize(
    ("path", "code", "reason"),
    [
        ("/snapshot?topic=/nothing", 404, "nothing publishes '/nothing'"),
        ("/stream?topic=/camera/image&type=vp8", 404, "no stream type 'vp8' here"),
        ("/snapshot?topic=/camera/image&width=-7", 404, "'width' is 1 to 10000, not -7"),
        ("/snapshot?topic=/camera/image&quality=high", 404, "'quality' is a number"),
        ("/films", 404, "/stream_viewer and /snapshot"),
    ],
)
def test_what_is_not_there_is_said(serve, camera, path, code, reason):
    address = serve()
    camera("/camera/image", image_of(RGB))
    with pytest.raises(urllib.error.HTTPError) as caught:
        fetch(address + path)
    assert caught.value.code == code
    assert reason in caught.value.read().decode()


def test_pages_of_other_sites_cannot_read_images(serve, camera):
    address = serve()
    camera("/camera/image", image_of(RGB))
    with pytest.raises(urllib.error.HTTPError, match="403"):
        fetch(f"{address}/snapshot?topic=/camera/image", Origin="http://elsewhere.example")
    headers, _ = fetch(f"{address}/snapshot?topic=/camera/image", Origin="http://localhost:3000")
    assert headers["Access-Control-Allow-Origin"] == "http://localhost:3000"


def test_a_stream_ends_with_its_client_and_with_the_server(serve, camera, make_node):
    address = serve()
    publisher = camera("/camera/image", image_of(RGB))
    parts_of(f"{address}/stream?topic=/camera/image", 1)

    def left():
        publisher.publish(image_of(RGB))  # the next picture finds that nobody reads it
        return not publisher.num_connections

    until(left)
    node = make_node("second")
    node.set_param("~port", int(address.rpartition(":")[2]))
    with pytest.raises(Error, match=r"cannot listen on 127\.0\.0\.1"):
        WebVideoServer(node)
