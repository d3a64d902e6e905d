# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Joints of planar models, and bases that their wheels drive."""

from __future__ import annotations

from typing import Any

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.native.system import System


@cython.cclass
class Joints:
    """All joint axes of all worlds.

    Attributes:
        angles: Positions [m or rad], shape (nworld, axes).
        rates: Velocities [m/s or rad/s], likewise.
        targets: Velocities that motors hold; NaN where there is none, likewise.
        limits: Least and greatest position, shape (2, axes).
        base: Body of each base that wheels drive, shape (bases,).
        first: First of its wheels, shape (bases + 1,).
        column: Axis of each wheel, shape (wheels,).
        matrix: Velocity of the base for a unit speed of the wheel: along x, y and about z, shape (wheels, 3).
    """

    def __init__(self, **tables: Any) -> None:
        for name, table in tables.items():
            setattr(self, name, table)


@cython.cclass
class Rolling(System):
    """Gives joints the velocities that motors hold, and bases those of their wheels.

    Args:
        bodies: Of all worlds.
        joints: Of all worlds.
    """

    def __init__(self, bodies: Bodies, joints: Joints) -> None:
        System.__init__(self)
        self.bodies, self.joints = bodies, joints

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Command what motors want in the worlds first to last."""
        for world in range(first, last):
            drive_joints(self.joints, world)
            drive_bases(self.joints, self.bodies, world)


@cython.cclass
class Turning(System):
    """Turns joints for a step, to their limits at most.

    Args:
        bodies: Of all worlds.
        joints: Of all worlds.
    """

    def __init__(self, bodies: Bodies, joints: Joints) -> None:
        System.__init__(self)
        self.bodies, self.joints = bodies, joints

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Turn joints in the worlds first to last."""
        for world in range(first, last):
            turn(self.joints, world, self.bodies.dt)


def drive_joints(own: Joints, world: int) -> None:
    """Turn joints of a world at the speeds of their motors."""
    for j in range(own.rates.shape[1]):
        speed = own.targets[world, j]
        if speed == speed:  # noqa: PLR0124  # no number: no motor
            own.rates[world, j] = speed


def drive_bases(own: Joints, w: Bodies, world: int) -> None:
    """Command bases of a world as their wheels roll."""
    for i in range(own.base.shape[0]):
        b = world * w.nbody + own.base[i]
        for axis in range(3):
            speed = 0.0
            for j in range(own.first[i], own.first[i + 1]):
                speed += own.matrix[j, axis] * own.targets[world, own.column[j]]
            w.command[b, axis] = speed


def turn(own: Joints, world: int, dt: float) -> None:
    """Turn joints of a world for a step [s]."""
    for j in range(own.rates.shape[1]):
        angle = own.angles[world, j] + own.rates[world, j] * dt
        own.angles[world, j] = min(max(angle, own.limits[0, j]), own.limits[1, j])
