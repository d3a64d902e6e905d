"""The nodelet ``depth_image_proc/register``: depth images in the view of another camera (http://wiki.ros.org/depth_image_proc)."""

from __future__ import annotations

import copy
from dataclasses import dataclass

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.builtin.images.conversion import (
    QUEUE,
    TRANSPORT_PARAMETERS,
    ImageConversion,
    camera_topics,
)
from gazelle_ros.builtin.images.depth.metric import depths_of, image_of_depths
from gazelle_ros.builtin.images.depth.points import points_of
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.scans.points import moved
from gazelle_ros.compat.image_geometry.cameramodels import PinholeCameraModel
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform, TransformException
from gazelle_ros.tf.listening import FrameListener

_MOST_SPREAD_PX = 32
"""Greatest side of what a pixel fills: one very near the other camera would fill the whole image."""


@dataclass(frozen=True, slots=True)
class RegisterSettings:
    """Parameters of ``depth_image_proc/register``.

    Attributes:
        queue_size: Images that wait for both ``camera_info``.
        fill_upsampling_holes: Whether a pixel fills all that its square covers.
        use_rgb_timestamp: Whether images have the time of ``rgb/camera_info``, not their own.
    """

    queue_size: int = QUEUE
    fill_upsampling_holes: bool = False
    use_rgb_timestamp: bool = False


class RegisterDepth(ImageConversion):
    """Depth images of ``depth/image_rect`` as the camera of ``rgb/camera_info`` would see them.

    They are published on ``depth_registered/image_rect``, with ``camera_info`` in its namespace.

    Args:
        node: On the graph, with a transform between the cameras.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._settings = settings_of(node, RegisterSettings, others=TRANSPORT_PARAMETERS)
        self._tree = FrameListener(node).tree
        kinds = sensor_msgs.msg
        super().__init__(
            node,
            [
                ("depth/image_rect", kinds.Image),
                ("depth/camera_info", kinds.CameraInfo),
                ("rgb/camera_info", kinds.CameraInfo),
            ],
            camera_topics(node, "depth_registered/image_rect"),
            self._register,
            queue_size=self._settings.queue_size,
            exact=False,
        )

    def _register(
        self,
        depth: sensor_msgs.msg.Image,
        camera: sensor_msgs.msg.CameraInfo,
        other: sensor_msgs.msg.CameraInfo,
    ) -> tuple[sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo]:
        source, target = (each.header.frame_id.strip("/") for each in (camera, other))
        try:
            transform = self._tree.lookup(target, source, camera.header.stamp.to_nsec())
        except TransformException as error:
            raise ValueError(str(error)) from error
        made = registered(
            depth, camera, other, transform, fill=self._settings.fill_upsampling_holes
        )
        if self._settings.use_rgb_timestamp:
            for each in made:
                each.header.stamp = other.header.stamp
        return made


def registered(
    depth: sensor_msgs.msg.Image,
    camera: sensor_msgs.msg.CameraInfo,
    other: sensor_msgs.msg.CameraInfo,
    transform: StampedTransform,
    *,
    fill: bool = False,
) -> tuple[sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo]:
    """Return a depth image in the view of another camera, and that camera.

    Args:
        depth: Of the first camera, rectified.
        camera: The first camera.
        other: The other camera.
        transform: From the frame of the first camera to that of the other.
        fill: Whether a pixel fills all that its square covers.

    Raises:
        ValueError: The image is no depth image, or a camera has no focal length.
        CvBridgeError: The data are not an image of the encoding.
    """
    model = PinholeCameraModel()
    model.fromCameraInfo(other)
    if not model.fx() > 0.0:
        raise ValueError("the camera_info of rgb has no focal length (P[0])")
    size = other.height // model.binning_y, other.width // model.binning_x
    depths = depths_of(depth)
    shifts = (-0.5, 0.5) if fill else (0.0,)
    corners = [
        moved(transform, points_of(depths, camera, shift=(x, y)).reshape(-1, 3))
        for x in shifts
        for y in shifts
    ]
    view = _seen(corners, model.P, size)
    like = copy.copy(depth)
    like.header = copy.copy(depth.header)
    like.header.frame_id = other.header.frame_id
    info = copy.deepcopy(other)
    info.header.stamp = depth.header.stamp
    image = image_of_depths(view, like)
    return image, info


def _seen(corners: list[Floats], projection: Floats, size: tuple[int, int]) -> Floats:
    """Return the least depth of the points that fall on each pixel [m], NaN without one.

    Args:
        corners: Points of the same pixels in the camera's frame, each (n, 3).
        projection: Of the camera, shape (3, 4).
        size: Rows and columns.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        homogeneous = [each @ projection[:, :3].T + projection[:, 3] for each in corners]
        pixels = np.stack([each[:, :2] / each[:, 2:] for each in homogeneous])
    depth = np.mean([each[:, 2] for each in corners], axis=0)
    ahead = np.isfinite(pixels).all(axis=(0, 2)) & (depth > 0.0)
    pixels, depth = pixels[:, ahead], depth[ahead]
    first, last = np.floor(pixels.min(axis=0) + 0.5), np.floor(pixels.max(axis=0) + 0.5)
    spread = np.minimum(last - first, _MOST_SPREAD_PX)
    view = np.full(size, np.inf)
    for row in range(int(spread[:, 1].max(initial=0.0)) + 1):
        for column in range(int(spread[:, 0].max(initial=0.0)) + 1):
            place = first + np.array((column, row))
            some = (place >= 0).all(axis=1) & (place < size[::-1]).all(axis=1)
            some &= (spread >= np.array((column, row))).all(axis=1)
            x, y = place[some].astype(np.intp).T
            np.minimum.at(view, (y, x), depth[some])
    return np.where(np.isinf(view), np.nan, view)
