"""Settings of all of Gazebo's camera plugins: names, frame and lens."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.description import Camera, Parameters
from gazelle.simulation import SensorUnit, absolute, namespace_of
from gazelle.simulation.values import CameraInfoValue


@dataclass(frozen=True, slots=True)
class CameraSettings:
    """The tags of ``gazebo_ros_camera_utils``.

    Attributes:
        namespace: Of the robot.
        prefix: Before the names of topics: the namespace and the camera's name.
        frame: Of the pictures.
        image_topic: Relative to the prefix.
        info_topic: Likewise.
        trigger_topic: Likewise.
        info_period: Least time between two messages about the lens [s].
        focal_length: [pixel]; 0 for that of the field of view.
        center: Column and row of the optical axis [pixel]; 0 for the middle.
        baseline: To the left camera of a pair [m].
        distortion: k1, k2, p1, p2, k3.
    """

    namespace: str
    prefix: str
    frame: str
    image_topic: str
    info_topic: str
    trigger_topic: str
    info_period: float
    focal_length: float
    center: tuple[float, float]
    baseline: float
    distortion: tuple[float, float, float, float, float]

    @classmethod
    def read(
        cls,
        sensor: SensorUnit,
        camera: Camera,
        parameters: Parameters,
        *,
        suffix: str = "",
        topics: str = "",
    ) -> CameraSettings:
        """Read the tags.

        Args:
            sensor: Sensor of the plugin.
            camera: Of the sensor.
            parameters: The tags.
            suffix: After the camera's name, of one of several; only the right one of a pair is
                a baseline away.
            topics: Before the names of topics that the file does not name.
        """
        namespace = namespace_of(sensor.robot, parameters)
        rate = parameters.get("updateRate", 0.0)
        names = (namespace, parameters.get("cameraName", "").strip("/"), suffix.strip("/"))
        return cls(
            namespace,
            absolute("", "/".join(name.strip("/") for name in names if name.strip("/"))),
            parameters.get("frameName", ""),
            parameters.get("imageTopicName", f"{topics}image_raw"),
            parameters.get("cameraInfoTopicName", f"{topics}camera_info"),
            parameters.get("triggerTopicName", "image_trigger"),
            1.0 / rate if rate > 0.0 else 0.0,
            parameters.get("focalLength", 0.0),
            (parameters.get("Cx", 0.0), parameters.get("Cy", 0.0)),
            parameters.get("hackBaseline", 0.0) if suffix in ("", "right") else 0.0,
            _distortion(camera, parameters),
        )

    def topic(self, name: str) -> str:
        """Return the full name of a topic from the file."""
        return name if name.startswith("/") else f"{self.prefix.rstrip('/')}/{name}"

    def info(self, camera: Camera, stamp: int) -> CameraInfoValue:
        """Return the camera info of the lens."""
        width, height = camera.width, camera.height
        own = width / (2.0 * math.tan(camera.horizontal_fov / 2.0))
        column, row = self.center
        return CameraInfoValue(
            stamp,
            width,
            height,
            self.distortion,
            self.focal_length or own,
            (column or (width + 1) / 2.0, row or (height + 1) / 2.0),
            self.baseline,
        )


def _distortion(camera: Camera, parameters: Parameters) -> tuple[float, float, float, float, float]:
    """Return k1, k2, p1, p2, k3: the plugin's, or with ``autoDistortion`` the sensor's."""
    if parameters.get("autoDistortion", False):
        k1, k2, k3, p1, p2 = camera.distortion
        return (k1, k2, p1, p2, k3)
    tags = ("distortionK1", "distortionK2", "distortionT1", "distortionT2", "distortionK3")
    k1, k2, p1, p2, k3 = (parameters.get(tag, 0.0) for tag in tags)
    return (k1, k2, p1, p2, k3)
