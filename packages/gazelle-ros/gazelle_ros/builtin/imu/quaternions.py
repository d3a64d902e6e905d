"""Unit quaternions (x, y, z, w) of a sensor in the world, as the filters of imu_tools change them."""

from __future__ import annotations

import math

from gazelle_ros.base.rotations import IDENTITY, Quaternion, Vector, multiply

_LEAST = 1e-12


def unit(v: Vector) -> Vector | None:
    """Return a vector with a length of one; None if it has none or is not finite."""
    length = math.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)
    if not (math.isfinite(length) and length > _LEAST):
        return None
    return (v[0] / length, v[1] / length, v[2] / length)


def unit_quaternion(q: Quaternion) -> Quaternion:
    """Return a quaternion with a norm of one; identity if it has none."""
    norm = math.sqrt(sum(each**2 for each in q))
    if norm <= _LEAST:
        return IDENTITY
    return (q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm)


def rate(q: Quaternion, w: Vector) -> Quaternion:
    """Return the derivative of an orientation that turns at w, in the sensor's frame [rad/s]."""
    x, y, z, scalar = multiply(q, (w[0], w[1], w[2], 0.0))
    return (0.5 * x, 0.5 * y, 0.5 * z, 0.5 * scalar)


def advanced(q: Quaternion, derivative: Quaternion, seconds: float) -> Quaternion:
    """Return an orientation some time later, of unit norm."""
    x, y, z, w = (each + seconds * change for each, change in zip(q, derivative, strict=True))
    return unit_quaternion((x, y, z, w))


def about_z(angle: float) -> Quaternion:
    """Return the rotation about z by an angle [rad]."""
    return (0.0, 0.0, math.sin(0.5 * angle), math.cos(0.5 * angle))
