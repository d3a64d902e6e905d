"""The node republish of image_transport: raw and compressed images."""

from __future__ import annotations

import numpy as np
import pytest
from ros.graph import until

from gazelle_ros.base.errors import Error
from gazelle_ros.builtin.images.compression import CompressionSettings, compress, decompress
from gazelle_ros.builtin.images.republish import ImageRepublisher, main
from gazelle_ros.compat.cv_bridge.core import CvBridge
from gazelle_ros.msgs import dynamic_reconfigure, sensor_msgs

IMAGE, COMPRESSED = sensor_msgs.msg.Image, sensor_msgs.msg.CompressedImage
PNG = CompressionSettings(format="png")
SHAPES = {
    "mono8": ((5, 7), np.uint8),
    "8UC1": ((5, 7), np.uint8),
    "mono16": ((5, 7), np.uint16),
    "rgb8": ((5, 7, 3), np.uint8),
    "bgr8": ((5, 7, 3), np.uint8),
}


def random_image(encoding):
    """Return an image of an encoding, with a header."""
    shape, kind = SHAPES[encoding]
    values = np.random.default_rng(5).integers(0, np.iinfo(kind).max, shape, kind, endpoint=True)
    image = CvBridge().cv2_to_imgmsg(values, encoding)
    image.header.frame_id, image.header.stamp.secs = "camera", 7
    return image


def smooth_image(encoding="bgr8"):
    """Return an image that JPEG hardly changes."""
    rows, across = np.mgrid[0:48, 0:64]
    return CvBridge().cv2_to_imgmsg(
        np.stack([rows * 3, across * 2, 200 - rows], axis=-1).astype(np.uint8), encoding
    )


@pytest.mark.parametrize("encoding", SHAPES)
def test_png_keeps_every_pixel(encoding):
    image = random_image(encoding)
    packed = compress(image, PNG)
    stored = " bgr8" if image.encoding in {"rgb8", "bgr8"} else ""
    assert packed.format == f"{encoding}; png compressed{stored}"
    assert decompress(packed) == image


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8"])
def test_jpeg_keeps_colours_in_their_order(encoding):
    image = smooth_image(encoding)
    packed = compress(image, CompressionSettings())
    assert packed.format == f"{encoding}; jpeg compressed bgr8"
    found = decompress(packed)
    assert found.encoding == encoding
    before, after = (np.frombuffer(each.data, np.uint8).astype(int) for each in (image, found))
    assert np.abs(before - after).mean() < 2.0


def test_images_of_others_without_an_encoding_are_bgr():
    image = random_image("bgr8")
    packed = compress(image, PNG)
    packed.format = "png"
    assert decompress(packed) == image


def test_quality_makes_images_larger():
    sizes = [
        len(compress(random_image("rgb8"), CompressionSettings(jpeg_quality=each)).data)
        for each in (10, 100)
    ]
    assert sizes[0] < sizes[1]


def test_a_jpeg_is_written_progressively_and_with_restart_marks():
    image = random_image("rgb8")
    start, marks = (
        b"\xff\xc2",
        b"\xff\xdd",
    )  # of a progressive frame, and of its interval of restarts
    plain = bytes(compress(image, CompressionSettings()).data)
    assert start not in plain
    assert marks not in plain
    more = CompressionSettings(jpeg_progressive=True, jpeg_restart_interval=2, jpeg_optimize=True)
    packed = compress(image, more)
    assert start in bytes(packed.data)
    assert marks in bytes(packed.data)
    # The same coefficients, written in another order.
    assert decompress(packed).data == decompress(compress(image, CompressionSettings())).data


@pytest.mark.parametrize(
    ("encoding", "bytes_a_pixel", "settings"),
    [("32FC1", 4, PNG), ("mono16", 2, CompressionSettings()), ("rgb16", 6, PNG)],
)
def test_what_a_format_cannot_hold_is_an_error(encoding, bytes_a_pixel, settings):
    image = IMAGE(height=1, width=1, encoding=encoding, step=bytes_a_pixel)
    image.data = bytes(bytes_a_pixel)
    with pytest.raises(Error, match=f"'{encoding}' are not written as {settings.format}"):
        compress(image, settings)


def test_an_unknown_format_is_named():
    with pytest.raises(Error, match="there is no compression 'jpg'"):
        CompressionSettings(format="jpg")


@pytest.fixture
def republish(make_node, listen):
    """Return a function that starts the node; it returns a sender and what came, by topic."""

    def start(incoming, outgoing=None, **parameters):
        remappings = {"in": "/camera/image", "out": "/repeated"}
        node = make_node("republish", remappings=remappings)
        for name, value in parameters.items():
            node.set_param(f"/repeated/compressed/{name}", value)
        made = ImageRepublisher(node, incoming, outgoing)
        kinds = {"raw": ("", IMAGE), "compressed": ("/compressed", COMPRESSED)}
        suffix, kind = kinds[incoming]
        sender = make_node("camera").advertise(f"/camera/image{suffix}", kind)
        got = {
            name: listen(f"/repeated{each[0]}", each[1])
            for name, each in kinds.items()
            if outgoing in {None, name}
        }
        outputs = [made.raw, made.compressed and made.compressed._publisher]
        until(lambda: sender.num_connections and all(p.num_connections for p in outputs if p))
        return made, sender, got

    return start


def test_all_transports_are_published_by_default(republish):
    _, sender, got = republish("raw", format="png")
    image = random_image("rgb8")
    sender.publish(image)
    until(lambda: got["raw"] and got["compressed"])
    assert got["raw"][0].data == image.data
    assert decompress(got["compressed"][0]).data == image.data
    assert got["compressed"][0].header.frame_id == "camera"


def test_nothing_is_published_where_it_is_disabled(republish):
    made, sender, got = republish("raw", enable=False)
    sender.publish(random_image("rgb8"))
    until(lambda: got["raw"])
    made.compressed.publish(random_image("rgb8"))
    sender.publish(random_image("rgb8"))
    until(lambda: len(got["raw"]) == 2)
    assert not got["compressed"]


def test_compressed_images_become_raw(republish):
    made, sender, got = republish("compressed", "raw")
    assert made.compressed is None
    image = random_image("mono8")
    sender.publish(compress(image, PNG))
    until(lambda: got["raw"])
    assert (got["raw"][0].encoding, got["raw"][0].data) == ("mono8", image.data)


def test_what_cannot_be_read_is_warned_of_once(republish, caplog):
    made, sender, got = republish("compressed", "raw")
    for _ in range(2):
        made._take_compressed(COMPRESSED(format="jpeg", data=b"nothing"))
    sender.publish(compress(random_image("mono8"), PNG))
    until(lambda: got["raw"])
    assert caplog.text.count("a compressed image cannot be read") == 1


def test_the_compression_is_reconfigured(republish, make_node):
    made, sender, got = republish("raw", "compressed")
    kind = dynamic_reconfigure.srv.Reconfigure
    request = kind._request_class()
    request.config.strs = [dynamic_reconfigure.msg.StrParameter("format", "png")]
    make_node("tuner").client("/repeated/compressed/set_parameters", kind).call(request)
    sender.publish(random_image("mono8"))
    until(lambda: got["compressed"])
    assert made.raw is None
    assert got["compressed"][0].format == "mono8; png compressed"


def test_an_unknown_transport_is_named(make_node):
    with pytest.raises(Error, match="no transport 'theora'"):
        ImageRepublisher(make_node("republish"), "raw", "theora")
    with pytest.raises(Error, match="one or two transports"):
        main(["in:=/a", "out:=/b"])
