"""Plugin ``librealsense_gazebo_plugin.so``: the cameras of an Intel RealSense under its names."""

from __future__ import annotations

from gazelle.description import Camera, Parameters
from gazelle.errors import SimulationError
from gazelle.plugins.camera import CameraPlugin, PublishedCamera
from gazelle.plugins.camera_settings import CameraSettings
from gazelle.plugins.depth_camera import DepthCameraPlugin
from gazelle.simulation import ModelPlugin, Robot
from gazelle.simulation.values import CameraInfoValue, ImageValue, PixelPoints


class RealSenseDepth(DepthCameraPlugin):
    """Depths in millimetres, and points if they are asked for."""

    def __init__(self, *, cloud: bool, least: float, most: float) -> None:
        super().__init__()
        self._cloud, self._range = cloud, (least, most)

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        self._camera, self._settings = camera, settings
        self._least, self._most = self._range
        topics = PublishedCamera(self._sensor, camera, settings, self.look)
        self._encoding = topics.encoding
        depth, info, points = self._topics
        topics.add(depth, ImageValue, self._depths)
        topics.add(info, CameraInfoValue, topics.info)
        if self._cloud:
            topics.add(points, PixelPoints, self._points)


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
                tags["useDepth16UC1Format"] = "true"
            self._camera(part, parameters).load(sensor, self._settings(tags, parameters))

    @staticmethod
    def _camera(part: str, parameters: Parameters) -> CameraPlugin:
        if part != "depth":
            return CameraPlugin()
        return RealSenseDepth(
            cloud=parameters.get("pointCloud", False),
            least=parameters.get("rangeMinDepth", 0.2),
            most=parameters.get("rangeMaxDepth", 10.0),
        )

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
