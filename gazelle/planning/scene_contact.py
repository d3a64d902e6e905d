"""Contacts in planning scenes."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.description import Vector3
from gazelle.errors import PlanningError


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class SceneContact:
    """Two objects that touch and may not.

    Attributes:
        first: Name of a link or an object.
        second: Likewise.
        depth: Penetration depth [m], padding included.
        point: In the robot's frame [m].
        normal: From the first to the second.
    """

    first: str
    second: str
    depth: float
    point: Vector3
    normal: Vector3

    def __str__(self) -> str:
        return f"'{self.first}' and '{self.second}' collide, {self.depth * 1e3:.1f} mm deep"
