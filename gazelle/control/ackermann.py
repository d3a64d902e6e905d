"""``ackermann_steering_controller``: a driven wheel behind, a steered one in front."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Worlds
from gazelle.control.ackermann_law import AckermannLaw
from gazelle.control.base_controller import BaseController
from gazelle.control.interfaces import POSITION, VELOCITY
from gazelle.control.parameters import ControllerParameters
from gazelle.control.wheel_geometry import joint_origin, wheel_radius
from gazelle.errors import ControlError


class AckermannSteeringController(BaseController):
    """Drives the rear wheel, and steers the front one by ``angular.z``, which is its angle [rad].

    So it is in the original, too: the turning rate of the command is taken as a steering angle.
    """

    def init(self, parameters: ControllerParameters) -> None:
        """Read the two joints, their sizes and multipliers, and what all bases have."""
        rear = parameters.text("rear_wheel", "rear_wheel_joint")
        front = parameters.text("front_steer", "front_steer_joint")
        self.open_base(parameters)
        if "wheel_separation_h" in parameters:
            length = parameters.number("wheel_separation_h")
        else:
            places = [joint_origin(self.model, name)[0] for name in (rear, front)]
            length = abs(places[0] - places[1])
        if "wheel_radius" in parameters:
            radius = parameters.number("wheel_radius")
        else:
            radius = wheel_radius(self.model, rear)
        if length <= 0.0 or radius <= 0.0:
            raise ControlError(
                f"wheel_separation_h and wheel_radius must be positive, not {length:g} and {radius:g}"
            )
        rolling = radius * parameters.number("wheel_radius_multiplier", 1.0)
        effective = length * parameters.number("wheel_separation_h_multiplier", 1.0)
        steering = parameters.number("steer_pos_multiplier", 1.0)
        self._wheel = self.claim(VELOCITY, [rear])
        self._front = self.claim(POSITION, [front])
        self._turned = self.column("turned")
        sizes = np.array([radius, rolling, effective, steering])
        self.drive_by(
            AckermannLaw(
                self._wheel,
                self._front,
                self._turned,
                sizes,
                self.law_arguments,
                open_loop=self.open_loop,
            )
        )

    def remeasure(self, rows: Worlds) -> None:
        """Count from here."""
        self._turned[rows] = self._wheel.position[rows, 0]

    def stand(self, rows: Worlds) -> None:
        """Set the wheel to rest and the steering straight ahead."""
        self._wheel.set_command(0.0, None, rows)
        self._front.set_command(0.0, None, rows)
