"""A complementary filter: gravity and north correct the integrated gyroscope by a part of their error.

Source: R. Valenti, I. Dryanovski, J. Xiao, Keeping a good attitude: a quaternion-based orientation filter
for IMUs and MARGs, Sensors 15, 2015.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle_ros.base.rotations import (
    Quaternion,
    Vector,
    add,
    conjugate,
    minus,
    multiply,
    rotate,
)
from gazelle_ros.builtin.imu.quaternions import about_z, advanced, rate, unit, unit_quaternion

GRAVITY = 9.81
_STILL_ACCELERATION = 0.1
_STILL_TURN = 0.2
_STILL_CHANGE = 0.01
_TRUSTED, _UNTRUSTED = 0.1, 0.2
"""Relative errors of gravity up to which acceleration is trusted, and from which on it is not."""


@dataclass(slots=True)
class ComplementaryFilter:
    """Orientation of a sensor in the world, with x north, y west and z up.

    Attributes:
        gain_acc: Part of gravity's error that a measurement corrects, 0 to 1.
        gain_mag: The same of north's.
        bias_alpha: Part by which a resting sensor's bias is corrected, 0 to 1.
        do_bias_estimation: Estimate the gyroscope's bias while the sensor rests.
        do_adaptive_gain: Trust acceleration less, the more it differs from gravity.
        orientation: Of the sensor in the world; None before the first measurement.
        bias: Of the gyroscope [rad/s].
        is_steady: Whether the sensor rests.
    """

    gain_acc: float = 0.01
    gain_mag: float = 0.01
    bias_alpha: float = 0.01
    do_bias_estimation: bool = True
    do_adaptive_gain: bool = True
    orientation: Quaternion | None = None
    bias: Vector = (0.0, 0.0, 0.0)
    is_steady: bool = False
    _last_turn: Vector = (0.0, 0.0, 0.0)

    def update(
        self, turn: Vector, acceleration: Vector, field: Vector | None, seconds: float
    ) -> None:
        """Take a measurement.

        Args:
            turn: Angular velocity [rad/s].
            acceleration: With gravity [m/s2].
            field: Magnetic field, in any unit; None without one.
            seconds: Since the last one.
        """
        seen = unit(acceleration)
        if seen is None:
            return
        if self.orientation is None:
            level = _levelled(seen)
            self.orientation = level if field is None else _turned(level, field, 1.0)
            return
        if self.do_bias_estimation:
            self._estimate_bias(turn, acceleration)
        q = self.orientation
        q = advanced(q, rate(q, add(turn, minus(self.bias))), seconds)
        gain = self.gain_acc * (trust(acceleration) if self.do_adaptive_gain else 1.0)
        q = multiply(_part(_upright(rotate(q, seen)), gain), q)
        if field is not None:
            q = _turned(q, field, self.gain_mag)
        self.orientation = unit_quaternion(q)

    def _estimate_bias(self, turn: Vector, acceleration: Vector) -> None:
        length = math.sqrt(sum(each**2 for each in acceleration))
        self.is_steady = abs(length - GRAVITY) <= _STILL_ACCELERATION and all(
            abs(now - last) <= _STILL_CHANGE and abs(now - bias) <= _STILL_TURN
            for now, last, bias in zip(turn, self._last_turn, self.bias, strict=True)
        )
        if self.is_steady:
            x, y, z = (
                bias + self.bias_alpha * (now - bias)
                for now, bias in zip(turn, self.bias, strict=True)
            )
            self.bias = (x, y, z)
        self._last_turn = turn


def trust(acceleration: Vector) -> float:
    """Return how far an acceleration is taken for gravity, 0 to 1."""
    error = abs(math.sqrt(sum(each**2 for each in acceleration)) - GRAVITY) / GRAVITY
    return min(max((_UNTRUSTED - error) / (_UNTRUSTED - _TRUSTED), 0.0), 1.0)


def _upright(up: Vector) -> Quaternion:
    """Return the shortest rotation of a direction to z."""
    x, y, z = up
    cosine = math.sqrt(max(0.5 * (z + 1.0), 0.0))
    if cosine < 1e-9:
        return (1.0, 0.0, 0.0, 0.0)  # upside down: any half turn
    return (0.5 * y / cosine, -0.5 * x / cosine, 0.0, cosine)


def _levelled(up: Vector) -> Quaternion:
    """Return an orientation at which a resting accelerometer measures a direction."""
    x, y, z = up
    if z >= 0.0:
        return _upright(up)
    sine = math.sqrt(0.5 * (1.0 - z))
    return conjugate((sine, 0.0, 0.5 * x / sine, -0.5 * y / sine))


def _turned(q: Quaternion, field: Vector, gain: float) -> Quaternion:
    """Return an orientation that is turned about z, so that the field is nearer to north."""
    x, y, _ = rotate(q, field)
    if math.hypot(x, y) < 1e-12:
        return q
    return multiply(_part(about_z(-math.atan2(y, x)), gain), q)


def _part(q: Quaternion, gain: float) -> Quaternion:
    """Return a part of a rotation, by linear interpolation from none."""
    x, y, z, w = q
    return unit_quaternion((gain * x, gain * y, gain * z, 1.0 - gain + gain * w))
