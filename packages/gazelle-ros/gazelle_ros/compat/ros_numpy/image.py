"""Images: (height, width) or (height, width, channels)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle_ros.compat.cv_bridge.core import CvBridge
from gazelle_ros.compat.cv_bridge.encodings import encoding_of
from gazelle_ros.compat.ros_numpy.registry import converts_from_numpy, converts_to_numpy
from gazelle_ros.msgs import sensor_msgs


@converts_to_numpy("sensor_msgs/Image")
def image_to_numpy(msg: sensor_msgs.msg.Image) -> NDArray[Any]:
    """Return the pixels as they are in the message."""
    return CvBridge().imgmsg_to_cv2(msg)


@converts_from_numpy("sensor_msgs/Image")
def numpy_to_image(arr: NDArray[Any], encoding: str) -> Any:
    """Return the ``Image`` of pixels.

    Raises:
        CvBridgeError: They do not fit the encoding.
    """
    if arr.ndim == 3 and arr.shape[2] == 1 and encoding_of(encoding).channels == 1:
        arr = arr[:, :, 0]
    return CvBridge().cv2_to_imgmsg(np.ascontiguousarray(arr), encoding)
