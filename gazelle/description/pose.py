"""Rigid transforms: position in metres, orientation as a unit quaternion (x, y, z, w)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.errors import FormatError

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

_IDENTITY: Quaternion = (0.0, 0.0, 0.0, 1.0)
_ROUNDING = 1e-14
_FAILURES = (ArithmeticError, LookupError, TypeError, ValueError)
"""Errors that values lead to which are no three or four numbers."""


class Pose:
    """A pose of a child frame in a parent frame, and the transform from child to parent.

    ``a * b`` composes: a pose b given in the child frame of a, in the parent frame of a.
    Roll, pitch and yaw turn about the fixed x, y, z axes in that order, as SDF, URDF and
    tf do: R = Rz(yaw) Ry(pitch) Rx(roll). The pose of a world that diverged holds NaN.

    Args:
        x: Position [m].
        y: Position [m].
        z: Position [m].
        roll: Rotation about x [rad].
        pitch: Rotation about y [rad].
        yaw: Rotation about z [rad].

    Raises:
        FormatError: One of them is not a number, or an int beyond all floats.
    """

    __slots__ = ("_position", "_quaternion")

    def __init__(
        self,
        x: float = 0.0,
        y: float = 0.0,
        z: float = 0.0,
        roll: float = 0.0,
        pitch: float = 0.0,
        yaw: float = 0.0,
    ) -> None:
        try:
            self._position: Vector3 = (float(x), float(y), float(z))
            self._quaternion: Quaternion = (
                _IDENTITY
                if roll == 0.0 and pitch == 0.0 and yaw == 0.0
                else quaternion_from_rpy(roll, pitch, yaw)
            )
        except _FAILURES as error:
            raise _refused("six numbers", error) from error

    @classmethod
    def from_quaternion(
        cls, position: Sequence[float] = (0.0, 0.0, 0.0), quaternion: Sequence[float] = _IDENTITY
    ) -> Pose:
        """Return a pose from a position [m] and a quaternion (x, y, z, w), which is normalised.

        One that has length one but for rounding keeps its numbers, so that a pose that is
        written and read stays the same. One of length zero becomes the identity, as in Gazebo.
        NaN stays NaN.

        Raises:
            FormatError: They are not three and four numbers.
        """
        try:
            return cls._normalized(position, quaternion)
        except _FAILURES as error:
            raise _refused("three numbers and a quaternion of four", error) from error

    @classmethod
    def _normalized(cls, position: Sequence[float], quaternion: Sequence[float]) -> Pose:
        px, py, pz = position
        x, y, z, w = quaternion
        norm = math.sqrt(x * x + y * y + z * z + w * w)
        if norm in (0.0, math.inf):  # the squares of very small or large numbers
            largest = max(map(abs, quaternion))
            if 0.0 < largest < math.inf:
                return cls._normalized(position, [q / largest for q in quaternion])
        turned = _IDENTITY
        if norm != 0.0:
            scale = 1.0 if abs(norm - 1.0) < _ROUNDING else norm
            turned = float(x) / scale, float(y) / scale, float(z) / scale, float(w) / scale
        return cls.exactly((float(px), float(py), float(pz)), turned)

    @classmethod
    def exactly(cls, position: Vector3, quaternion: Quaternion) -> Pose:
        """Return a pose of the very numbers, NaN too, of another's ``position`` and ``quaternion``."""
        pose = cls.__new__(cls)
        pose._position, pose._quaternion = position, quaternion  # noqa: SLF001  its own class
        return pose

    @classmethod
    @checked(FormatError, after=True)
    def from_matrix(cls, matrix: NDArray[np.float64]) -> Pose:
        """Return a pose from a homogeneous transform, shape (4, 4), or a rotation, shape (3, 3)."""
        position = matrix[:3, 3] if matrix.shape == (4, 4) else (0.0, 0.0, 0.0)
        return cls.from_quaternion(tuple(position), quaternion_from_matrix(matrix[:3, :3]))

    @property
    def position(self) -> Vector3:
        """(x, y, z) [m]."""
        return self._position

    @property
    def quaternion(self) -> Quaternion:
        """Unit quaternion (x, y, z, w)."""
        return self._quaternion

    @property
    def numbers(self) -> tuple[float, ...]:
        """The seven numbers of position and quaternion."""
        return (*self._position, *self._quaternion)

    @property
    def x(self) -> float:
        """Position along x [m]."""
        return self._position[0]

    @property
    def y(self) -> float:
        """Position along y [m]."""
        return self._position[1]

    @property
    def z(self) -> float:
        """Position along z [m]."""
        return self._position[2]

    @property
    def rpy(self) -> Vector3:
        """(roll, pitch, yaw) [rad], pitch within [-pi/2, pi/2]."""
        return rpy_from_quaternion(self._quaternion)

    @property
    def roll(self) -> float:
        """Rotation about x [rad]."""
        return self.rpy[0]

    @property
    def pitch(self) -> float:
        """Rotation about y [rad]."""
        return self.rpy[1]

    @property
    def yaw(self) -> float:
        """Rotation about z [rad]."""
        return self.rpy[2]

    def __mul__(self, other: Pose) -> Pose:
        """Compose poses.

        ``other`` is given in this pose's child frame, the result in this pose's parent frame.
        """
        moved = rotate(self._quaternion, other._position)
        x, y, z = (a + b for a, b in zip(self._position, moved, strict=True))
        return Pose._normalized((x, y, z), multiply(self._quaternion, other._quaternion))

    def inverse(self) -> Pose:
        """Return the pose of the parent frame in the child frame."""
        x, y, z, w = self._quaternion
        conjugate: Quaternion = (-x, -y, -z, w)
        px, py, pz = rotate(conjugate, self._position)
        return Pose._normalized((-px, -py, -pz), conjugate)

    def apply(self, point: Sequence[float]) -> Vector3:
        """Return a point [m] of the child frame in the parent frame; of NaN NaN."""
        px, py, pz = self.rotate(point)
        return (self.x + px, self.y + py, self.z + pz)

    def rotate(self, vector: Sequence[float]) -> Vector3:
        """Return a direction of the child frame in the parent frame; of NaN NaN."""
        try:
            return rotate(self._quaternion, (vector[0], vector[1], vector[2]))
        except _FAILURES as error:
            raise _refused("three numbers", error) from error

    def matrix(self) -> NDArray[np.float64]:
        """Return the homogeneous transform from child to parent, shape (4, 4)."""
        matrix = np.eye(4)
        for column, axis in enumerate(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))):
            matrix[:3, column] = rotate(self._quaternion, axis)
        matrix[:3, 3] = self._position
        return matrix

    def is_close(self, other: Pose, *, position: float = 1e-9, angle: float = 1e-9) -> bool:
        """Return whether two poses agree within a distance [m] and an angle [rad]; never with NaN."""
        delta = self.inverse() * other
        sine = math.sqrt(sum(q * q for q in delta.quaternion[:3]))
        turned = 2.0 * math.atan2(sine, abs(delta.quaternion[3]))
        return math.dist(self._position, other._position) <= position and turned <= angle

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pose):
            return NotImplemented
        return self._position == other._position and self._quaternion == other._quaternion

    def __hash__(self) -> int:
        return hash((self._position, self._quaternion))

    def __repr__(self) -> str:
        values = dict(zip(("x", "y", "z"), self._position, strict=True))
        values |= dict(zip(("roll", "pitch", "yaw"), self.rpy, strict=True))
        shown = ", ".join(f"{name}={value:.6g}" for name, value in values.items() if value != 0.0)
        return f"Pose({shown})"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Pose.from_quaternion, (self._position, self._quaternion))


