"""Plugins that are known and not simulated: one warning that says what is missing."""

from __future__ import annotations

import warnings
from typing import Any, ClassVar

from gazelle.errors import SimulationWarning
from gazelle.simulation import ModelPlugin, SensorPlugin, VisualPlugin, WorldPlugin


class NotSimulated(WorldPlugin, ModelPlugin, SensorPlugin, VisualPlugin):
    """Of any kind: the load goes on without it."""

    missing: ClassVar[str]

    def load(self, entity: Any, parameters: Any) -> None:
        """Say what is missing."""
        del parameters
        owner = getattr(entity, "name", "world")
        warnings.warn(SimulationWarning(f"'{owner}': {self.missing}"), stacklevel=3)


class Camera(NotSimulated):
    """A camera's topics: not published yet; the model loads without them."""

    missing = "cameras are not published yet; its topics stay away"


class NoPicture(NotSimulated):
    """Projects a picture or shows a video: nothing to see, so nothing is done."""

    missing = "pictures on models are not shown; its topic is not listened to"


class RosControl(NotSimulated):
    """ros_control's controller manager: not there yet; joints are left to themselves."""

    missing = "ros_control's controllers are not run yet; its joints move freely"


class NoKeys(NotSimulated):
    """Keys, joysticks and buttons that drive something: there is no window to press them in."""

    missing = "there are no keys, joysticks or buttons; command it by topics, or from Python"


class NoMovingLight(NotSimulated):
    """Lights that flash or that links carry: they shine as the world says."""

    missing = "lights neither flash nor move with links; they shine as the file says"


class NoMud(NotSimulated):
    """Mud that holds links: they pass through it."""

    missing = "mud does not hold what is in it"


class NoTellTale(NotSimulated):
    """What only Gazebo's own transport tells: it is not told."""

    missing = "what it tells on Gazebo's own topics is not told"


class NoFlight(NotSimulated):
    """Propellers and rudders of a demonstration: they stand still."""

    missing = "its propellers and rudders are not driven"


class NoTrajectory(NotSimulated):
    """Motions written in the plugin itself: the model does not make them."""

    missing = "the motion that is written in this plugin is not made"


class NoGearShift(NotSimulated):
    """A gearbox whose ratio changes: it keeps the one of its joint."""

    missing = "its ratio does not change; the gearbox keeps that of its joint"


class NoRubble(NotSimulated):
    """Models strewn at random, or a map of the Earth: the world stays without."""

    missing = "the models that it would put into the world are left out"


class NoMotorModel(NotSimulated):
    """Limits of motors by a model of them: joints keep those of the file."""

    missing = "its models of motors limit nothing; joints have the limits of the file"


class NoOwnNoise(NotSimulated):
    """Noise of rays of a demonstration: the sensor has what its <noise> says."""

    missing = "it adds no noise to the rays; give the sensor a <noise>"
