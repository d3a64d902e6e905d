"""Depth images in metres: reading, and the nodelet ``depth_image_proc/convert_metric`` (http://wiki.ros.org/depth_image_proc)."""

from __future__ import annotations

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.builtin.images.conversion import TRANSPORT_PARAMETERS, ImageConversion
from gazelle_ros.builtin.parameters import warn_of_others
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

METRES, MILLIMETRES = "32FC1", "16UC1"
_UNIT_M = {METRES: 1.0, MILLIMETRES: 0.001, "mono16": 0.001}
"""Length of a unit of each encoding [m]."""
_MOST_MM = 65535


def depths_of(image: sensor_msgs.msg.Image) -> Floats:
    """Return the depths of an image [m], NaN where there is none; shape (height, width).

    Args:
        image: Of encoding ``32FC1`` [m], or ``16UC1`` [mm] with 0 where there is none.

    Raises:
        ValueError: It is of another encoding.
        CvBridgeError: The data are not an image of the encoding.
    """
    unit = _UNIT_M.get(image.encoding)
    if unit is None:
        raise ValueError(f"the encoding is {image.encoding}; it should be one of {list(_UNIT_M)}")
    pixels = CvBridge().imgmsg_to_cv2(image)
    depths: Floats = pixels.astype(np.float64)
    if unit != 1.0:
        depths = np.where(pixels == 0, np.nan, depths * unit)
    return depths


def image_of_depths(depths: Floats, like: sensor_msgs.msg.Image) -> sensor_msgs.msg.Image:
    """Return depths [m] as an image with the encoding and the header of another one."""
    if like.encoding == METRES:
        return CvBridge().cv2_to_imgmsg(depths.astype(np.float32), METRES, like.header)
    whole = np.clip(np.rint(np.nan_to_num(depths) * 1000.0), 0, _MOST_MM).astype(np.uint16)
    return CvBridge().cv2_to_imgmsg(whole, like.encoding, like.header)


def converted(image: sensor_msgs.msg.Image) -> sensor_msgs.msg.Image:
    """Return a depth image in metres if it is in millimetres, and the other way round.

    Raises:
        ValueError: It is of another encoding.
        CvBridgeError: The data are not an image of the encoding.
    """
    target = MILLIMETRES if image.encoding == METRES else METRES
    like = sensor_msgs.msg.Image(header=image.header, encoding=target)
    return image_of_depths(depths_of(image), like)


def convert_metric(node: Node) -> ImageConversion:
    """Return the work of ``convert_metric``: depth images of ``image_raw`` on ``image``."""
    warn_of_others(node, TRANSPORT_PARAMETERS)
    kind = sensor_msgs.msg.Image
    return ImageConversion(
        node, [("image_raw", kind)], [("image", kind)], lambda image: [converted(image)]
    )
