"""Depth cameras: ``libgazebo_ros_depth_camera.so`` and ``libgazebo_ros_openni_kinect.so``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats32
from gazelle.description import Camera, Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.camera import CameraPlugin, PublishedCamera
from gazelle.plugins.camera_settings import CameraSettings
from gazelle.plugins.pixel_formats import pixels_of
from gazelle.plugins.sensor_kinds import model_of
from gazelle.sensors import CameraModel
from gazelle.simulation import SensorUnit
from gazelle.simulation.values import CameraInfoValue, ImageValue, PixelPoints


class DepthCameraPlugin(CameraPlugin):
    """Pictures, depths and points of a camera."""

    topics = "ir/"

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read names, frame, lens and limits, open the ports."""
        if not model_of(sensor, CameraModel, parameters).depth:
            raise SimulationError(
                f"it needs a sensor of type depth; '{sensor.name}' is of type "
                f"'{sensor.description.type}'",
                source=parameters.source,
            )
        get = parameters.get
        self._least, self._most = get("pointCloudCutoff", 0.4), self.farthest(parameters)
        self._millimetres = get("useDepth16UC1Format", False)
        self._topics = (
            get("depthImageTopicName", "depth/image_raw"),
            get("depthImageCameraInfoTopicName", "depth/camera_info"),
            get("pointCloudTopicName", "points"),
        )
        super().load(sensor, parameters)

    def farthest(self, parameters: Parameters) -> float:
        """Return the depth above which nothing is reported [m]."""
        del parameters
        return math.inf

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        self._camera, self._settings = camera, settings
        topics = PublishedCamera(self._sensor, camera, settings, self.capture)
        self._encoding = topics.encoding
        topics.open()
        depth, info, points = self._topics
        topics.add(depth, ImageValue, self._depths)
        topics.add(info, CameraInfoValue, topics.info)
        topics.add(points, PixelPoints, self._points)

    def _depths(self) -> ImageValue:
        """Return depths in metres, NaN for unknown; or in millimetres, 0 for unknown."""
        seen = self.capture()
        depth, valid = self._valid(seen.depth)
        if not self._millimetres:
            return ImageValue(seen.stamp, np.where(valid, depth, np.float32(math.nan)), "32FC1")
        most = np.iinfo(np.uint16).max
        whole = np.where(valid, np.minimum(depth * 1000.0, most), 0.0)
        return ImageValue(seen.stamp, whole.astype(np.uint16), "16UC1")

    def _points(self) -> PixelPoints:
        """Return points along the rays of pixels, about the middle of the picture."""
        seen = self.capture()
        depth, valid = self._valid(seen.depth)
        focal = self._settings.info(self._camera, seen.stamp).focal_length
        height, width = depth.shape[1:]
        right = ((np.arange(width) - (width - 1) / 2.0) / focal).astype(np.float32)
        down = ((np.arange(height) - (height - 1) / 2.0) / focal).astype(np.float32)
        kept = np.where(valid, depth, np.float32(math.nan))
        points = np.stack((kept * right, kept * down[:, None], kept), axis=-1)
        return PixelPoints(seen.stamp, points, self._picture(seen.color))

    def _picture(self, color: NDArray[Any]) -> NDArray[Any]:
        """Return bytes in the order of the image: the original copies them as they come."""
        coloured = self._encoding in ("rgb8", "bgr8")
        return pixels_of(color, self._encoding if coloured else "rgb8")

    def _valid(self, depth: Floats32 | None) -> tuple[Floats32, Bools]:
        if depth is None:
            raise SimulationError(f"'{self._sensor.name}' measures no depth")
        valid = (depth > self._least) & (depth < self._most) & np.isfinite(depth)
        return depth, valid


class KinectPlugin(DepthCameraPlugin):
    """The same of a Kinect, which sees nothing that is too far."""

    def farthest(self, parameters: Parameters) -> float:
        """Return the depth above which nothing is reported [m]."""
        return parameters.get("pointCloudCutoffMax", 5.0)
