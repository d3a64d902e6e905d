"""``four_wheel_steering_controller``: four driven wheels, steered in front and behind."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.control.base_controller import BaseController
from gazelle.control.four_wheel_law import FourWheelLaw
from gazelle.control.interfaces import POSITION, VELOCITY
from gazelle.control.parameters import ControllerParameters
from gazelle.control.values import BaseTwist, FourWheelCommand, FourWheelOdometry
from gazelle.control.wheel_geometry import wheel_distance, wheel_radius
from gazelle.errors import ControlError, ControlWarning

_WHEELS = ("front_wheel", "rear_wheel", "front_steering", "rear_steering")


class FourWheelSteeringController(BaseController):
    """Steers so that all wheels roll about one point; joints are left and right, in this order.

    Commands are the speed and a front and a rear angle, or a velocity: the newest counts.
    """

    def init(self, parameters: ControllerParameters) -> None:
        """Read the joints, ``track``, ``wheel_base``, ``wheel_radius``, and what all bases have."""
        names = {kind: parameters.names(kind) for kind in _WHEELS}
        for kind, pair in names.items():
            if len(pair) != 2:
                raise ControlError(
                    f"two joints are needed in '{parameters.place}/{kind}', left and right, not {len(pair)}"
                )
        self.open_base(parameters)
        self._by_twist = self.column("by_twist", kind=bool)
        sizes = self._read_sizes(parameters, names)
        self._wheels = self.claim(VELOCITY, (*names["front_wheel"], *names["rear_wheel"]))
        self._steers = self.claim(POSITION, (*names["front_steering"], *names["rear_steering"]))
        self._angles = self.column("angles", 2)
        self._measured: Floats = np.zeros((self.nworld, 2))
        arrays = (self._angles, self._by_twist, self._measured)
        self.drive_by(
            FourWheelLaw(
                self._wheels,
                self._steers,
                arrays,
                sizes,
                self.law_arguments,
                open_loop=self.open_loop,
            )
        )
        self.add_input("cmd_four_wheel_steering", FourWheelCommand, self._receive_angles)
        self.publish_with_odometry(
            self.add_output("odom_steer", FourWheelOdometry, self._state, queue_size=100)
        )

    def _read_sizes(
        self, parameters: ControllerParameters, names: Mapping[str, tuple[str, ...]]
    ) -> Floats:
        """Return track between steering joints, wheel base, radius, and wheel offset [m]."""
        front, rear = names["front_wheel"], names["rear_wheel"]
        steering = names["front_steering"]
        offset = parameters.number("wheel_steering_y_offset", 0.0)
        if "track" in parameters:
            track = parameters.number("track")
        else:
            track = wheel_distance(self.model, *steering) + 2.0 * offset
        track -= 2.0 * offset
        if "wheel_base" in parameters:
            length = parameters.number("wheel_base")
        else:
            length = wheel_distance(self.model, steering[0], names["rear_steering"][0])
        if "wheel_radius" in parameters:
            radius = parameters.number("wheel_radius")
        else:
            radius = wheel_radius(self.model, front[0])
        if min(track, length, radius) <= 0.0:
            raise ControlError(
                f"track, wheel_base and wheel_radius of '{self.name}' must be positive",
                hint=f"they come from the joints {', '.join((*front, *rear))}",
            )
        return np.array([track, length, radius, offset])

    # -- commands ------------------------------------------------------------------------

    def _receive_angles(self, command: FourWheelCommand, worlds: Worlds | None) -> None:
        rows = self.rows(worlds)
        if not self.running:
            raise ControlError("can't accept new commands: controller is not running")
        target = (command.front_angle, command.rear_angle, command.speed)
        if not all(math.isfinite(each) for each in target):
            text = f"controller '{self.name}' ignores a command that is not finite"
            warnings.warn(ControlWarning(text), stacklevel=3)
            return
        self._angles[rows] = np.clip(target[:2], -math.pi / 2.0, math.pi / 2.0)
        self._by_twist[rows] = False
        self.command_speed(command.speed, rows)

    def _receive(self, twist: BaseTwist, worlds: Worlds | None) -> None:
        super()._receive(twist, worlds)
        if np.isfinite(twist.linear).all() and np.isfinite(twist.angular).all():
            self._by_twist[self.rows(worlds)] = True

    def stand(self, rows: Worlds) -> None:
        """Set the wheels to rest and the steering straight ahead."""
        self._angles[rows] = 0.0
        self._by_twist[rows] = False
        self._wheels.set_command(0.0, None, rows)
        self._steers.set_command(0.0, None, rows)

    def _state(self) -> FourWheelOdometry:
        front, rear = self._measured.T
        speed = np.hypot(self.odometry.twist[:, 0], self.odometry.twist[:, 1])
        signed = np.copysign(speed, self.odometry.twist[:, 0])
        return FourWheelOdometry(self.now_ns, front.copy(), rear.copy(), signed)
