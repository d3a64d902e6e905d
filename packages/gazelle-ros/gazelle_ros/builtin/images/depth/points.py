"""Nodelets ``depth_image_proc/point_cloud_xyz``, ``xyzi`` and ``xyzrgb`` (http://wiki.ros.org/depth_image_proc)."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gazelle_ros.base.array_types import Floats, Pixels
from gazelle_ros.base.resampling import Interpolation, resize
from gazelle_ros.builtin.images.conversion import (
    QUEUE,
    TRANSPORT_PARAMETERS,
    ImageConversion,
    camera_topics,
)
from gazelle_ros.builtin.images.depth.metric import depths_of
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.image_geometry.cameramodels import PinholeCameraModel
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_FIELD = sensor_msgs.msg.PointField
_PLACE = [(name, 4 * index, "<f4") for index, name in enumerate("xyz")]
_COLOUR = ("rgb", 16, "<u4")
_INTENSITY = ("intensity", 12, "<f4")
_PLAIN_BYTES, _COLOURED_BYTES = 16, 32


@dataclass(frozen=True, slots=True)
class CloudSettings:
    """Parameters of the nodelets that make clouds of depth images.

    Attributes:
        queue_size: Images that wait for what belongs to them.
        exact_sync: Whether the times of depth and colours are the very same; else they are close.
    """

    queue_size: int = QUEUE
    exact_sync: bool = False


def point_cloud_xyz(node: Node) -> ImageConversion:
    """Return the work of ``point_cloud_xyz``: depth images of ``image_rect`` on ``points``.

    Raises:
        Error: A parameter is wrong.
    """
    settings = settings_of(node, CloudSettings, others=TRANSPORT_PARAMETERS)
    return ImageConversion(
        node,
        camera_topics(node, "image_rect"),
        [("points", sensor_msgs.msg.PointCloud2)],
        lambda depth, camera: [cloud_of_depth(depth, camera)],
        queue_size=settings.queue_size,
    )


def point_cloud_xyzrgb(node: Node) -> ImageConversion:
    """Return the work of ``point_cloud_xyzrgb``: registered depth with the colours of a camera.

    Topics are ``depth_registered/image_rect``, ``rgb/image_rect_color``, ``rgb/camera_info`` and
    ``depth_registered/points``.

    Raises:
        Error: A parameter is wrong.
    """
    return _of_two_cameras(node, "depth_registered", "rgb", "image_rect_color", coloured_cloud)


def point_cloud_xyzi(node: Node) -> ImageConversion:
    """Return the work of ``point_cloud_xyzi``: registered depth with the intensities of a camera.

    Topics are ``depth/image_rect``, ``intensity/image_rect``, ``intensity/camera_info`` and
    ``depth/points``.

    Raises:
        Error: A parameter is wrong.
    """
    cloud_of = functools.partial(coloured_cloud, intensity=True)
    return _of_two_cameras(node, "depth", "intensity", "image_rect", cloud_of)


def _of_two_cameras(
    node: Node,
    depth: str,
    camera: str,
    image: str,
    cloud_of: Callable[..., sensor_msgs.msg.PointCloud2],
) -> ImageConversion:
    """Return the work of a node that colours the depth of one camera by the image of another."""
    settings = settings_of(node, CloudSettings, others=TRANSPORT_PARAMETERS)
    kinds = sensor_msgs.msg
    return ImageConversion(
        node,
        [
            (f"{depth}/image_rect", kinds.Image),
            (f"{camera}/{image}", kinds.Image),
            (f"{camera}/camera_info", kinds.CameraInfo),
        ],
        [(f"{depth}/points", kinds.PointCloud2)],
        lambda *messages: [cloud_of(*messages)],
        queue_size=settings.queue_size,
        exact=settings.exact_sync,
    )


def cloud_of_depth(
    depth: sensor_msgs.msg.Image, camera: sensor_msgs.msg.CameraInfo
) -> sensor_msgs.msg.PointCloud2:
    """Return the point of each pixel [m] in the camera's frame, NaN where there is none.

    Raises:
        ValueError: The image is no depth image, or the camera has no focal length.
        CvBridgeError: The data are not an image of the encoding.
    """
    return _cloud(depth, points_of(depths_of(depth), camera), None)


def coloured_cloud(
    depth: sensor_msgs.msg.Image,
    colours: sensor_msgs.msg.Image,
    camera: sensor_msgs.msg.CameraInfo,
    *,
    intensity: bool = False,
) -> sensor_msgs.msg.PointCloud2:
    """Return the point of each pixel of a depth image with its colour.

    Args:
        depth: Registered to the camera of the colours.
        colours: Of any size; it is resized to that of the depth.
        camera: Camera of the colours.
        intensity: Whether the colours are one value a pixel, of any kind.

    Raises:
        ValueError: The images have different frames, or one is none of its kind.
        CvBridgeError: The data are not an image of the encoding.
    """
    if depth.header.frame_id != colours.header.frame_id:
        raise ValueError(
            f"the frame of the depth is '{depth.header.frame_id}', that of the colours "
            f"'{colours.header.frame_id}'; depth_image_proc/register changes the former"
        )
    pixels = CvBridge().imgmsg_to_cv2(colours, *([] if intensity else ["rgb8"]))
    if intensity and pixels.ndim != 2:
        raise ValueError(f"the encoding is {colours.encoding}; intensities are one value a pixel")
    depths = depths_of(depth)
    if pixels.shape[:2] != depths.shape:
        height, width = depths.shape
        pixels = resize(pixels, height, width, Interpolation.LINEAR)
    points = points_of(depths, camera, depths.shape[1] / max(colours.width, 1))
    return _cloud(depth, points, pixels)


def points_of(
    depths: Floats,
    camera: sensor_msgs.msg.CameraInfo,
    scale: float = 1.0,
    shift: tuple[float, float] = (0.0, 0.0),
) -> Floats:
    """Return points in a camera's optical frame [m], shape (height, width, 3).

    Args:
        depths: Along the optical axis [m], rectified, shape (height, width).
        camera: The camera.
        scale: Of the depth image's pixels, to those of the camera.
        shift: Place in each pixel, from its middle.

    Raises:
        ValueError: The camera has no focal length.
    """
    model = PinholeCameraModel()
    model.fromCameraInfo(camera)
    if not model.fx() > 0.0 or not model.fy() > 0.0:
        raise ValueError("the camera_info has no focal length (P[0], P[5])")
    height, width = depths.shape
    across = (np.arange(width) + shift[0] - model.cx() * scale) / (model.fx() * scale)
    down = (np.arange(height) + shift[1] - model.cy() * scale) / (model.fy() * scale)
    valid = np.where(np.isfinite(depths), depths, np.nan)
    return np.stack((valid * across, valid * down[:, None], valid), axis=-1)


def _cloud(
    depth: sensor_msgs.msg.Image, points: Floats, colours: Pixels | None
) -> sensor_msgs.msg.PointCloud2:
    parts, size = list(_PLACE), _PLAIN_BYTES
    if colours is not None:
        parts.append(_INTENSITY if colours.ndim == 2 else _COLOUR)
        size = _PLAIN_BYTES if colours.ndim == 2 else _COLOURED_BYTES
    names, offsets = [each[0] for each in parts], [each[1] for each in parts]
    formats = [each[2] for each in parts]
    layout = np.dtype({"names": names, "offsets": offsets, "formats": formats, "itemsize": size})
    packed = np.zeros(points.shape[:2], layout)
    for place, name in enumerate("xyz"):
        packed[name] = points[..., place]
    if colours is not None and colours.ndim == 2:
        packed["intensity"] = colours
    elif colours is not None:
        wide = colours.astype(np.uint32)
        packed["rgb"] = wide[..., 0] << 16 | wide[..., 1] << 8 | wide[..., 2]
    height, width = points.shape[:2]
    return sensor_msgs.msg.PointCloud2(
        header=depth.header,
        height=height,
        width=width,
        fields=[_FIELD(name, offset, _FIELD.FLOAT32, 1) for name, offset, _ in parts],
        point_step=size,
        row_step=size * width,
        is_dense=False,
        data=packed.tobytes(),
    )
