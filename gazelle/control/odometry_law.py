"""Odometry of a base from the motion of its wheels, in native code (``base_odometry``)."""

# mypy: disallow-untyped-decorators=False

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.libc.math import fabs

from gazelle.array_types import Floats

# Minimum time step to divide by for a velocity [s].
_SHORT = cython.declare(cython.double, 1e-4)

# Below so much turning an arc is a straight line [rad].
_STRAIGHT = cython.declare(cython.double, 1e-6)


@cython.cclass
class OdometryLaw:
    """Goes on with pose and velocity, world by world.

    Args:
        memory: Pose and twist, shape (nworld, 3); the velocities that are averaged, shape
            (nworld, window, 3); how many of them there are, and where the next one goes, shape
            (nworld,). Used in place.
    """

    def __init__(self, memory: Sequence[Any]) -> None:
        self.pose, self.twist, self.recent, self.kept, self.place = memory

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def move(
        self,
        world: cython.Py_ssize_t,
        forward: cython.double,
        sideways: cython.double,
        turned: cython.double,
    ) -> cython.void:
        """Advance by distances in the base's frame [m] and an angle [rad], along an arc."""
        heading: cython.double = self.pose[world, 2]
        # Over an arc the mean direction is shorter than one by the chord's ratio.
        along: cython.double = cos(heading + 0.5 * turned)
        across: cython.double = sin(heading + 0.5 * turned)
        if fabs(turned) >= _STRAIGHT:
            along = (sin(heading + turned) - sin(heading)) / turned
            across = -(cos(heading + turned) - cos(heading)) / turned
        self.pose[world, 0] += forward * along - sideways * across
        self.pose[world, 1] += forward * across + sideways * along
        self.pose[world, 2] = heading + turned

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def advance(
        self,
        world: cython.Py_ssize_t,
        forward: cython.double,
        sideways: cython.double,
        turned: cython.double,
        dt: cython.double,
    ) -> cython.void:
        """Advance in some time [s] and compute velocities: the mean of the last ones."""
        self.move(world, forward, sideways, turned)
        if dt < _SHORT:
            return
        window: cython.Py_ssize_t = self.recent.shape[1]
        place: cython.Py_ssize_t = self.place[world]
        self.recent[world, place, 0] = forward / dt
        self.recent[world, place, 1] = sideways / dt
        self.recent[world, place, 2] = turned / dt
        self.place[world] = 0 if place + 1 == window else place + 1
        self.kept[world] = min(self.kept[world] + 1, window)
        count: cython.Py_ssize_t = self.kept[world]
        k: cython.Py_ssize_t
        axis: cython.Py_ssize_t
        for axis in range(3):
            total: cython.double = 0.0
            for k in range(count):
                place = self.place[world] - count + k  # the oldest first
                total += self.recent[world, place + window if place < 0 else place, axis]
            self.twist[world, axis] = total / count

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def drive(
        self,
        world: cython.Py_ssize_t,
        forward: cython.double,
        sideways: cython.double,
        turning: cython.double,
        dt: cython.double,
    ) -> cython.void:
        """Advance as if a velocity [m/s, rad/s] were driven exactly."""
        self.twist[world, 0] = forward
        self.twist[world, 1] = sideways
        self.twist[world, 2] = turning
        self.move(world, forward * dt, sideways * dt, turning * dt)

    def move_all(self, moved: Floats) -> None:
        """Advance all worlds by rows of forward, sideways and turned, shape (nworld, 3)."""
        by: cython.double[:, ::1] = np.ascontiguousarray(moved, np.float64)
        w: cython.Py_ssize_t
        for w in range(by.shape[0]):
            self.move(w, by[w, 0], by[w, 1], by[w, 2])
