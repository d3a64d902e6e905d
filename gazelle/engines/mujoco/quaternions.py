"""Quaternions by the batch, and the one place that turns (x, y, z, w) into (w, x, y, z)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Quaternion

Floats = NDArray[np.float64]


def to_wxyz(q: Quaternion) -> tuple[float, float, float, float]:
    """MuJoCo's order of one quaternion."""
    return (q[3], q[0], q[1], q[2])


def wxyz_from_xyzw(q: Floats) -> Floats:
    """MuJoCo's order of many quaternions, shape (..., 4)."""
    return q[..., [3, 0, 1, 2]]


def xyzw_from_wxyz(q: Floats) -> Floats:
    """The public order of many quaternions, shape (..., 4)."""
    return q[..., [1, 2, 3, 0]]


def rotate(q: Floats, v: Floats) -> Floats:
    """Vectors v, shape (..., 3), turned by unit quaternions q (x, y, z, w), shape (..., 4)."""
    axis, w = q[..., :3], q[..., 3:]
    t = 2.0 * cross(axis, v)
    return v + w * t + cross(axis, t)


def multiply(a: Floats, b: Floats) -> Floats:
    """Hamilton products of quaternions (x, y, z, w), shape (..., 4): first b, then a."""
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    vector = aw * bv + bw * av + cross(av, bv)
    scalar = aw * bw - (av * bv).sum(axis=-1, keepdims=True)
    return np.concatenate((vector, scalar), axis=-1)


def conjugate(q: Floats) -> Floats:
    """Inverse rotations of unit quaternions (x, y, z, w), shape (..., 4)."""
    return q * np.array([-1.0, -1.0, -1.0, 1.0])


def cross(a: Floats, b: Floats) -> Floats:
    """Cross products, shape (..., 3), without the overhead of ``numpy.cross``."""
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    return np.stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), axis=-1)
