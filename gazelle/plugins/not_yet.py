"""Plugins that are known and not simulated yet: one warning, and the load goes on."""

from __future__ import annotations

import warnings
from typing import Any

from gazelle.errors import SimulationWarning
from gazelle.simulation import ModelPlugin, SensorPlugin


def _warn(owner: str, what: str) -> None:
    warnings.warn(SimulationWarning(f"'{owner}': {what}"), stacklevel=4)


class Camera(SensorPlugin):
    """A camera's topics: not published yet; the model loads without them."""

    def load(self, sensor: Any, parameters: Any) -> None:
        """Say so."""
        del parameters
        _warn(sensor.name, "cameras are not published yet; its topics stay away")


class NoPicture(ModelPlugin):
    """Projects a picture or shows a video: nothing to see, so nothing is done."""

    def load(self, robot: Any, parameters: Any) -> None:
        """Say so."""
        del parameters
        _warn(robot.name, "pictures on models are not shown; its topic is not listened to")


class RosControl(ModelPlugin):
    """ros_control's controller manager: not there yet; joints are left to themselves."""

    def load(self, robot: Any, parameters: Any) -> None:
        """Say so."""
        del parameters
        _warn(robot.name, "ros_control's controllers are not run yet; its joints move freely")
