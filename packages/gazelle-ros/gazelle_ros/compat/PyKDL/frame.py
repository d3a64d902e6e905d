"""Frames: a rotation and a place."""
# ruff: noqa: N802 - the names are KDL's

from __future__ import annotations

import math
from typing import Any

from gazelle_ros.compat.PyKDL.motion import Twist, Wrench
from gazelle_ros.compat.PyKDL.rotation import Rotation
from gazelle_ros.compat.PyKDL.vector import Vector


class Frame:
    """A frame: ``Frame()``, ``Frame(other)``, ``Frame(rotation, place)`` or one of the two.

    Attributes:
        M: Its rotation.
        p: Its place.
    """

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, *values: Any) -> None:
        self.M, self.p = Rotation(), Vector()
        for value in values:
            if isinstance(value, Frame):
                self.M, self.p = Rotation(value.M), Vector(value.p)
            elif isinstance(value, Rotation):
                self.M = Rotation(value)
            elif isinstance(value, Vector):
                self.p = Vector(value)
            else:
                raise TypeError(f"a frame is made of a rotation and a vector, not {value!r}")

    @staticmethod
    def Identity() -> Frame:
        """Return the identity."""
        return Frame()

    @staticmethod
    def DH(a: float, alpha: float, d: float, theta: float) -> Frame:
        """Return the frame of Denavit and Hartenberg's parameters: about and along z, then x."""
        turned = Rotation.RotZ(theta)
        return Frame(turned * Rotation.RotX(alpha), turned * Vector(a, 0, 0) + Vector(0, 0, d))

    @staticmethod
    def DH_Craig1989(a: float, alpha: float, d: float, theta: float) -> Frame:
        """Return the frame of Denavit and Hartenberg's parameters as J.

        Craig has them: x, then z.
        """
        turned = Rotation.RotX(alpha)
        return Frame(turned * Rotation.RotZ(theta), Vector(a, 0, 0) + turned * Vector(0, 0, d))

    def Inverse(self, value: Any = None) -> Any:
        """Return the inverse, or the inverse times a value."""
        turned = self.M.Inverse()
        inverse = Frame(turned, -(turned * self.p))
        return inverse if value is None else inverse * value

    def Integrate(self, t_this: Twist, frequency: float) -> None:
        """Move it with a twist in its own axes for one period of a frequency [Hz]."""
        turn = t_this.rot / frequency
        self.p = self.p + self.M * (t_this.vel / frequency)
        if (angle := turn.Norm()) > 0 and math.isfinite(angle):
            self.M = self.M * Rotation.Rot(turn, angle)

    def __getitem__(self, place: tuple[int, int]) -> float:
        line, column = place
        if line == 3:
            return 1.0 if column == 3 else 0.0
        return self.p[line] if column == 3 else self.M[line, column]

    def __setitem__(self, place: tuple[int, int], value: float) -> None:
        line, column = place
        if column == 3:
            self.p[line] = value
        else:
            self.M[line, column] = value

    def __mul__(self, other: Any) -> Any:
        """Return the product with a frame; a vector, twist or wrench in the parent frame."""
        if isinstance(other, Frame):
            return Frame(self.M * other.M, self.M * other.p + self.p)
        if isinstance(other, Vector):
            return self.M * other + self.p
        if isinstance(other, Twist):
            turned = self.M * other.rot
            return Twist(self.M * other.vel + self.p * turned, turned)
        if isinstance(other, Wrench):
            force = self.M * other.force
            return Wrench(force, self.M * other.torque + self.p * force)
        return NotImplemented

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Frame):
            return NotImplemented
        return self.M == other.M and self.p == other.p

    def __repr__(self) -> str:
        return f"[{self.M}\n{self.p}]"
