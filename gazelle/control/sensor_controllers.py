"""Controllers that publish sensors of the robot."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.control.parameters import ControllerParameters
from gazelle.control.publishing import PublishingSchedule
from gazelle.control.publishing_controller import PublishingController
from gazelle.control.values import ImuSample, StampedWrench


class SensorController(PublishingController):
    """Publishes each sensor of its interface below the sensor's name, at ``publish_rate``."""

    kind: type[Any]

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``publish_rate``, open the ports."""
        names = self.hardware.interface(self.interfaces[0]).resources
        self.schedule = PublishingSchedule(parameters.number("publish_rate"))
        measures: list[Callable[[], Any]] = self.resources(self.interfaces[0], names)
        self.ports = [
            self.add_output(name, self.kind, measure, topic=name, queue_size=4)
            for name, measure in zip(names, measures, strict=True)
        ]


class ImuSensorController(SensorController):
    """Publishes the robot's IMUs."""

    kind = ImuSample


class ForceTorqueSensorController(SensorController):
    """Publishes the robot's force-torque sensors."""

    kind = StampedWrench
