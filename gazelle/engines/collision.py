"""Collision models: which bodies of a tree touch what, without time or forces."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from gazelle.array_types import Floats
from gazelle.description import Geometry, Pose, Vector3
from gazelle.formats import MeshData

Shape = Geometry | MeshData


@dataclass(frozen=True, slots=True)
class CollisionBody:
    """A body with shapes, fixed to or hinged on another one.

    Attributes:
        name: Unique.
        parent: Name of its body; empty for the base of the robot.
        pose: In the parent's frame.
        shapes: With their poses in its own frame.
        axis: Of the joint to the parent, in its own frame; None where it is fixed.
        slides: Whether it moves along the axis, rather than about it.
    """

    name: str
    parent: str = ""
    pose: Pose = field(default_factory=Pose)
    shapes: tuple[tuple[Shape, Pose], ...] = ()
    axis: Vector3 | None = None
    slides: bool = False


@dataclass(frozen=True, slots=True)
class BodyContact:
    """Two bodies that touch.

    Attributes:
        first: A name.
        second: A name.
        depth: Penetration [m], padding included.
        point: Contact point in the world frame [m].
        normal: From the first to the second, in the world frame.
    """

    first: str
    second: str
    depth: float
    point: Vector3
    normal: Vector3


class CollisionModel(Protocol):
    """A robot and the obstacles around it, compiled; see ``collision_model``."""

    def place(self, positions: Floats, base: Sequence[float] | None = None) -> None:
        """Move the robot.

        Args:
            positions: Of the joints in the order of their bodies [m or rad], shape (joints,).
            base: Position and quaternion (x, y, z, w) of the base; unchanged if None.
        """

    def touches(self, positions: Floats) -> bool:
        """Return whether anything touches with the joints at some positions, shape (joints,)."""

    def contacts(self) -> list[BodyContact]:
        """Return the contacts of the last placement: of each pair the deepest."""


def collision_model(
    bodies: Sequence[CollisionBody],
    obstacles: Sequence[CollisionBody],
    ignored: Iterable[tuple[str, str]],
    padding: Mapping[str, float],
) -> CollisionModel:
    """Compile a robot and its obstacles.

    Bodies that are fixed to each other are not checked against each other; nor are obstacles.

    Args:
        bodies: Of the robot, parents first.
        obstacles: Static bodies; their parents and axes do not count.
        ignored: Pairs of names that may touch.
        padding: By name: at which distance from obstacles it counts as touching [m].
    """
    from gazelle.engines.mujoco.collision_model import MujocoCollisionModel

    return MujocoCollisionModel(bodies, obstacles, ignored, padding)
