"""``mecanum_drive_controller``: four wheels with slanted rollers, which drive sideways too."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.control.base_controller import BaseController
from gazelle.control.mecanum_law import MecanumLaw
from gazelle.control.parameters import ControllerParameters
from gazelle.control.wheel_geometry import joint_origin, wheel_radius
from gazelle.errors import ControlError

_WHEELS = ("front_left", "back_left", "back_right", "front_right")

# The share of forward, sideways and turning motion in each wheel: turning by the sum of half the track
# and half the wheel base; rollers stand as an X seen from above.
_MIXING: Floats = np.array([[1, -1, -1], [1, 1, -1], [1, -1, 1], [1, 1, 1]], np.float64)


class MecanumDriveController(BaseController):
    """Drives four mecanum wheels; ``linear.y`` of the command counts as well."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read the wheels and their sizes, and what all bases have."""
        names = [parameters.text(f"{place}_wheel_joint") for place in _WHEELS]
        self.open_base(parameters)
        if "wheel_separation_x" in parameters and "wheel_separation_y" in parameters:
            apart = [parameters.number(f"wheel_separation_{axis}") for axis in "xy"]
            lever = 0.5 * sum(apart)
        else:
            places = np.array([joint_origin(self.model, name)[:2] for name in names])
            lever = 0.5 * float(np.ptp(places, axis=0).sum())
        if "wheel_radius" in parameters:
            radius = parameters.number("wheel_radius")
        else:
            radius = wheel_radius(self.model, names[0])
        if lever <= 0.0 or radius <= 0.0:
            raise ControlError(
                f"distances and wheel_radius must be positive, not {2.0 * lever:g} and {radius:g}"
            )
        self._wheels = self.claim(self.interfaces[0], names)
        self._turned = self.column("turned", 4)
        self.drive_by(
            MecanumLaw(
                self._wheels,
                self._turned,
                radius,
                _MIXING * (1.0, 1.0, lever),
                _MIXING.T / 4.0 / np.array([[1.0], [1.0], [lever]]),
                self.law_arguments,
                open_loop=self.open_loop,
            )
        )

    def remeasure(self, rows: Worlds) -> None:
        """Count from here."""
        self._turned[rows] = self._wheels.position[rows]

    def stand(self, rows: Worlds) -> None:
        """Stop the wheels."""
        self._wheels.set_command(0.0, None, rows)
