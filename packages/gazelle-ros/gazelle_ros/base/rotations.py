"""Quaternions and vectors as tuples of floats: quicker than arrays for one frame at a time.

Quaternions are (x, y, z, w). Rotations are not normalised: what a broadcaster sends is what a
look-up returns, as in tf2.
"""

from __future__ import annotations

import math

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

ORIGIN: Vector = (0.0, 0.0, 0.0)
IDENTITY: Quaternion = (0.0, 0.0, 0.0, 1.0)


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the rotation b followed by the rotation a (Hamilton product)."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by + ay * bw + az * bx - ax * bz,
        aw * bz + az * bw + ax * by - ay * bx,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(q: Quaternion) -> Quaternion:
    """Return the inverse of a unit quaternion."""
    return (-q[0], -q[1], -q[2], q[3])


def rotate(q: Quaternion, v: Vector) -> Vector:
    """Return the vector part of ``q v q*``: v rotated, and scaled by the square of q's norm."""
    x, y, z, w = q
    vx, vy, vz = v
    ix, iy, iz = w * vx + y * vz - z * vy, w * vy + z * vx - x * vz, w * vz + x * vy - y * vx
    iw = -x * vx - y * vy - z * vz
    return (
        ix * w - iw * x - iy * z + iz * y,
        iy * w - iw * y - iz * x + ix * z,
        iz * w - iw * z - ix * y + iy * x,
    )


def add(a: Vector, b: Vector) -> Vector:
    """Return the sum."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def minus(a: Vector) -> Vector:
    """Return the opposite vector."""
    return (-a[0], -a[1], -a[2])


def mix(a: Vector, b: Vector, ratio: float) -> Vector:
    """Return the point at `ratio` (0 to 1) of the way from a to b."""
    rest = 1.0 - ratio
    return (rest * a[0] + ratio * b[0], rest * a[1] + ratio * b[1], rest * a[2] + ratio * b[2])


def slerp(a: Quaternion, b: Quaternion, ratio: float) -> Quaternion:
    """Return the rotation at `ratio` of the shorter way from a to b.

    Source: Shoemake, Animating rotation with quaternion curves, 1985.
    """
    dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
    norms = math.sqrt(sum(c * c for c in a) * sum(c * c for c in b))
    if norms == 0.0:
        return a
    angle = math.acos(min(1.0, abs(dot) / norms))
    if angle == 0.0:
        return a
    scale = 1.0 / math.sin(angle)
    one = math.sin((1.0 - ratio) * angle) * scale
    two = math.copysign(math.sin(ratio * angle) * scale, dot)
    return (
        a[0] * one + b[0] * two,
        a[1] * one + b[1] * two,
        a[2] * one + b[2] * two,
        a[3] * one + b[3] * two,
    )


Matrix = tuple[Vector, Vector, Vector]


def matrix(q: Quaternion) -> Matrix:
    """Return the rotation matrix, by rows, of a quaternion of any norm but 0."""
    x, y, z, w = q
    s = 2.0 / (x * x + y * y + z * z + w * w)
    xs, ys, zs = x * s, y * s, z * s
    wx, wy, wz = w * xs, w * ys, w * zs
    xx, xy, xz = x * xs, x * ys, x * zs
    yy, yz, zz = y * ys, y * zs, z * zs
    return (
        (1.0 - (yy + zz), xy - wz, xz + wy),
        (xy + wz, 1.0 - (xx + zz), yz - wx),
        (xz - wy, yz + wx, 1.0 - (xx + yy)),
    )


def quaternion(m: Matrix) -> Quaternion:
    """Return the unit quaternion of a rotation matrix, its largest part positive.

    Source: Shepperd, Quaternion from rotation matrix, 1978.
    """
    trace = m[0][0] + m[1][1] + m[2][2]
    if trace > 0.0:
        root = math.sqrt(trace + 1.0)
        half = 0.5 / root
        return (
            (m[2][1] - m[1][2]) * half,
            (m[0][2] - m[2][0]) * half,
            (m[1][0] - m[0][1]) * half,
            root * 0.5,
        )
    i = max(range(3), key=lambda axis: m[axis][axis])
    j, k = (i + 1) % 3, (i + 2) % 3
    root = math.sqrt(m[i][i] - m[j][j] - m[k][k] + 1.0)
    half = 0.5 / root
    parts = [0.0, 0.0, 0.0]
    parts[i] = root * 0.5
    parts[j] = (m[j][i] + m[i][j]) * half
    parts[k] = (m[k][i] + m[i][k]) * half
    return (parts[0], parts[1], parts[2], (m[k][j] - m[j][k]) * half)


def product(a: Matrix, b: Matrix) -> Matrix:
    """Return the matrix product."""
    columns = tuple(zip(*b, strict=True))
    first, second, third = (tuple(x * c[0] + y * c[1] + z * c[2] for c in columns) for x, y, z in a)
    return (_vector(first), _vector(second), _vector(third))


def apply(m: Matrix, v: Vector) -> Vector:
    """Return the matrix times the vector."""
    return _vector(tuple(row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in m))


def _vector(values: tuple[float, ...]) -> Vector:
    x, y, z = values
    return (x, y, z)