def _refused(expected: str, error: Exception) -> FormatError:
    return FormatError(f"a pose takes {expected}: {error}")


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the Hamilton product of two quaternions (x, y, z, w): first b, then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q: Quaternion, v: Vector3) -> Vector3:
    """Return the vector v turned by the unit quaternion q (x, y, z, w)."""
    x, y, z, w = q
    tx = 2.0 * (y * v[2] - z * v[1])
    ty = 2.0 * (z * v[0] - x * v[2])
    tz = 2.0 * (x * v[1] - y * v[0])
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Return quaternion (x, y, z, w) of R = Rz(yaw) Ry(pitch) Rx(roll); angles in rad.

    Of an angle that is not finite it is not a number, which users of the pose reject.
    """
    if not (math.isfinite(roll) and math.isfinite(pitch) and math.isfinite(yaw)):
        return (math.nan, math.nan, math.nan, math.nan)
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def rpy_from_quaternion(q: Quaternion) -> Vector3:
    """Return (roll, pitch, yaw) [rad] of a unit quaternion; at pitch ±pi/2 roll is taken as 0."""
    x, y, z, w = q
    sine = max(-1.0, min(1.0, 2.0 * (w * y - z * x)))
    if abs(sine) > 1.0 - 1e-12:
        pitch = math.copysign(math.pi / 2, sine)
        return (0.0, pitch, math.copysign(1.0, -sine) * 2.0 * math.atan2(x, w))
    roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return (roll, math.asin(sine), yaw)


def quaternion_from_matrix(r: NDArray[np.float64]) -> Quaternion:
    """Return quaternion (x, y, z, w) of a rotation matrix, shape (3, 3).

    Shepperd's method: divides by the largest of the four components, so that it is
    well conditioned for every rotation.
    """
    trace = float(r[0, 0] + r[1, 1] + r[2, 2])
    squares = [float(r[i, i]) for i in range(3)] + [trace]
    largest = squares.index(max(squares))
    if largest == 3:
        w = 1.0 + trace
        q = (r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], w)
    else:
        i, j, k = largest, (largest + 1) % 3, (largest + 2) % 3
        values = [0.0, 0.0, 0.0, float(r[k, j] - r[j, k])]
        values[i] = float(1.0 + r[i, i] - r[j, j] - r[k, k])
        values[j] = float(r[j, i] + r[i, j])
        values[k] = float(r[k, i] + r[i, k])
        q = (values[0], values[1], values[2], values[3])
    norm = math.sqrt(sum(float(c) ** 2 for c in q))
    return (float(q[0]) / norm, float(q[1]) / norm, float(q[2]) / norm, float(q[3]) / norm)
