"""The nodelet ``image_proc/rectify``: images without the distortion of the lens (http://wiki.ros.org/image_proc)."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.resampling import Interpolation, Resampling
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.images.conversion import (
    QUEUE,
    TRANSPORT_PARAMETERS,
    ImageConversion,
    camera_topics,
)
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.compat.cv_bridge import CvBridge
from gazelle_ros.compat.image_geometry.cameramodels import PinholeCameraModel
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node


@dataclass(frozen=True, slots=True)
class RectifySettings:
    """Parameters of ``image_proc/rectify``.

    Attributes:
        interpolation: OpenCV's number: 0 nearest, 1 linear, 2 cubic, 4 Lanczos.
        queue_size: Images that wait for their ``camera_info``.
        rectified_frame_suffix: Appended to the frame of the images.
    """

    interpolation: int = tunable(1, 0, 4, "Interpolation algorithm between source image pixels")
    queue_size: int = QUEUE
    rectified_frame_suffix: str = ""


class Rectify(ImageConversion):
    """Images of a camera as an ideal pinhole without distortion would see them.

    Args:
        node: On the graph.
        source: Topic of the images; ``camera_info`` is in the same namespace.
        output: Topic of the rectified images.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node, source: str = "image_mono", output: str = "image_rect") -> None:
        settings = settings_of(node, RectifySettings, others=TRANSPORT_PARAMETERS)
        self._tuned = TunedSettings(node, settings, lambda _settings: None)
        self._rectifier = Rectifier()
        super().__init__(
            node,
            camera_topics(node, source),
            [(output, sensor_msgs.msg.Image)],
            self._rectified,
            queue_size=settings.queue_size,
        )

    def _rectified(
        self, image: sensor_msgs.msg.Image, camera: sensor_msgs.msg.CameraInfo
    ) -> list[sensor_msgs.msg.Image]:
        way = Interpolation(self._tuned.settings.interpolation)
        made = self._rectifier.rectify(image, camera, way)
        suffix = self._tuned.settings.rectified_frame_suffix
        if suffix:
            made = copy.copy(made)
            made.header = copy.copy(made.header)
            made.header.frame_id += suffix
        return [made]


class Rectifier:
    """Rectification of the images of one camera, prepared once for all of the same calibration."""

    def __init__(self) -> None:
        self._key: Any = None
        self._resampling: Resampling | None = None

    def rectify(
        self,
        image: sensor_msgs.msg.Image,
        camera: sensor_msgs.msg.CameraInfo,
        interpolation: Interpolation,
    ) -> sensor_msgs.msg.Image:
        """Return a rectified image; the same one if the lens has no distortion, as the original.

        Raises:
            RosError: The camera is not calibrated, or its distortion model is unknown.
            CvBridgeError: The data are not an image of the encoding.
        """
        key = _calibration(camera), image.width, image.height, interpolation
        if key != self._key:
            model = PinholeCameraModel()
            model.fromCameraInfo(camera)
            made = model.rectification(image.width, image.height, interpolation)
            self._resampling = made if any(camera.D) else None
            self._key = key
        if self._resampling is None:
            return image
        bridge = CvBridge()
        rectified = self._resampling.apply(bridge.imgmsg_to_cv2(image))
        return bridge.cv2_to_imgmsg(rectified, image.encoding, image.header)


def _calibration(camera: sensor_msgs.msg.CameraInfo) -> Any:
    """Return what rectification depends on, to be compared."""
    roi = camera.roi
    numbers = [tuple(each) for each in (camera.K, camera.D, camera.R, camera.P)]
    part = roi.x_offset, roi.y_offset, camera.binning_x, camera.binning_y
    return camera.distortion_model, numbers, part
