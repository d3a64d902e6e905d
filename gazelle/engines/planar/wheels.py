"""Rolling motion of a base: velocity from the speeds of its wheels, without slipping."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import (
    Capsule,
    Collision,
    Cylinder,
    Ellipsoid,
    Link,
    Mesh,
    Pose,
    Sphere,
)
from gazelle.engines.sections import solid_of

_SIDEWAYS = 0.5  # how much a wheel that would slip sideways counts against one that rolls


@dataclass(frozen=True, slots=True)
class Wheel:
    """A wheel on a base.

    Attributes:
        joint: Scoped name of its joint.
        x: Of its middle, in the base's frame [m].
        y: Of its middle [m].
        along: Direction in which it rolls when it turns forward, unit vector in the plane.
        radius: [m].
    """

    joint: str
    x: float
    y: float
    along: tuple[float, float]
    radius: float


def wheel_of(joint: str, link: Link, pose: Pose, axis: Sequence[float]) -> Wheel | None:
    """Return the wheel that a joint turns; None if it has no radius or no level axis.

    Args:
        joint: Its scoped name.
        link: The wheel.
        pose: Of the link in the base's frame.
        axis: Of the joint in the base's frame.
    """
    radius = max((_radius(collision) for collision in link.collisions), default=0.0)
    flat = math.hypot(axis[0], axis[1])
    if radius <= 0.0 or flat < 0.9:
        return None
    return Wheel(joint, pose.x, pose.y, (axis[1] / flat, -axis[0] / flat), radius)


def rolling(wheels: Sequence[Wheel]) -> Floats:
    """Return the matrix from wheel speeds [rad/s] to the twist (vx, vy, turning), shape (3, wheels).

    Each wheel rolls along and does not slip sideways; where that is impossible, as with four
    wheels that cannot steer, the error is least.
    """
    rows, speeds = [], np.zeros((2 * len(wheels), len(wheels)))
    for number, wheel in enumerate(wheels):
        ax, ay = wheel.along
        rows.append([ax, ay, ay * wheel.x - ax * wheel.y])
        rows.append([-_SIDEWAYS * ay, _SIDEWAYS * ax, _SIDEWAYS * (ax * wheel.x + ay * wheel.y)])
        speeds[2 * number, number] = wheel.radius
    return np.asarray(np.linalg.pinv(np.array(rows)) @ speeds)


def _radius(collision: Collision) -> float:
    """Return the radius of a wheel's shape [m]; 0 for another shape."""
    shape = collision.geometry
    if isinstance(shape, Cylinder | Sphere | Capsule):
        return shape.radius
    if isinstance(shape, Ellipsoid):
        return shape.radii[2]
    if isinstance(shape, Mesh):
        solid = solid_of(shape, collision.pose)
        return 0.0 if solid is None else float(np.ptp(solid[0], axis=0).max()) / 2.0
    return 0.0


def driven(wheels: Mapping[str, Wheel], motors: Mapping[str, int]) -> tuple[Wheel, ...]:
    """Return the wheels with motors, in the order of the motors' numbers."""
    names = sorted((joint for joint in wheels if joint in motors), key=motors.__getitem__)
    return tuple(wheels[joint] for joint in names)
