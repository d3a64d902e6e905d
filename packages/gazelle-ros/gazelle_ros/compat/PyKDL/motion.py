"""Twists and wrenches: pairs of vectors that change with the reference point."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

from typing import Any, Self

from gazelle_ros.compat.PyKDL.vector import Vector, row


class _Pair:
    """Six numbers: what does not turn first, then what turns."""

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, *values: Any) -> None:
        if len(values) == 1:
            values = values[0].pair
        first, second = values or (Vector(), Vector())
        self._first, self._second = Vector(first), Vector(second)

    @property
    def pair(self) -> tuple[Vector, Vector]:
        """Pair of both vectors."""
        return self._first, self._second

    @classmethod
    def Zero(cls) -> Self:
        """Return zeros."""
        return cls()

    def ReverseSign(self) -> None:
        """Reverse its sign."""
        self._first.ReverseSign()
        self._second.ReverseSign()

    def __len__(self) -> int:
        return 6

    def __getitem__(self, place: int) -> float:
        values: list[float] = [*self._first, *self._second]
        return values[place]

    def __setitem__(self, place: int, value: float) -> None:
        (self._first if place < 3 else self._second)[place % 3] = value

    def __add__(self, other: Self) -> Self:
        return type(self)(self._first + other._first, self._second + other._second)

    def __sub__(self, other: Self) -> Self:
        return type(self)(self._first - other._first, self._second - other._second)

    def __neg__(self) -> Self:
        return type(self)(-self._first, -self._second)

    def __mul__(self, number: float) -> Self:
        return type(self)(self._first * number, self._second * number)

    __rmul__ = __mul__

    def __truediv__(self, number: float) -> Self:
        return type(self)(self._first / number, self._second / number)

    def __eq__(self, other: object) -> bool:
        return self.pair == other.pair if isinstance(other, type(self)) else NotImplemented

    def __repr__(self) -> str:
        return f"[{row([*self._first, *self._second])}]"


class Twist(_Pair):
    """Linear velocity of the reference point, and angular velocity."""

    @property
    def vel(self) -> Vector:
        """The linear velocity [m/s]."""
        return self._first

    @vel.setter
    def vel(self, value: Vector) -> None:
        self._first = Vector(value)

    @property
    def rot(self) -> Vector:
        """The angular velocity [rad/s]."""
        return self._second

    @rot.setter
    def rot(self, value: Vector) -> None:
        self._second = Vector(value)

    def RefPoint(self, base: Vector) -> Twist:
        """Return the twist with the reference point moved by a vector."""
        return Twist(self.vel + self.rot * base, self.rot)


class Wrench(_Pair):
    """Force, and torque about the reference point."""

    @property
    def force(self) -> Vector:
        """The force [N]."""
        return self._first

    @force.setter
    def force(self, value: Vector) -> None:
        self._first = Vector(value)

    @property
    def torque(self) -> Vector:
        """The torque [N m]."""
        return self._second

    @torque.setter
    def torque(self, value: Vector) -> None:
        self._second = Vector(value)

    def RefPoint(self, base: Vector) -> Wrench:
        """Return the wrench with the reference point moved by a vector."""
        return Wrench(self.force, self.torque + self.force * base)
