"""Quaternions by the batch, always (x, y, z, w)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from gazelle.array_types import Floats
from gazelle.native.quaternion_rows import find_headings


def rotate(q: Floats, v: Floats) -> Floats:
    """Rotate vectors v, shape (..., 3), by unit quaternions q (x, y, z, w), shape (..., 4)."""
    if q.size == 4 and v.size == 3:
        return _rotate_one(q, v)
    axis, w = q[..., :3], q[..., 3:]
    t = 2.0 * cross(axis, v)
    return v + w * t + cross(axis, t)


def _rotate_one(q: Floats, v: Floats) -> Floats:
    """Rotate a single vector, to the bit, without the overhead of arrays."""
    x, y, z, w = q.ravel().tolist()
    a, b, c = v.ravel().tolist()
    i, j, k = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
    turned = np.array(
        (a + w * i + (y * k - z * j), b + w * j + (z * i - x * k), c + w * k + (x * j - y * i))
    )
    return turned.reshape((1,) * (max(q.ndim, v.ndim) - 1) + (3,))


def apply_matrix(matrix: Floats, vectors: Floats) -> Floats:
    """Return a matrix, shape (m, k), times each of some vectors, shape (..., k): shape (..., m).

    The bits of a row do not depend on how many rows there are, which a call of BLAS for all of
    them does not promise.
    """
    total: Floats = vectors[..., 0, None] * matrix[:, 0]
    for column in range(1, matrix.shape[1]):
        total = total + vectors[..., column, None] * matrix[:, column]
    return total


def turns(q: Floats) -> Floats:
    """Return matrices, shape (n, 3, 3), that rotate rows of vectors by multiplication.

    ``v @ turns(q)[i]`` are the vectors v, shape (m, 3), turned by the unit quaternion q[i].
    """
    products = q[:, :, None] * q[:, None, :]
    # A product for each world alone: one for all would round differently with their number.
    return (products.reshape(-1, 1, 16) @ _FROM_PRODUCTS).reshape(-1, 3, 3)


def _from_products() -> Floats:
    """Return the weights from products of (x, y, z, w) to the transposed rotation matrix, shape (16, 9)."""
    weights = np.zeros((4, 4, 3, 3))
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        weights[i, i, i, i] = weights[3, 3, i, i] = 1.0
        weights[j, j, i, i] = weights[k, k, i, i] = -1.0
        weights[i, j, i, j] = weights[i, j, j, i] = 2.0
        weights[3, k, i, j], weights[3, k, j, i] = 2.0, -2.0
    return weights.reshape(16, 9)


_FROM_PRODUCTS = _from_products()


def multiply(a: Floats, b: Floats) -> Floats:
    """Return Hamilton products of quaternions (x, y, z, w), shape (..., 4): first b, then a."""
    if a.size == 4 and b.size == 4:
        return _multiply_one(a, b)
    av, aw, bv, bw = a[..., :3], a[..., 3:], b[..., :3], b[..., 3:]
    vector = aw * bv + bw * av + cross(av, bv)
    scalar = aw * bw - (av * bv).sum(axis=-1, keepdims=True)
    return np.concatenate((vector, scalar), axis=-1)


def _multiply_one(p: Floats, q: Floats) -> Floats:
    """Multiply a single pair, to the bit, without the overhead of arrays."""
    product = product_of(p.ravel().tolist(), q.ravel().tolist())
    return np.array(product).reshape((1,) * (max(p.ndim, q.ndim) - 1) + (4,))


def product_of(p: Sequence[float], q: Sequence[float]) -> tuple[float, float, float, float]:
    """Return what ``multiply`` returns for one pair, to the bit."""
    x, y, z, w = p
    a, b, c, d = q
    return (
        w * a + d * x + (y * c - z * b),
        w * b + d * y + (z * a - x * c),
        w * c + d * z + (x * b - y * a),
        w * d - (x * a + y * b + z * c),
    )


def unit(q: Floats) -> Floats:
    """Return quaternions of length one; zero becomes the identity, as in Gazebo."""
    norm: Floats = np.sqrt(np.einsum("...i,...i->...", q, q))[..., None]
    if norm.all():
        return q / norm
    whole = np.where(norm > 0.0, q, (0.0, 0.0, 0.0, 1.0))
    return whole / np.where(norm > 0.0, norm, 1.0)


def conjugate(q: Floats) -> Floats:
    """Return inverse rotations of unit quaternions (x, y, z, w), shape (..., 4)."""
    turned: Floats = q * _BACK
    return turned


_BACK = np.array([-1.0, -1.0, -1.0, 1.0])


def cross(a: Floats, b: Floats) -> Floats:
    """Return cross products, (..., 3), without the overhead of ``numpy.cross`` and ``stack``."""
    if a.size == 3 and b.size == 3:
        return _cross_one(a, b)
    ax, ay, az = a[..., 0], a[..., 1], a[..., 2]
    bx, by, bz = b[..., 0], b[..., 1], b[..., 2]
    x = ay * bz - az * by
    product = np.empty((*x.shape, 3))
    product[..., 0] = x
    product[..., 1] = az * bx - ax * bz
    product[..., 2] = ax * by - ay * bx
    return product


def _cross_one(a: Floats, b: Floats) -> Floats:
    """Return the cross product of a single pair, to the bit."""
    x, y, z = a.ravel().tolist()
    i, j, k = b.ravel().tolist()
    product = np.array((y * k - z * j, z * i - x * k, x * j - y * i))
    return product.reshape((1,) * (max(a.ndim, b.ndim) - 1) + (3,))


def yaw_of(q: Floats) -> Floats:
    """Return heading about z [rad] in (-pi, pi] of unit quaternions, shape (..., 4)."""
    ahead, aside = _x_axis(np.asarray(q, np.float64).reshape(-1, 4))
    yaw: Floats = np.arctan2(aside, ahead).reshape(q.shape[:-1])
    return yaw


def _x_axis(q: Floats) -> Floats:
    """Return where the x axis points, along x and along y, shape (2, n), after quaternions (n, 4)."""
    found = np.empty((2, len(q)))
    find_headings(q, found[0], found[1])
    return found


def roll_pitch_yaw(q: Floats) -> Floats:
    """Return angles about fixed x, y and z, one after the other, as in ROS' tf.

    Args:
        q: Unit quaternions (x, y, z, w), shape (..., 4).

    Returns:
        Roll and yaw in [-pi, pi], pitch in [-pi/2, pi/2] [rad], shape (..., 3).
    """
    x, y, z, w = (q[..., axis] for axis in range(4))
    roll = np.arctan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2.0 * (w * y - z * x), -1.0, 1.0))
    return np.stack((roll, pitch, yaw_of(q)), axis=-1)


def seen_on_ground(q: Floats, v: Floats) -> Floats:
    """Return the horizontal parts of vectors v, shape (n, 3), along and across the headings of q.

    What looks straight up or down is as if it had not turned.

    Args:
        q: Unit quaternions (x, y, z, w), shape (n, 4).
        v: In the frame that q is in.
    """
    if len(q) == 1:
        return _seen_by_one(q, v)
    ahead, aside = _x_axis(q)
    length = np.sqrt(ahead * ahead + aside * aside)
    upright = length == 0.0
    ahead, length = np.where(upright, 1.0, ahead), np.where(upright, 1.0, length)
    seen = np.zeros(v.shape)
    seen[:, 0] = (ahead * v[:, 0] + aside * v[:, 1]) / length
    seen[:, 1] = (ahead * v[:, 1] - aside * v[:, 0]) / length
    return seen


def _seen_by_one(q: Floats, v: Floats) -> Floats:
    """Return the horizontal parts of one vector, to the bit, without the overhead of arrays."""
    x, y, z, w = q.ravel().tolist()
    a, b, _ = v.ravel().tolist()
    ahead, aside = 1.0 - 2.0 * (y * y + z * z), 2.0 * (w * z + x * y)
    length = math.sqrt(ahead * ahead + aside * aside)
    if length == 0.0:
        ahead = length = 1.0
    return np.array([[(ahead * a + aside * b) / length, (ahead * b - aside * a) / length, 0.0]])


def from_yaw(yaw: Floats) -> Floats:
    """Return quaternions of a turn about z, shape (..., 4), from angles [rad], shape (...)."""
    half = np.asarray(yaw, np.float64) / 2.0
    q = np.zeros((*half.shape, 4))
    np.sin(half, out=q[..., 2])
    np.cos(half, out=q[..., 3])
    return q


def from_matrices(matrices: Floats) -> Floats:
    """Return unit quaternions (x, y, z, w), (..., 4), of rotation matrices, (..., 3, 3).

    Of the four ways to compute one that which divides by the most (Shepperd, 1978).
    """
    m = matrices
    a, b, c = m[..., 0, 0], m[..., 1, 1], m[..., 2, 2]
    xy, yz, zx = (
        m[..., 1, 0] + m[..., 0, 1],
        m[..., 2, 1] + m[..., 1, 2],
        m[..., 0, 2] + m[..., 2, 0],
    )
    x, y, z = m[..., 2, 1] - m[..., 1, 2], m[..., 0, 2] - m[..., 2, 0], m[..., 1, 0] - m[..., 0, 1]
    ways = np.stack(
        [
            np.stack((1.0 + a - b - c, xy, zx, x), axis=-1),
            np.stack((xy, 1.0 - a + b - c, yz, y), axis=-1),
            np.stack((zx, yz, 1.0 - a - b + c, z), axis=-1),
            np.stack((x, y, z, 1.0 + a + b + c), axis=-1),
        ],
        axis=-2,
    )
    largest = np.argmax(np.diagonal(ways, axis1=-2, axis2=-1), axis=-1)
    q = np.take_along_axis(ways, largest[..., None, None], axis=-2)[..., 0, :]
    return np.asarray(q / np.linalg.norm(q, axis=-1, keepdims=True))
