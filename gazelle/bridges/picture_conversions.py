"""Conversions of images to ROS messages, registered on import."""

from __future__ import annotations

import numpy as np

from gazelle.bridges.conversions import (
    ConversionContext,
    Encoder,
    add_encoder,
    set_header,
)
from gazelle.simulation.values import (
    CameraInfoValue,
    CompressedImageValue,
    ImageValue,
    PixelPoints,
)
from gazelle_ros.builtin.images.compression import CompressionSettings, fill_compressed
from gazelle_ros.msgs import sensor_msgs

_FLOAT32 = 7  # sensor_msgs/PointField
_FIELDS = (("x", 0), ("y", 4), ("z", 8), ("rgb", 16))
_POINT = np.dtype(
    {
        "names": ["x", "y", "z", "rgb"],
        "formats": ["<f4", "<f4", "<f4", ("u1", 3)],
        "offsets": [0, 4, 8, 16],
        "itemsize": 32,
    }
)
"""Points as PCL lays them out."""


def _image(message: sensor_msgs.msg.Image, value: ImageValue, view: ConversionContext) -> None:
    set_header(message, view, value.stamp)
    pixels = np.ascontiguousarray(value.pixels[view.world])
    message.height, message.width = pixels.shape[:2]
    message.encoding, message.is_bigendian = value.encoding, 0
    message.step = pixels.nbytes // len(pixels)
    message.data = pixels.astype(pixels.dtype.newbyteorder("<"), copy=False).tobytes()


def _compressed(
    message: sensor_msgs.msg.CompressedImage, value: CompressedImageValue, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    encoding = "mono8" if value.pixels.ndim == 3 else "rgb8"
    fill_compressed(message, value.pixels[view.world], encoding, CompressionSettings())


def _info(
    message: sensor_msgs.msg.CameraInfo, value: CameraInfoValue, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    f, (cx, cy) = value.focal_length, value.center
    message.height, message.width = value.height, value.width
    message.distortion_model, message.D = "plumb_bob", list(value.distortion)
    message.K = [f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0]
    message.R = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    message.P = [f, 0.0, cx, -f * value.baseline, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0]


def _points(
    message: sensor_msgs.msg.PointCloud2, value: PixelPoints, view: ConversionContext
) -> None:
    set_header(message, view, value.stamp)
    points, color = value.points[view.world], value.color[view.world]
    packed = np.zeros(points.shape[:2], _POINT)
    packed["x"], packed["y"], packed["z"] = np.moveaxis(points, -1, 0)
    packed["rgb"] = color
    field = sensor_msgs.msg.PointField
    message.fields = [field(name, offset, _FLOAT32, 1) for name, offset in _FIELDS]
    message.height, message.width = packed.shape
    message.point_step, message.row_step = _POINT.itemsize, _POINT.itemsize * packed.shape[1]
    message.is_bigendian = False
    message.is_dense = bool(np.isfinite(points).all())
    message.data = packed.tobytes()


add_encoder(ImageValue, Encoder("sensor_msgs/Image", _image))
add_encoder(CompressedImageValue, Encoder("sensor_msgs/CompressedImage", _compressed))
add_encoder(CameraInfoValue, Encoder("sensor_msgs/CameraInfo", _info))
add_encoder(PixelPoints, Encoder("sensor_msgs/PointCloud2", _points))
