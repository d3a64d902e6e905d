"""Madgwick's filter: a step of gradient descent corrects the integrated gyroscope.

Source: S. Madgwick, An efficient orientation filter for inertial and inertial/magnetic sensor arrays, 2010;
equations 12, 15, 21, 22, 34, 46 and 47.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle_ros.base.rotations import (
    IDENTITY,
    Matrix,
    Quaternion,
    Vector,
    add,
    conjugate,
    minus,
    multiply,
    quaternion,
    rotate,
)
from gazelle_ros.builtin.imu.quaternions import advanced, rate, unit, unit_quaternion

GRAVITY = 9.80665
_WORLDS: dict[str, tuple[Vector, Vector]] = {
    "enu": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    "nwu": ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0)),
    "ned": ((0.0, 0.0, -1.0), (1.0, 0.0, 0.0)),
}
"""From a world frame to the directions of a resting accelerometer and of north."""
WORLD_FRAMES = tuple(_WORLDS)
_LEAST_FIELD = 1e-7
_LEAST_ACCELERATION = 0.1


@dataclass(slots=True)
class MadgwickFilter:
    """Orientation of a sensor in the world.

    Attributes:
        world: ``enu``, ``nwu`` or ``ned``.
        gain: Of the correction [rad/s].
        zeta: Of the gyroscope's drift [rad/s].
        orientation: Of the sensor in the world.
        drift: Of the gyroscope [rad/s].
    """

    world: str = "enu"
    gain: float = 0.1
    zeta: float = 0.0
    orientation: Quaternion = IDENTITY
    drift: Vector = (0.0, 0.0, 0.0)

    def update(
        self, turn: Vector, acceleration: Vector, field: Vector | None, seconds: float
    ) -> None:
        """Take a measurement.

        Args:
            turn: Angular velocity [rad/s].
            acceleration: With gravity, in any unit.
            field: Magnetic field, in any unit; None or not finite without one.
            seconds: Since the last one.
        """
        up, north = _WORLDS[self.world]
        q = self.orientation
        seen, magnet = unit(acceleration), unit(field) if field is not None else None
        step: Quaternion = (0.0, 0.0, 0.0, 0.0)
        if seen is not None:
            step = gradient(q, up, seen)
            if magnet is not None:
                x, y, z = rotate(q, magnet)
                flat = math.hypot(x, y)
                dipped = (north[0] * flat, north[1] * flat, z)  # without a horizontal distortion
                more = gradient(q, dipped, magnet)
                step = _sum(step, more)
            if any(step):
                step = unit_quaternion(step)
            if magnet is not None:
                x, y, z, _ = multiply(conjugate(q), step)
                part = 2.0 * seconds * self.zeta
                self.drift = add(self.drift, (part * x, part * y, part * z))
                turn = add(turn, minus(self.drift))
        x, y, z, w = (
            each - self.gain * back for each, back in zip(rate(q, turn), step, strict=True)
        )
        self.orientation = advanced(q, (x, y, z, w), seconds)

    def gravity(self) -> Vector:
        """Return what a resting accelerometer measures at this orientation [m/s2]."""
        x, y, z = rotate(conjugate(self.orientation), _WORLDS[self.world][0])
        return (x * GRAVITY, y * GRAVITY, z * GRAVITY)


def gradient(q: Quaternion, direction: Vector, measured: Vector) -> Quaternion:
    """Return the gradient of half the squared error of a measured direction.

    Args:
        q: Orientation of the sensor.
        direction: In the world.
        measured: In the frame of the sensor.
    """
    x, y, z, w = q
    dx, dy, dz = direction
    # Equation 21: the direction in the frame of the sensor.
    ex = 2.0 * (dx * (0.5 - y * y - z * z) + dy * (w * z + x * y) + dz * (x * z - w * y))
    ey = 2.0 * (dx * (x * y - w * z) + dy * (0.5 - x * x - z * z) + dz * (w * x + y * z))
    ez = 2.0 * (dx * (w * y + x * z) + dy * (y * z - w * x) + dz * (0.5 - x * x - y * y))
    fx, fy, fz = ex - measured[0], ey - measured[1], ez - measured[2]
    # Equation 22: its derivatives by x, y, z and w.
    by_x = (dy * y + dz * z, dx * y - 2.0 * dy * x + dz * w, dx * z - dy * w - 2.0 * dz * x)
    by_y = (-2.0 * dx * y + dy * x - dz * w, dx * x + dz * z, dx * w + dy * z - 2.0 * dz * y)
    by_z = (-2.0 * dx * z + dy * w + dz * x, -dx * w - 2.0 * dy * z + dz * y, dx * x + dy * y)
    by_w = (dy * z - dz * y, -dx * z + dz * x, dx * y - dy * x)
    gx, gy, gz, gw = (
        2.0 * (each[0] * fx + each[1] * fy + each[2] * fz) for each in (by_x, by_y, by_z, by_w)
    )
    return (gx, gy, gz, gw)


def measured_orientation(
    world: str, acceleration: Vector, field: Vector | None = None
) -> Quaternion | None:
    """Return the orientation that gravity and north alone say; None where they do not.

    Args:
        world: ``enu``, ``nwu`` or ``ned``.
        acceleration: With gravity [m/s2].
        field: Magnetic field [T]; None takes a horizontal direction that the sensor knows.
    """
    x, y, z = acceleration
    if field is None:
        if max(abs(x), abs(y)) > _LEAST_ACCELERATION:
            field = (y, x, 0.0)
        elif abs(z) > _LEAST_ACCELERATION:
            field = (0.0, z, y)
        else:
            return None
    east_long = _cross(field, acceleration)
    if math.sqrt(sum(each**2 for each in east_long)) < _LEAST_FIELD:
        return None
    east, up = unit(east_long), unit(acceleration)
    if east is None or up is None:
        return None
    north = _cross(up, east)
    rows: dict[str, Matrix] = {
        "enu": (east, north, up),
        "nwu": (north, minus(east), up),
        "ned": (north, east, minus(up)),
    }
    return quaternion(rows[world])


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _sum(a: Quaternion, b: Quaternion) -> Quaternion:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3])
