"""Camera plugins: ``libgazebo_ros_camera.so`` and similar, with the topic names of files.

Pictures are drawn while there are subscribers, at the sensor's rate in simulated time; those of one
moment have the same stamp on every topic.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from gazelle.array_types import Worlds
from gazelle.description import Camera, Parameters
from gazelle.engines.limits import NANOSECONDS
from gazelle.plugins.camera_settings import CameraSettings
from gazelle.plugins.pixel_formats import encoding_of, pixels_of
from gazelle.plugins.sensor_kinds import model_of
from gazelle.sensors import CameraImage, CameraModel
from gazelle.simulation import Input, SensorOutput, SensorPlugin, SensorUnit
from gazelle.simulation.sensors import SampledSensor
from gazelle.simulation.values import (
    CameraInfoValue,
    CompressedImageValue,
    ImageValue,
    Trigger,
)


class CameraTopic(SensorOutput):
    """A picture's topic: published when the sensor has measured, unless something holds it back.

    Args:
        sensor: Measures.
        settings: Names and frame.
        topic: As the file names it.
        kind: Type of the values.
        read: The value now.
        may_publish: Whether this measurement is published; called once for each.
    """

    def __init__(
        self,
        sensor: SensorUnit,
        settings: CameraSettings,
        topic: str,
        kind: type[Any],
        read: Callable[[], Any],
        may_publish: Callable[[], bool] | None = None,
    ) -> None:
        super().__init__(
            sensor,
            settings.topic(topic),
            kind,
            frame=settings.frame,
            read=read,
            namespace=settings.namespace,
        )
        self._may_publish = may_publish

    def _on_reading(self, sensor: SampledSensor) -> None:
        if self._may_publish is None or self._may_publish():
            super()._on_reading(sensor)


class PublishedCamera:
    """The topics of one camera of a sensor.

    Args:
        sensor: Measures.
        camera: Of the sensor.
        settings: Names and lens.
        capture: The camera's picture now.
        may_publish: Whether a measurement is published.

    Attributes:
        encoding: Of the pictures.
    """

    def __init__(
        self,
        sensor: SensorUnit,
        camera: Camera,
        settings: CameraSettings,
        capture: Callable[[], CameraImage],
        may_publish: Callable[[], bool] | None = None,
    ) -> None:
        self.sensor, self.camera, self.settings, self.capture = sensor, camera, settings, capture
        self.encoding = encoding_of(camera.format, sensor.name)
        self._may_publish = may_publish
        self._last_info_ns: int | None = None

    def open(self) -> None:
        """Open outputs of picture and lens."""
        image = self.settings.image_topic
        self.add(image, ImageValue, self._image)
        self.add(f"{image}/compressed", CompressedImageValue, self._compressed)
        self.add(self.settings.info_topic, CameraInfoValue, self.info, self._info_is_due)

    def add(
        self,
        topic: str,
        kind: type[Any],
        read: Callable[[], Any],
        may_publish: Callable[[], bool] | None = None,
    ) -> None:
        """Add an output under a name."""
        name = self.settings.topic(topic).removeprefix(self.settings.namespace).strip("/")
        self.sensor.robot.outputs[name] = CameraTopic(
            self.sensor, self.settings, topic, kind, read, may_publish or self._may_publish
        )

    def _image(self) -> ImageValue:
        seen = self.capture()
        return ImageValue(seen.stamp, pixels_of(seen.color, self.encoding), self.encoding)

    def _compressed(self) -> CompressedImageValue:
        seen = self.capture()
        grey = self.encoding.startswith("mono")
        return CompressedImageValue(seen.stamp, pixels_of(seen.color, "mono8" if grey else "rgb8"))

    def info(self) -> CameraInfoValue:
        """Return the camera info at the moment of the picture."""
        return self.settings.info(self.camera, self.capture().stamp)

    def _info_is_due(self) -> bool:
        if self._may_publish is not None and not self._may_publish():
            return False
        now = self.sensor.robot.simulation.clock.now_ns
        before, period = self._last_info_ns, self.settings.info_period * NANOSECONDS
        if before is not None and 0 <= now - before < round(period):
            return False
        self._last_info_ns = now
        return True


class CameraPlugin(SensorPlugin):
    """Pictures of a camera.

    Attributes:
        topics: Before the names of topics that the file does not name.
    """

    topics = ""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read names, frame and lens, open the ports."""
        self._sensor = sensor
        camera = model_of(sensor, CameraModel, parameters).cameras[0]
        settings = CameraSettings.read(sensor, camera, parameters, topics=self.topics)
        self.open(camera, settings)

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        PublishedCamera(self._sensor, camera, settings, self.capture).open()

    def capture(self) -> CameraImage:
        """Return the camera's picture now."""
        image: CameraImage = self._sensor.reading(self._sensor.current())
        return image


