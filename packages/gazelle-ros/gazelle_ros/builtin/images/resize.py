"""The nodelet ``image_proc/resize``: images and cameras of another size (http://wiki.ros.org/image_proc)."""

from __future__ import annotations

import copy
from dataclasses import dataclass

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.resampling import Interpolation, resize
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.arguments import CallbackWork
from gazelle_ros.builtin.images.conversion import TRANSPORT_PARAMETERS, ImageConversion
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

_IMAGE, _CAMERA = sensor_msgs.msg.Image, sensor_msgs.msg.CameraInfo
_SAME = -1


@dataclass(frozen=True, slots=True)
class ResizeSettings:
    """Parameters of ``image_proc/resize``.

    Attributes:
        interpolation: OpenCV's number: 0 nearest, 1 linear, 2 cubic, 3 area, 4 Lanczos.
        use_scale: Whether the scales count, and not the sizes.
        scale_height: Of the rows.
        scale_width: Of the columns.
        height: Rows wanted; -1 for as many as there are.
        width: Columns wanted; -1 for as many as there are.
    """

    interpolation: int = tunable(1, 0, 4, "Interpolation algorithm between source image pixels")
    use_scale: bool = tunable(True, description="Flag to use scale instead of static size")
    scale_height: float = tunable(1.0, 0.0, 10.0, "Scale of height")
    scale_width: float = tunable(1.0, 0.0, 10.0, "Scale of width")
    height: int = tunable(_SAME, _SAME, 10_000, "Destination height. Ignored if negative")
    width: int = tunable(_SAME, _SAME, 10_000, "Destination width. Ignored if negative")

    def size(self, height: int, width: int) -> tuple[int, int]:
        """Return the rows and columns that a size becomes.

        Raises:
            RosError: Nothing is left.
        """
        if self.use_scale:
            found = round(height * self.scale_height), round(width * self.scale_width)
        else:
            found = _chosen(self.height, height), _chosen(self.width, width)
        if min(found) < 1:
            raise RosError(f"an image of {width} x {height} pixels cannot become {found[::-1]}")
        return found


class Resize(CallbackWork):
    """Images of ``image`` and cameras of ``camera_info`` on ``~image`` and ``~camera_info``.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        settings = settings_of(node, ResizeSettings, others=TRANSPORT_PARAMETERS)
        tuned = TunedSettings(node, settings, lambda _settings: None)
        images, cameras = [("image", _IMAGE)], [("camera_info", _CAMERA)]
        self.images = ImageConversion(
            node,
            images,
            [("~image", _IMAGE)],
            lambda image: [resized_image(tuned.settings, image)],
        )
        self.cameras = ImageConversion(
            node,
            cameras,
            [("~camera_info", _CAMERA)],
            lambda camera: [resized_camera(tuned.settings, camera)],
        )


def resized_image(settings: ResizeSettings, image: sensor_msgs.msg.Image) -> sensor_msgs.msg.Image:
    """Return an image of another size.

    Raises:
        RosError: Nothing is left of it.
        CvBridgeError: The data are not an image of the encoding.
    """
    bridge = CvBridge()
    height, width = settings.size(image.height, image.width)
    way = Interpolation(settings.interpolation)
    pixels = resize(bridge.imgmsg_to_cv2(image), height, width, way)
    return bridge.cv2_to_imgmsg(pixels, image.encoding, image.header)


def resized_camera(
    settings: ResizeSettings, camera: sensor_msgs.msg.CameraInfo
) -> sensor_msgs.msg.CameraInfo:
    """Return the camera whose images have another size.

    Raises:
        RosError: Nothing is left of them.
    """
    height, width = settings.size(camera.height, camera.width)
    if settings.use_scale:
        across, down = settings.scale_width, settings.scale_height
    else:
        across, down = width / camera.width, height / camera.height
    made = copy.deepcopy(camera)
    made.height, made.width = height, width
    made.K = [a * b for a, b in zip(camera.K, _rows(across, down, 3), strict=True)]
    made.P = [a * b for a, b in zip(camera.P, _rows(across, down, 4), strict=True)]
    roi = made.roi
    roi.x_offset, roi.width = int(roi.x_offset * across), int(roi.width * across)
    roi.y_offset, roi.height = int(roi.y_offset * down), int(roi.height * down)
    return made


def _rows(across: float, down: float, columns: int) -> list[float]:
    """Return what the elements of a matrix of three rows are multiplied by."""
    return [across] * columns + [down] * columns + [1.0] * columns


def _chosen(size: int, there: int) -> int:
    return there if size < 0 else size
