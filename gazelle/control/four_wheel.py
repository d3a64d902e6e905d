"""``four_wheel_steering_controller``: four driven wheels, steered in front and behind."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bools, Floats, Worlds
from gazelle.control.base_controller import BaseController
from gazelle.control.interfaces import POSITION, VELOCITY
from gazelle.control.parameters import ControllerParameters
from gazelle.control.values import BaseTwist, FourWheelCommand, FourWheelOdometry
from gazelle.control.wheel_geometry import wheel_distance, wheel_radius
from gazelle.errors import ControlError, ControlWarning

_SLOW = 0.001  # below that a base does not drive [m/s], and a wheel is not steered [rad]
_BENT = 0.01  # tangents of front and rear that are nearer to each other are alike
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
        self._by_twist: Bools = np.zeros(self.nworld, bool)
        self._read_sizes(parameters, names)
        self._wheels = self.claim(VELOCITY, (*names["front_wheel"], *names["rear_wheel"]))
        self._steers = self.claim(POSITION, (*names["front_steering"], *names["rear_steering"]))
        self._angles: Floats = np.zeros((self.nworld, 2))
        self._measured: Floats = np.zeros((self.nworld, 2))
        self.add_input("cmd_four_wheel_steering", FourWheelCommand, self._receive_angles)
        self.add_output("odom_steer", FourWheelOdometry, self._tell, queue_size=100)

    def _read_sizes(
        self, given: ControllerParameters, names: Mapping[str, tuple[str, ...]]
    ) -> None:
        front, rear = names["front_wheel"], names["rear_wheel"]
        steering = names["front_steering"]
        self._offset = given.number("wheel_steering_y_offset", 0.0)
        if "track" in given:
            track = given.number("track")
        else:
            track = wheel_distance(self.model, *steering) + 2.0 * self._offset
        self._track = track - 2.0 * self._offset
        if "wheel_base" in given:
            self._length = given.number("wheel_base")
        else:
            self._length = wheel_distance(self.model, steering[0], names["rear_steering"][0])
        if "wheel_radius" in given:
            self._radius = given.number("wheel_radius")
        else:
            self._radius = wheel_radius(self.model, front[0])
        if min(self._track, self._length, self._radius) <= 0.0:
            raise ControlError(
                f"track, wheel_base and wheel_radius of '{self.name}' must be positive",
                hint=f"they come from the joints {', '.join((*front, *rear))}",
            )

    # -- commands ------------------------------------------------------------------------

    def _receive_angles(self, command: FourWheelCommand, worlds: Worlds | None) -> None:
        rows = self.rows(worlds)
        if not self.running:
            raise ControlError("can't accept new commands: controller is not running")
        wanted = (command.front_angle, command.rear_angle, command.speed)
        if not all(math.isfinite(each) for each in wanted):
            text = f"controller '{self.name}' ignores a command that is not finite"
            warnings.warn(ControlWarning(text), stacklevel=3)
            return
        self._angles[rows] = np.clip(wanted[:2], -math.pi / 2.0, math.pi / 2.0)
        self._by_twist[rows] = False
        self.command_speed(command.speed, rows)

    def _receive(self, twist: BaseTwist, worlds: Worlds | None) -> None:
        super()._receive(twist, worlds)
        if np.isfinite(twist.linear).all() and np.isfinite(twist.angular).all():
            self._by_twist[self.rows(worlds)] = True

    def drive(self, twist: Floats, period: float) -> None:  # noqa: ARG002  it needs no time
        """Steer all wheels about one point, and roll each as fast as it is far from it."""
        forward, by_twist = twist[:, 0], self._by_twist
        slopes = np.tan(np.where(self.too_old()[:, None], 0.0, self._angles))
        bend = slopes[:, 0] - slopes[:, 1]
        turning = np.where(by_twist, twist[:, 2], forward * bend / self._length)
        across = 0.5 * self._length * turning  # of the front axle; the rear's is opposite
        opposite = np.stack((across, -across), axis=1)
        sideways = np.where(by_twist[:, None], opposite, forward[:, None] * slopes)
        # Where angles in front and behind are alike, the speed is that along the wheels.
        bent = by_twist | (np.abs(bend) > _BENT)
        rolling = np.where(bent[:, None], sideways, 0.0)
        half = 0.5 * self._track * turning
        along = np.stack((forward - half, forward + half), axis=1)
        moving = np.abs(forward) > _SLOW
        speeds = np.empty((self.nworld, 4))
        angles = np.empty((self.nworld, 4))
        sign = np.copysign(1.0, forward)
        slip = self._offset * turning
        for axle in (0, 1):
            across = sideways[:, axle, None]
            size = sign[:, None] * np.hypot(along, rolling[:, axle, None])
            size += np.stack((-slip, slip), axis=1)
            columns = slice(2 * axle, 2 * axle + 2)
            speeds[:, columns] = np.where(moving[:, None], size / self._radius, 0.0)
            angles[:, columns] = self._turned_to(sign[:, None], along, across, moving)
        kept = moving | by_twist
        angles = np.where(kept[:, None], angles, self._standing_angles())
        self._wheels.set_command(speeds)
        self._steers.set_command(angles)

    @staticmethod
    def _turned_to(sign: Floats, along: Floats, across: Floats, moving: Bools) -> Floats:
        """Angles of wheels that move along and across; at most a quarter of a turn."""
        inside = (along * sign) > 0.0
        angle = np.arctan2(across * sign, np.where(inside, along * sign, 0.0))
        return np.where(moving[:, None], angle, 0.0)

    def _standing_angles(self) -> Floats:
        """What wheels are steered to while the base stands."""
        slopes = np.tan(np.where(self.too_old()[:, None], 0.0, self._angles))
        lean = 0.5 * self._track * (slopes[:, 0] - slopes[:, 1])
        found = np.zeros((self.nworld, 4))
        for axle in (0, 1):
            for side, sign in enumerate((-1.0, 1.0)):
                away = self._length + sign * lean
                good = np.abs(away) > _SLOW
                slope = self._length * slopes[:, axle] / np.where(good, away, 1.0)
                found[:, 2 * axle + side] = np.where(good, np.arctan(slope), 0.0)
        return found

    def stand(self, rows: Worlds) -> None:
        """Do not roll, steer straight ahead."""
        self._angles[rows] = 0.0
        self._by_twist[rows] = False
        self._wheels.set_command(0.0, None, rows)
        self._steers.set_command(0.0, None, rows)

    # -- odometry ----------------------------------------------------------------------

    def advance(self, period: float) -> bool:
        """Go on by how fast wheels roll and where they are steered to."""
        speeds, angles = self._wheels.velocity, self._steers.position
        if not (np.isfinite(speeds).all() and np.isfinite(angles).all()):
            return False
        front, rear = _mean_angle(angles[:, :2]), _mean_angle(angles[:, 2:])
        self._measured = np.stack((front, rear), axis=1)
        lean = np.tan(front) - np.tan(rear)
        pace, curve = [], []
        for axle, angle in enumerate((front, rear)):
            bend = np.cos(angle) * lean / self._length
            curve.append(bend)
            pace.append(self._pace(speeds[:, 2 * axle : 2 * axle + 2], bend, angle))
        turning = 0.5 * (pace[0] * curve[0] + pace[1] * curve[1])
        forward = 0.5 * (pace[0] * np.cos(front) + pace[1] * np.cos(rear))
        sideways = 0.5 * (pace[0] * np.sin(front) + pace[1] * np.sin(rear))
        twist = np.stack((forward, sideways, turning), axis=1)
        if period > 0.0:
            self.odometry.drive(twist, period)
        return True

    def _pace(self, speeds: Floats, bend: Floats, angle: Floats) -> Floats:
        """Of the middle of an axle [m/s], from those of its two wheels."""
        turn = self._track * bend
        rolled = []
        for side, sign in enumerate((-1.0, 1.0)):
            own = bend / np.sqrt(1.0 + sign * turn * np.cos(angle) + (0.5 * turn) ** 2)
            rolled.append(speeds[:, side] / (1.0 + sign * self._offset * own))
        size = np.sqrt((rolled[0] ** 2 + rolled[1] ** 2) / (2.0 + 0.5 * turn**2))
        return self._radius * np.copysign(1.0, rolled[0] + rolled[1]) * size

    def _tell(self) -> FourWheelOdometry:
        front, rear = self._measured.T
        speed = np.hypot(self.odometry.twist[:, 0], self.odometry.twist[:, 1])
        signed = np.copysign(speed, self.odometry.twist[:, 0])
        return FourWheelOdometry(self.now_ns, front.copy(), rear.copy(), signed)

    def published(self) -> None:
        """Tell of the steering with the odometry."""
        self.outputs["odom_steer"].publish()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """With the angles that are wanted."""
        own = {"angles": self._angles.copy(), "by_twist": self._by_twist.copy()}
        return {**super().state(), **own}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        super().restore(state)
        self._angles = np.array(state["angles"])
        self._by_twist = np.array(state["by_twist"], bool)


def _mean_angle(pair: Floats) -> Floats:
    """The angle of a wheel in the middle of an axle, that of two about the same point."""
    slopes = np.tan(pair)
    straight = (np.abs(pair) <= _SLOW).all(axis=1)
    total = np.where(straight, 1.0, slopes.sum(axis=1))
    total = np.where(total == 0.0, np.inf, total)
    return np.where(straight, 0.0, np.arctan(2.0 * slopes[:, 0] * slopes[:, 1] / total))