class PictureTrigger:
    """Messages that each request one picture.

    Args:
        sensor: Measures.
        settings: Name of the topic.
        of: Before the name of the port, of one of several cameras.
    """

    def __init__(self, sensor: SensorUnit, settings: CameraSettings, of: str = "") -> None:
        self._sensor, self._pending, self._published_ns = sensor, 0, -1
        sensor.robot.inputs[of + settings.trigger_topic.strip("/")] = Input(
            settings.topic(settings.trigger_topic), Trigger, self._pull, forget=self._forget
        )

    def _pull(self, _value: Trigger, _worlds: Worlds | None) -> None:
        self._pending += 1

    def _forget(self, _worlds: Worlds | None) -> None:
        self._pending, self._published_ns = 0, -1

    def is_pulled(self) -> bool:
        """Return whether this moment's measurement is published; the same for all topics."""
        now = self._sensor.robot.simulation.clock.now_ns
        if self._published_ns == now:
            return True
        if not self._pending:
            return False
        self._pending, self._published_ns = self._pending - 1, now
        return True


class TriggeredCameraPlugin(CameraPlugin):
    """Pictures of a camera, one for each message on the topic of the trigger."""

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        trigger = PictureTrigger(self._sensor, settings)
        PublishedCamera(self._sensor, camera, settings, self.capture, trigger.is_pulled).open()


class ThermalCameraPlugin(CameraPlugin):
    """Thermal images as in Hector's plugins: grey, with pure red as hot."""

    def open(self, camera: Camera, settings: CameraSettings) -> None:
        """Open the ports."""
        PublishedCamera(self._sensor, replace(camera, format="L8"), settings, self._warmth).open()

    def _warmth(self) -> CameraImage:
        """Return a thermal picture: white where it is (255, 0, 0), else an eighth of the sum."""
        seen = self.capture()
        grey = (seen.color.sum(axis=-1) // 8).astype(np.uint8)
        grey[(seen.color == (255, 0, 0)).all(axis=-1)] = 255
        return replace(seen, color=np.repeat(grey[..., None], 3, axis=-1))


class MultiCameraPlugin(SensorPlugin):
    """Pictures of several cameras that see at once, such as the two of a stereo pair."""

    def load(self, sensor: SensorUnit, parameters: Parameters) -> None:
        """Read names, frame and lenses, open the ports."""
        for number, camera in enumerate(model_of(sensor, CameraModel, parameters).cameras):
            side = next((s for s in ("left", "right") if s in camera.name), camera.name)
            settings = CameraSettings.read(sensor, camera, parameters, suffix=side)

            def capture(number: int = number) -> CameraImage:
                seen = sensor.reading(sensor.current())
                image: CameraImage = seen[number] if isinstance(seen, tuple) else seen
                return image

            may_publish = self.trigger(sensor, settings, side)
            PublishedCamera(sensor, camera, settings, capture, may_publish).open()

    def trigger(
        self,
        sensor: SensorUnit,  # noqa: ARG002
        settings: CameraSettings,  # noqa: ARG002
        side: str,  # noqa: ARG002
    ) -> Callable[[], bool] | None:
        """Return a predicate for publishing a camera's measurement; None if each is published."""
        return None


class TriggeredMultiCameraPlugin(MultiCameraPlugin):
    """The same, each with the topic of a trigger of its own."""

    def trigger(
        self, sensor: SensorUnit, settings: CameraSettings, side: str
    ) -> Callable[[], bool] | None:
        """Return a condition for pictures: one for each message on the topic of the trigger."""
        return PictureTrigger(sensor, settings, f"{side}/").is_pulled
