"""Random pictures as cameras publish them, and what their messages have to say."""

import io

import numpy as np
import pytest
from PIL import Image

from gazelle.simulation.values import (
    CameraInfoValue,
    CompressedImageValue,
    ImageValue,
    PixelPoints,
)
from gazelle_ros.compat.cv_bridge.core import CvBridge

ENCODINGS = {
    "mono8": (np.uint8, ()),
    "mono16": (np.uint16, ()),
    "rgb8": (np.uint8, (3,)),
    "rgb16": (np.uint16, (3,)),
    "bayer_rggb8": (np.uint8, ()),
    "32FC1": (np.float32, ()),
    "16UC1": (np.uint16, ()),
}


def _size(rng):
    return tuple(int(n) for n in rng.integers(1, 6, 2))


def image(rng, nworld, stamp):
    encoding = str(rng.choice(list(ENCODINGS)))
    kind, channels = ENCODINGS[encoding]
    pixels = rng.integers(0, 200, (nworld, *_size(rng), *channels)).astype(kind)
    return ImageValue(stamp, pixels, encoding)


def compressed(rng, nworld, stamp):
    channels = (3,) if rng.random() < 0.5 else ()
    pixels = np.full((nworld, *_size(rng), *channels), rng.integers(256), np.uint8)
    return CompressedImageValue(stamp, pixels)


def camera_info(rng, _nworld, stamp):
    height, width = _size(rng)
    distortion, center = tuple(rng.normal(size=5).tolist()), tuple(rng.uniform(1, 5, 2).tolist())
    return CameraInfoValue(
        stamp, width, height, distortion, float(rng.uniform(1, 9)), center, float(rng.random())
    )


def pixel_points(rng, nworld, stamp):
    shape = (nworld, *_size(rng), 3)
    points = rng.normal(size=shape).astype(np.float32)
    points[rng.random(shape[:-1]) < 0.3] = np.nan
    return PixelPoints(stamp, points, rng.integers(0, 256, shape).astype(np.uint8))


def says_image(message, value, world, _view):
    wanted = value.pixels[world]
    assert (message.height, message.width) == wanted.shape[:2]
    assert (message.encoding, message.is_bigendian) == (value.encoding, 0)
    assert message.step * message.height == len(message.data) == wanted.nbytes
    assert np.array_equal(CvBridge().imgmsg_to_cv2(message), wanted)


def says_compressed(message, value, world, _view):
    grey = value.pixels.ndim == 3
    assert message.format == ("mono8; jpeg compressed" if grey else "rgb8; jpeg compressed bgr8")
    seen = np.asarray(Image.open(io.BytesIO(bytes(message.data)))).astype(int)
    assert seen.shape == value.pixels[world].shape
    assert np.abs(seen - value.pixels[world]).max() <= 3


def says_info(message, value, _world, _view):
    f, (cx, cy) = value.focal_length, value.center
    assert (message.width, message.height) == (value.width, value.height)
    assert message.distortion_model == "plumb_bob"
    assert list(message.D) == list(value.distortion)
    assert np.array_equal(np.reshape(message.K, (3, 3)), [[f, 0, cx], [0, f, cy], [0, 0, 1]])
    assert np.array_equal(np.reshape(message.R, (3, 3)), np.eye(3))
    projection = np.reshape(message.P, (3, 4))
    assert np.array_equal(projection[:, :3], np.reshape(message.K, (3, 3)))
    assert list(projection[:, 3]) == pytest.approx([-f * value.baseline, 0.0, 0.0])


def says_pixel_points(message, value, world, _view):
    points = value.points[world]
    assert (message.height, message.width) == points.shape[:2]
    assert (message.point_step, message.row_step) == (32, 32 * points.shape[1])
    raw = np.frombuffer(bytes(message.data), np.uint8).reshape(*points.shape[:2], 32)
    assert np.array_equal(raw[..., :12].copy().view("<f4"), points, equal_nan=True)
    assert np.array_equal(raw[..., 16:19], value.color[world])
    assert bool(message.is_dense) == bool(np.isfinite(points).all())


PICTURE_MAKERS = {
    ImageValue: image,
    CompressedImageValue: compressed,
    CameraInfoValue: camera_info,
    PixelPoints: pixel_points,
}
PICTURES_SAY = {
    ImageValue: says_image,
    CompressedImageValue: says_compressed,
    CameraInfoValue: says_info,
    PixelPoints: says_pixel_points,
}
