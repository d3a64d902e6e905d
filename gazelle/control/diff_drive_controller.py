"""``diff_drive_controller``: wheels on a left and a right side."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.control.base_controller import BaseController
from gazelle.control.diff_drive_control_law import DiffDriveControlLaw
from gazelle.control.parameters import ControllerParameters
from gazelle.control.ports import TunableValue
from gazelle.control.values import JointSample, TrajectoryState
from gazelle.control.wheel_geometry import wheel_distance, wheel_radius
from gazelle.description import Cylinder, Sphere
from gazelle.errors import ControlError

_TUNABLES = (
    TunableValue("left_wheel_radius_multiplier", 1.0, 0.5, 1.5, "Left wheel radius multiplier."),
    TunableValue("right_wheel_radius_multiplier", 1.0, 0.5, 1.5, "Right wheel radius multiplier."),
    TunableValue("wheel_separation_multiplier", 1.0, 0.5, 1.5, "Wheel separation multiplier."),
    TunableValue("publish_rate", 50.0, 0.0, 2000.0, "Publish rate of odom."),
    TunableValue("enable_odom_tf", True, False, True, "Publish odom frame to tf."),
)


class DiffDriveController(BaseController):
    """Drives one or more wheels a side; the odometry uses the mean of each side."""

    def init(self, parameters: ControllerParameters) -> None:
        """Read the wheels, their sizes and multipliers, and what all bases have."""
        left, right = parameters.names("left_wheel"), parameters.names("right_wheel")
        if len(left) != len(right):
            raise ControlError(f"#left wheels ({len(left)}) != #right wheels ({len(right)})")
        self.open_base(parameters)
        self._size = self._read_sizes(parameters, left[0], right[0])
        both = parameters.number("wheel_radius_multiplier", 1.0)
        self._multipliers = np.array(
            [
                parameters.number("left_wheel_radius_multiplier", both),
                parameters.number("right_wheel_radius_multiplier", both),
                parameters.number("wheel_separation_multiplier", 1.0),
            ]
        )
        self._wheels = self.claim(self.interfaces[0], (*left, *right))
        self._turned = self.column("turned", 2)
        self._effective = self._size * self._multipliers
        self._sides = DiffDriveControlLaw(
            self._wheels,
            self._turned,
            self._effective,
            self.law_arguments,
            open_loop=self.open_loop,
        )
        self.drive_by(self._sides)
        if parameters.flag("publish_wheel_joint_controller_state", default=False):
            name = "wheel_joint_controller_state"
            self.publish_always(self.add_output(name, TrajectoryState, self._state, queue_size=100))
        self.add_tuning("", _TUNABLES, self._tuned, self._tune)

    def _read_sizes(self, parameters: ControllerParameters, left: str, right: str) -> Floats:
        """Return radius and separation [m], as given or as in the URDF."""
        if "wheel_separation" in parameters:
            separation = parameters.number("wheel_separation")
        else:
            separation = wheel_distance(self.model, left, right)
        if "wheel_radius" in parameters:
            radius = parameters.number("wheel_radius")
        else:
            radius = wheel_radius(self.model, left, (Cylinder, Sphere))
        if separation <= 0.0 or radius <= 0.0:
            raise ControlError(
                f"wheel_separation and wheel_radius must be positive, not {separation:g} and {radius:g}"
            )
        return np.array([radius, radius, separation])

    def _tuned(self) -> dict[str, bool | float]:
        left, right, apart = (float(each) for each in self._multipliers)
        return {
            "left_wheel_radius_multiplier": left,
            "right_wheel_radius_multiplier": right,
            "wheel_separation_multiplier": apart,
            "publish_rate": self.schedule.rate,
            "enable_odom_tf": self.framed,
        }

    def _tune(self, values: Mapping[str, Any]) -> None:
        names = [each.name for each in _TUNABLES[:3]]
        self._multipliers = np.array([values[name] for name in names])
        self._effective[:] = self._size * self._multipliers
        self.schedule.set_rate(values["publish_rate"])
        self.publish_frames(enabled=values["enable_odom_tf"])

    def remeasure(self, rows: Worlds) -> None:
        """Count from here."""
        self._turned[rows] = self._sides.measure()[rows]

    def stand(self, rows: Worlds) -> None:
        """Stop the wheels."""
        self._wheels.set_command(0.0, None, rows)

    def _state(self) -> TrajectoryState:
        position, velocity = self._wheels.position, self._wheels.velocity
        velocities = self._wheels.command()
        onward = position + velocities * self.period
        return TrajectoryState(
            self.now_ns,
            self._wheels.names,
            JointSample(onward, velocities),
            JointSample(position, velocity),
            JointSample(onward - position, velocities - velocity),
            np.full(self.nworld, self.period),
        )
