"""Plugin ``librealsense_gazebo_plugin.so``: the cameras of an Intel RealSense under its names."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from gazelle.description import Camera, Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.camera import CameraPlugin, PublishedCamera
from gazelle.plugins.camera_settings import CameraSettings
from gazelle.plugins.depth_camera import DepthCameraPlugin
from gazelle.simulation import ModelPlugin, Robot
from gazelle.simulation.values import CameraInfoValue, ImageValue, PixelPoints

_FARTHEST = np.iinfo(np.uint16).max / 1000.0  # m; what is farther has no depth


class InfraredTopics(PublishedCamera):
    """Topics of an infrared camera: its grey pictures are called 8UC1."""

    def _image(self) -> ImageValue:
        value = super()._image()
        return replace(value, encoding="8UC1") if value.encoding == "mono8" else value


class RealSenseInfrared(CameraPlugin):
    """Infrared camera of a RealSense."""

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        InfraredTopics(self._sensor, camera, settings, self.capture).open()


class RealSenseDepth(DepthCameraPlugin):
    """Depths in millimetres, and points on request.

    Args:
        parameters: Of the RealSense.
    """

    def __init__(self, parameters: Parameters) -> None:
        super().__init__()
        get = parameters.get
        self._cloud = get("pointCloud", False)
        self._nearest = get("rangeMinDepth", 0.2)
        self._farthest = min(get("rangeMaxDepth", 10.0), _FARTHEST)
        self._cutoff = get("pointCloudCutoff", 0.0), get("pointCloudCutoffMax", 5.0)

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        self._camera, self._settings = camera, settings
        self._least, self._most = self._cutoff
        topics = PublishedCamera(self._sensor, camera, settings, self.capture)
        self._encoding = topics.encoding
        depth, info, points = self._topics
        topics.add(depth, ImageValue, self._depths)
        topics.add(info, CameraInfoValue, topics.info)
        if self._cloud:
            topics.add(points, PixelPoints, self._points)

    def _depths(self) -> ImageValue:
        """Return millimetres, 0 for what is out of the range; points have limits of their own."""
        seen = self.capture()
        depth, _ = self._valid(seen.depth)
        with np.errstate(invalid="ignore"):
            inside = (depth >= self._nearest) & (depth <= self._farthest)
        return ImageValue(
            seen.stamp, np.where(inside, depth * 1000.0, 0.0).astype(np.uint16), "16UC1"
        )


class RealSense(ModelPlugin):
    """Colour, depth and both infrared cameras of a model.

    Its sensors are called by the prefix and ``color``, ``depth``, ``ired1`` or ``ired2``; topics are below
    the plugin's name.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Open the ports of the cameras that are there.

        Raises:
            SimulationError: There is none.
        """
        prefix = parameters.get("prefix", "")
        get = parameters.get
        frames = {
            "color": get("colorOpticalframeName", "color_optical_frame"),
            "ired1": get("infrared1OpticalframeName", "infrared1_optical_frame"),
            "ired2": get("infrared2OpticalframeName", "infrared2_optical_frame"),
            "depth": get("depthOpticalframeName", "depth_optical_frame"),
        }
        topics = {
            "color": (get("colorTopicName", "color/image_raw"), get("colorCameraInfoTopicName", "color/camera_info")),
            "ired1": (get("infrared1TopicName", "infra1/image_raw"), get("infrared1CameraInfoTopicName", "infra1/camera_info")),
            "ired2": (get("infrared2TopicName", "infra2/image_raw"), get("infrared2CameraInfoTopicName", "infra2/camera_info")),
            "depth": (get("depthTopicName", "depth/image_raw"), get("depthCameraInfoTopicName", "depth/camera_info")),
        }  # fmt: skip
        found = [part for part in frames if f"{prefix}{part}" in robot.sensors]
        if not found:
            raise SimulationError(
                f"the model has no sensor '{prefix}color', '{prefix}depth', '{prefix}ired1' or "
                f"'{prefix}ired2'",
                source=parameters.source,
                hint="<prefix> is what their names begin with",
            )
        for part in found:
            sensor = robot.sensors[f"{prefix}{part}"]
            tags = {"frameName": frames[part], **self._tags(part, *topics[part])}
            if part == "depth":
                tags["pointCloudTopicName"] = get("pointCloudTopicName", "depth/color/points")
            self._camera(part, parameters).load(sensor, self._settings(tags, parameters))

    @staticmethod
    def _camera(part: str, parameters: Parameters) -> CameraPlugin:
        if part == "depth":
            return RealSenseDepth(parameters)
        return CameraPlugin() if part == "color" else RealSenseInfrared()

    @staticmethod
    def _tags(part: str, image: str, info: str) -> dict[str, str]:
        """Return the topics of a camera as tags of Gazebo's own camera plugins."""
        if part == "depth":
            return {"depthImageTopicName": image, "depthImageCameraInfoTopicName": info}
        return {"imageTopicName": image, "cameraInfoTopicName": info}

    def _settings(self, tags: dict[str, str], parameters: Parameters) -> Parameters:
        """Return tags as those of a camera plugin of its own."""
        given = {"cameraName": self.handle, **tags}
        children = [Parameters(tag, text, source=parameters.source) for tag, text in given.items()]
        own = parameters.find("robotNamespace")
        kept = [] if own is None else [own]
        return Parameters("plugin", children=(*kept, *children), source=parameters.source)
