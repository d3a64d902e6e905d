"""Quaternions (x, y, z, w) as arrays of shape (4,)."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats
from gazelle_ros.transformations.vectors import EPS


def quaternion_about_axis(angle: float, axis: npt.ArrayLike) -> Floats:
    """Return the quaternion of an angle about an axis of any length."""
    direction = np.asarray(axis, dtype=np.float64)[:3]
    length = math.sqrt(float(direction @ direction))
    result = np.zeros(4)
    if length > EPS:
        result[:3] = direction * (math.sin(angle / 2.0) / length)
    result[3] = math.cos(angle / 2.0)
    return result


def quaternion_matrix(quaternion: npt.ArrayLike) -> Floats:
    """Return the rotation matrix of a quaternion of any norm; of one near 0, the identity."""
    x, y, z, w = np.asarray(quaternion, dtype=np.float64)[:4].tolist()
    norm = x * x + y * y + z * z + w * w
    if norm < EPS:
        return np.identity(4)
    s = 2.0 / norm
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), 0.0],
            [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w), 0.0],
            [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y), 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def quaternion_from_matrix(matrix: npt.ArrayLike) -> Floats:
    """Return the unit quaternion of a rotation matrix, its decisive part positive.

    Source: Shepperd, Quaternion from rotation matrix, 1978.
    """
    m = np.array(matrix, dtype=np.float64)
    scale = float(m[3, 3]) if m.shape[0] > 3 else 1.0
    trace = float(m[0, 0] + m[1, 1] + m[2, 2])
    q = np.empty(4)
    if trace > 0.0:
        square = trace + scale
        q[:] = (m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], square)
    else:
        i = int(np.argmax([m[0, 0], m[1, 1], m[2, 2]]))
        j, k = (i + 1) % 3, (i + 2) % 3
        square = float(m[i, i] - m[j, j] - m[k, k]) + scale
        q[i], q[j], q[k] = square, m[i, j] + m[j, i], m[k, i] + m[i, k]
        q[3] = m[k, j] - m[j, k]
    return q * (0.5 / math.sqrt(square * scale))


def quaternion_multiply(quaternion1: npt.ArrayLike, quaternion0: npt.ArrayLike) -> Floats:
    """Return the Hamilton product: the rotation `quaternion0`, followed by `quaternion1`."""
    ax, ay, az, aw = np.asarray(quaternion1, dtype=np.float64)[:4].tolist()
    bx, by, bz, bw = np.asarray(quaternion0, dtype=np.float64)[:4].tolist()
    return np.array(
        [
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by + ay * bw + az * bx - ax * bz,
            aw * bz + az * bw + ax * by - ay * bx,
            aw * bw - ax * bx - ay * by - az * bz,
        ]
    )


def quaternion_conjugate(quaternion: npt.ArrayLike) -> Floats:
    """Return the quaternion with its vector part negated."""
    return np.asarray(quaternion, dtype=np.float64)[:4] * (-1.0, -1.0, -1.0, 1.0)


def quaternion_inverse(quaternion: npt.ArrayLike) -> Floats:
    """Return the inverse of a quaternion."""
    q = np.asarray(quaternion, dtype=np.float64)
    return np.asarray(quaternion_conjugate(q) / (q @ q))


def quaternion_slerp(
    quat0: npt.ArrayLike,
    quat1: npt.ArrayLike,
    fraction: float,
    spin: int = 0,
    shortestpath: bool = True,  # noqa: FBT001, FBT002  # callers pass it by position
) -> Floats:
    """Return the rotation at a fraction of the way between two.

    Args:
        quat0: Initial quaternion.
        quat1: Final quaternion.
        fraction: 0 at the start, 1 at the end.
        spin: Half turns to add on the way.
        shortestpath: Take the shorter of the two ways.
    """
    start, end = (
        q / math.sqrt(float(q @ q))
        for q in (np.array(quat, dtype=np.float64)[:4] for quat in (quat0, quat1))
    )
    if fraction == 0.0:
        return np.asarray(start)
    if fraction == 1.0:
        return np.asarray(end)
    cosine = float(start @ end)
    if abs(abs(cosine) - 1.0) < EPS:
        return np.asarray(start)
    if shortestpath and cosine < 0.0:
        cosine, end = -cosine, -end
    angle = math.acos(cosine) + spin * math.pi
    if abs(angle) < EPS:
        return np.asarray(start)
    one, two = math.sin((1.0 - fraction) * angle), math.sin(fraction * angle)
    return np.asarray((start * one + end * two) / math.sin(angle))


def random_quaternion(rand: npt.ArrayLike | None = None) -> Floats:
    """Return a rotation from the uniform distribution.

    Args:
        rand: Three numbers between 0 and 1, shape (3,); by default random ones.

    Source: Shoemake, Uniform random rotations, Graphics Gems III, 1992.
    """
    numbers = np.random.default_rng().random(3) if rand is None else np.asarray(rand)
    first, second = math.sqrt(1.0 - numbers[0]), math.sqrt(numbers[0])
    one, two = 2.0 * math.pi * numbers[1], 2.0 * math.pi * numbers[2]
    return np.array(
        [
            math.sin(one) * first,
            math.cos(one) * first,
            math.sin(two) * second,
            math.cos(two) * second,
        ]
    )


def random_rotation_matrix(rand: npt.ArrayLike | None = None) -> Floats:
    """Return a rotation matrix; see `random_quaternion`."""
    return quaternion_matrix(random_quaternion(rand))
