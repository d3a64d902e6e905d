"""Rotations as matrices."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

import math
from typing import Any

from gazelle_ros.base import rotations
from gazelle_ros.compat.PyKDL.motion import Twist, Wrench
from gazelle_ros.compat.PyKDL.vector import EPSILON, Vector, close, row

_POLE = 1e-12
"""Distance from a pole at which two angles cannot be distinguished."""


class Rotation:
    """A rotation: ``Rotation()``, ``Rotation(other)``, nine numbers by rows, or three columns."""

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, *values: Any) -> None:
        if not values:
            values = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
        if len(values) == 1:
            self.matrix: rotations.Matrix = values[0].matrix
            return
        if len(values) == 3:
            values = tuple(column[place] for place in range(3) for column in values)
        if len(values) != 9:
            raise TypeError(f"a rotation has 9 numbers or 3 columns, not {len(values)} values")
        a, b, c, d, e, f, g, h, i = map(float, values)
        self.matrix = ((a, b, c), (d, e, f), (g, h, i))

    @staticmethod
    def of(matrix: rotations.Matrix) -> Rotation:
        """Return the rotation of a matrix."""
        made = Rotation()
        made.matrix = matrix
        return made

    @staticmethod
    def Identity() -> Rotation:
        """Return the identity."""
        return Rotation()

    @staticmethod
    def Quaternion(x: float, y: float, z: float, w: float) -> Rotation:
        """Return the rotation of a unit quaternion."""
        return Rotation.of(rotations.matrix((x, y, z, w)))

    @staticmethod
    def RotX(angle: float) -> Rotation:
        """Return a rotation about x [rad]."""
        return Rotation.Rot2(Vector(1, 0, 0), angle)

    @staticmethod
    def RotY(angle: float) -> Rotation:
        """Return a rotation about y [rad]."""
        return Rotation.Rot2(Vector(0, 1, 0), angle)

    @staticmethod
    def RotZ(angle: float) -> Rotation:
        """Return a rotation about z [rad]."""
        return Rotation.Rot2(Vector(0, 0, 1), angle)

    @staticmethod
    def Rot(axis: Vector, angle: float) -> Rotation:
        """Return a rotation about an axis of any length [rad]."""
        unit = Vector(axis)
        unit.Normalize()
        return Rotation.Rot2(unit, angle)

    @staticmethod
    def Rot2(axis: Vector, angle: float) -> Rotation:
        """Return a rotation about an axis of length 1 [rad]."""
        sine = math.sin(angle / 2)
        x, y, z = axis
        return Rotation.Quaternion(x * sine, y * sine, z * sine, math.cos(angle / 2))

    @staticmethod
    def RPY(roll: float, pitch: float, yaw: float) -> Rotation:
        """Return roll about x, then pitch about y, then yaw about z, all axes fixed [rad]."""
        turned: Rotation = Rotation.RotZ(yaw) * Rotation.RotY(pitch) * Rotation.RotX(roll)
        return turned

    @staticmethod
    def EulerZYX(alpha: float, beta: float, gamma: float) -> Rotation:
        """Return a rotation about z, then the new y, then the new x [rad]."""
        return Rotation.RPY(gamma, beta, alpha)

    @staticmethod
    def EulerZYZ(alpha: float, beta: float, gamma: float) -> Rotation:
        """Return a rotation about z, then the new y, then the new z [rad]."""
        turned: Rotation = Rotation.RotZ(alpha) * Rotation.RotY(beta) * Rotation.RotZ(gamma)
        return turned

    def GetQuaternion(self) -> rotations.Quaternion:
        """Return the unit quaternion (x, y, z, w)."""
        return rotations.quaternion(self.matrix)

    def GetRPY(self) -> tuple[float, float, float]:
        """Return roll, pitch and yaw [rad]; where pitch is a right angle, roll is 0."""
        (a, b, _), (d, e, _), (g, h, i) = self.matrix
        pitch = math.atan2(-g, math.hypot(a, d))
        if abs(pitch) > math.pi / 2 - _POLE:
            return 0.0, pitch, math.atan2(-b, e)
        return math.atan2(h, i), pitch, math.atan2(d, a)

    def GetEulerZYX(self) -> tuple[float, float, float]:
        """Return the angles about z, y and x [rad]."""
        roll, pitch, yaw = self.GetRPY()
        return yaw, pitch, roll

    def GetEulerZYZ(self) -> tuple[float, float, float]:
        """Return the angles about z, y and z [rad]."""
        (a, _, c), (d, _, f), (g, h, i) = self.matrix
        if abs(i) > 1 - _POLE:
            return (math.atan2(d, a), 0.0, 0.0) if i > 0 else (math.atan2(-d, -a), math.pi, 0.0)
        return math.atan2(f, c), math.atan2(math.hypot(g, h), i), math.atan2(h, -g)

    def GetRotAngle(self, eps: float = EPSILON) -> tuple[float, Vector]:
        """Return its angle, 0 to pi [rad], and its axis; (0, 0, 1) where there is none."""
        x, y, z, w = self.GetQuaternion()
        sign = -1.0 if w < 0 else 1.0
        length = math.hypot(x, y, z)
        angle = 2 * math.atan2(length, abs(w))
        if angle == 0.0 or angle < eps:
            return 0.0, Vector(0, 0, 1)
        return angle, Vector(x, y, z) / (sign * length)

    def GetRot(self) -> Vector:
        """Return its axis, as long as its angle [rad]."""
        angle, axis = self.GetRotAngle(0.0)
        return axis * angle

    def DoRotX(self, angle: float) -> None:
        """Rotate it about its own x [rad]."""
        self.matrix = (self * Rotation.RotX(angle)).matrix

    def DoRotY(self, angle: float) -> None:
        """Rotate it about its own y [rad]."""
        self.matrix = (self * Rotation.RotY(angle)).matrix

    def DoRotZ(self, angle: float) -> None:
        """Rotate it about its own z [rad]."""
        self.matrix = (self * Rotation.RotZ(angle)).matrix

    def UnitX(self, value: Vector | None = None) -> Vector:
        """Return the first column; set with an argument."""
        return self._column(0, value)

    def UnitY(self, value: Vector | None = None) -> Vector:
        """Return the second column; set with an argument."""
        return self._column(1, value)

    def UnitZ(self, value: Vector | None = None) -> Vector:
        """Return the third column; set with an argument."""
        return self._column(2, value)

    def _column(self, place: int, value: Vector | None) -> Vector:
        if value is not None:
            for each in range(3):
                self[each, place] = value[each]
        return Vector(*(line[place] for line in self.matrix))

    def Inverse(self, value: Any = None) -> Any:
        """Return the inverse, or the inverse times a value."""
        inverse = Rotation(*(self.matrix[0] + self.matrix[1] + self.matrix[2]))
        inverse.SetInverse()
        return inverse if value is None else inverse * value

    def SetInverse(self) -> None:
        """Invert it."""
        one, two, three = zip(*self.matrix, strict=True)
        self.matrix = (one, two, three)

    def __getitem__(self, place: tuple[int, int]) -> float:
        return self.matrix[place[0]][place[1]]

    def __setitem__(self, place: tuple[int, int], value: float) -> None:
        lines = [list(line) for line in self.matrix]
        lines[place[0]][place[1]] = float(value)
        one, two, three = ((line[0], line[1], line[2]) for line in lines)
        self.matrix = (one, two, three)

    def __mul__(self, other: Any) -> Any:
        """Return the product with a rotation; a vector, twist or wrench rotated."""
        if isinstance(other, Rotation):
            return Rotation.of(rotations.product(self.matrix, other.matrix))
        if isinstance(other, Vector):
            return Vector(*rotations.apply(self.matrix, other.tuple))
        if isinstance(other, Twist | Wrench):
            return type(other)(*(self * each for each in other.pair))
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Rotation):
            return NotImplemented
        return all(close(a, b) for a, b in zip(self.matrix, other.matrix, strict=True))

    def __repr__(self) -> str:
        return "[" + ";\n ".join(row(line) for line in self.matrix) + "]"
