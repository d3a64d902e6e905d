"""Wheels that slip: what ``libgazebo_ros_wheel_slip.so`` asks of the solver."""

from __future__ import annotations

import warnings

from gazelle.description import Parameters
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.simulation import ModelPlugin, Robot

_COMPLIANCES = ("slip_compliance_lateral", "slip_compliance_longitudinal")


class WheelSlip(ModelPlugin):
    """Checks its wheels; contacts creep by themselves here, so compliance has no effect."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the wheels; say so if one is to slip."""
        slipping = False
        wheels = list(parameters.find_all("wheel"))
        if not wheels:
            raise SimulationError("a <wheel> is required here", source=parameters.source)
        for wheel in wheels:
            name = wheel.attributes.get("link_name", "")
            link = robot.links[name]
            if len(link.description.collisions) != 1:
                raise SimulationError(
                    f"wheel '{name}' must have exactly one collision", source=wheel.source
                )
            if wheel.require("wheel_normal_force", float) <= 0.0:
                raise SimulationError("wheel_normal_force must be positive", source=wheel.source)
            slipping |= any(wheel.get(tag, 0.0) != 0.0 for tag in _COMPLIANCES)
        if slipping:
            warnings.warn(
                SimulationWarning(
                    f"'{robot.name}': the slip compliance of its wheels is not simulated; they "
                    "slip as their friction lets them"
                ),
                stacklevel=2,
            )
