"""Nodelets ``depth_image_proc/disparity`` and ``crop_foremost`` (http://wiki.ros.org/depth_image_proc)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle_ros.builtin.images.conversion import QUEUE, TRANSPORT_PARAMETERS, ImageConversion
from gazelle_ros.builtin.images.depth.metric import METRES, depths_of
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import sensor_msgs, stereo_msgs
from gazelle_ros.node import Node


@dataclass(frozen=True, slots=True)
class DisparitySettings:
    """Parameters of ``depth_image_proc/disparity``.

    Attributes:
        queue_size: Images that wait for their ``camera_info``.
        min_range: Nearest depth that is measured [m].
        max_range: Farthest one [m].
        delta_d: Smallest step of the disparity [px].
    """

    queue_size: int = QUEUE
    min_range: float = 0.0
    max_range: float = math.inf
    delta_d: float = 0.125


@dataclass(frozen=True, slots=True)
class ForemostSettings:
    """Parameters of ``depth_image_proc/crop_foremost``.

    Attributes:
        distance: Depth that stays behind the nearest pixel, in the image's unit.
    """

    distance: float = 0.0


def disparity(node: Node) -> ImageConversion:
    """Return the work of ``disparity``: depth images of ``left/image_rect`` on ``left/disparity``.

    Raises:
        Error: A parameter is wrong.
    """
    settings = settings_of(node, DisparitySettings, others=TRANSPORT_PARAMETERS)
    kinds = sensor_msgs.msg
    return ImageConversion(
        node,
        [("left/image_rect", kinds.Image), ("right/camera_info", kinds.CameraInfo)],
        [("left/disparity", stereo_msgs.msg.DisparityImage)],
        lambda depth, camera: [disparities(depth, camera, settings)],
        queue_size=settings.queue_size,
    )


def crop_foremost(node: Node) -> ImageConversion:
    """Return the work of ``crop_foremost``: depth images of ``image_raw`` on ``image``.

    Raises:
        Error: A parameter is wrong.
    """
    settings = settings_of(node, ForemostSettings, others=TRANSPORT_PARAMETERS)
    kind = sensor_msgs.msg.Image
    return ImageConversion(
        node,
        [("image_raw", kind)],
        [("image", kind)],
        lambda image: [foremost(image, settings.distance)],
    )


def disparities(
    depth: sensor_msgs.msg.Image, right: sensor_msgs.msg.CameraInfo, settings: DisparitySettings
) -> stereo_msgs.msg.DisparityImage:
    """Return focal length times base over depth [px]; 0 where there is no depth.

    Args:
        depth: Of the left camera.
        right: The right camera: ``P[3]`` is minus the focal length times the base.
        settings: Of the nodelet.

    Raises:
        ValueError: The image is no depth image, or the camera has no focal length.
        CvBridgeError: The data are not an image of the encoding.
    """
    focal = float(right.P[0])
    if not focal > 0.0:
        raise ValueError("the camera_info has no focal length (P[0])")
    constant = -float(right.P[3])
    depths = depths_of(depth)
    good = depths > 0.0
    shifts = np.zeros(depths.shape, np.float32)
    shifts[good] = constant / depths[good]
    made = stereo_msgs.msg.DisparityImage(header=depth.header)
    made.image = CvBridge().cv2_to_imgmsg(shifts, METRES, depth.header)
    made.f, made.T = focal, constant / focal
    made.min_disparity = constant / settings.max_range if settings.max_range > 0.0 else math.inf
    made.max_disparity = constant / settings.min_range if settings.min_range > 0.0 else math.inf
    made.delta_d = settings.delta_d
    return made


def foremost(image: sensor_msgs.msg.Image, distance: float) -> sensor_msgs.msg.Image:
    """Return a depth image with 0 where it is more than a distance behind its nearest pixel.

    Args:
        image: Depths; 0 and NaN are none.
        distance: In the unit of the image.

    Raises:
        CvBridgeError: The data are not an image of the encoding.
    """
    pixels = CvBridge().imgmsg_to_cv2(image).copy()
    seen = np.nan_to_num(pixels, nan=0.0, posinf=0.0) > 0
    if seen.any():
        pixels[~seen | (pixels > pixels[seen].min() + distance)] = 0
    return CvBridge().cv2_to_imgmsg(pixels, image.encoding, image.header)
