"""Vectors of three numbers."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, overload

from gazelle_ros.base import rotations

EPSILON = 1e-6
"""Tolerance of equal values."""
DIGITS = 6
_WIDTH = 12


def close(a: Sequence[float], b: Sequence[float]) -> bool:
    """Return whether values are equal within `EPSILON`."""
    return all(abs(x - y) < EPSILON for x, y in zip(a, b, strict=True))


def row(values: Sequence[float]) -> str:
    """Return numbers as KDL prints them."""
    return ",".join(f"{value:{_WIDTH}.{DIGITS}g}" for value in values)


class Vector:
    """A vector: ``Vector()``, ``Vector(x, y, z)`` or ``Vector(other)``."""

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, *values: Any) -> None:
        if len(values) == 1:
            values = tuple(values[0])
        if values and len(values) != 3:
            raise TypeError(f"a vector has 3 numbers, not {len(values)}")
        self._values = [float(value) for value in values] or [0.0, 0.0, 0.0]

    @property
    def tuple(self) -> rotations.Vector:
        """The numbers."""
        x, y, z = self._values
        return (x, y, z)

    def x(self, value: float | None = None) -> float:
        """Return the first number; set with an argument."""
        return self._part(0, value)

    def y(self, value: float | None = None) -> float:
        """Return the second number; set with an argument."""
        return self._part(1, value)

    def z(self, value: float | None = None) -> float:
        """Return the third number; set with an argument."""
        return self._part(2, value)

    def _part(self, place: int, value: float | None) -> float:
        if value is not None:
            self._values[place] = float(value)
        return self._values[place]

    @staticmethod
    def Zero() -> Vector:
        """Return the vector of zeros."""
        return Vector()

    def Norm(self, eps: float = EPSILON) -> float:
        """Return its length."""
        del eps
        return math.hypot(*self._values)

    def Normalize(self, eps: float = EPSILON) -> float:
        """Scale to length 1, and return the former length.

        One shorter than `eps` becomes (1, 0, 0).
        """
        length = self.Norm()
        self._values = [1.0, 0.0, 0.0] if length < eps else [v / length for v in self._values]
        return length

    def ReverseSign(self) -> None:
        """Reverse its sign."""
        self._values = [-value for value in self._values]

    def __len__(self) -> int:
        return 3

    def __iter__(self) -> Iterator[float]:
        return iter(self._values)

    def __getitem__(self, place: int) -> float:
        return self._values[place]

    def __setitem__(self, place: int, value: float) -> None:
        self._values[place] = float(value)

    def __add__(self, other: Vector) -> Vector:
        return Vector(*rotations.add(self.tuple, other.tuple))

    def __sub__(self, other: Vector) -> Vector:
        return self + -other

    def __neg__(self) -> Vector:
        return Vector(*rotations.minus(self.tuple))

    @overload
    def __mul__(self, other: Vector) -> Vector: ...
    @overload
    def __mul__(self, other: float) -> Vector: ...
    def __mul__(self, other: Vector | float) -> Vector:
        """Return the multiple, or the cross product with a vector."""
        if isinstance(other, Vector):
            (a, b, c), (x, y, z) = self._values, other._values
            return Vector(b * z - c * y, c * x - a * z, a * y - b * x)
        return Vector(*(value * other for value in self._values))

    __rmul__ = __mul__

    def __truediv__(self, number: float) -> Vector:
        return Vector(*(value / number for value in self._values))

    def __eq__(self, other: object) -> bool:
        return close(self._values, other._values) if isinstance(other, Vector) else NotImplemented

    def __repr__(self) -> str:
        return f"[{row(self._values)}]"


def dot(a: Vector, b: Vector) -> float:
    """Return the inner product."""
    return sum(x * y for x, y in zip(a, b, strict=True))
