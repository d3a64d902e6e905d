# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Joints of planar models, and bases that their wheels drive."""

from __future__ import annotations

from typing import Any

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.native.system import System

if not cython.compiled:
    WIDE = 16  # in a compiled module, what rolling.pxd says


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
        self.steady = True

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Command the target velocities of motors in worlds first to last."""
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
        self.mergeable = True

    def update(self, first: int, last: int, time: int) -> None:
        """Turn joints in the worlds first to last."""
        self.update_steps(first, last, time, 1)

    def update_steps(self, first: int, last: int, time: int, count: int) -> None:  # noqa: ARG002
        """Turn joints in the worlds first to last for ``count`` steps."""
        axes = self.joints.rates.shape[1]
        start, end = first * axes, last * axes
        while start < end:
            turn(self.joints, start, min(WIDE, end - start), count, self.bodies.dt)
            start += WIDE


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


def turn(own: Joints, start: int, number: int, count: int, dt: float) -> None:
    """Turn some joints, counted through all worlds, for ``count`` steps of a given number of seconds."""
    angles = cython.declare(cython.double[WIDE])
    ways = cython.declare(cython.double[WIDE])
    least = cython.declare(cython.double[WIDE])
    most = cython.declare(cython.double[WIDE])
    axes = own.rates.shape[1]
    world, j = start // axes, start % axes
    for i in range(number):
        angles[i], ways[i] = own.angles[world, j], own.rates[world, j] * dt
        least[i], most[i] = own.limits[0, j], own.limits[1, j]
        j += 1
        if j == axes:
            world, j = world + 1, 0
    for i in range(number, WIDE):
        angles[i] = ways[i] = least[i] = most[i] = 0.0
    for _ in range(count):
        for i in range(WIDE):
            angle = angles[i] + ways[i]
            angles[i] = min(max(angle, least[i]), most[i])
    world, j = start // axes, start % axes
    for i in range(number):
        own.angles[world, j] = angles[i]
        j += 1
        if j == axes:
            world, j = world + 1, 0
