"""Common update of controllers of wheeled bases, in native code."""

# mypy: disallow-untyped-decorators=False, disallow-subclassing-any=False

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cython
import numpy as np
from cython.cimports.gazelle.control.control_law import ControlLaw
from cython.cimports.gazelle.control.odometry_law import OdometryLaw
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.rows import column
from cython.cimports.libc.math import isfinite

from gazelle.array_types import Bools, Floats, Ints64


@dataclass(frozen=True, slots=True)
class BaseMemory:
    """State of a base; used in place.

    Attributes:
        desired: The last command: forward, sideways [m/s] and turning [rad/s], shape (nworld, 3).
        stamps: Time of its arrival [ns], shape (nworld,).
        last: Current velocity command, shape (nworld, 3).
        earlier: The one before, likewise.
        lost: Mask of worlds in which the wheels could not be measured, shape (nworld,).
    """

    desired: Floats
    stamps: Ints64
    last: Floats
    earlier: Floats
    lost: Bools

    @classmethod
    def empty(cls, nworld: int) -> BaseMemory:
        """Return the memory of a base at rest without a command."""
        zero = np.zeros((3, nworld, 3))
        stamps, lost = np.zeros(nworld, np.int64), np.zeros(nworld, bool)
        return cls(zero[0], stamps, zero[1], zero[2], lost)


@cython.cclass
class BaseLaw(ControlLaw):
    """Measures, limits the command, drives; subclasses know the wheels.

    Args:
        memory: Of the base.
        odometry: Likewise.
        bounds: Least and greatest velocity, acceleration and jerk of each axis, shape (3, 6).
        timeout_ns: A command that is older is one to stand still [ns].
        open_loop: Whether the odometry goes by what is driven, not by what is measured.
    """

    def __init__(
        self,
        memory: BaseMemory,
        odometry: OdometryLaw,
        bounds: Floats,
        timeout_ns: int,
        *,
        open_loop: bool,
    ) -> None:
        ControlLaw.__init__(self, len(memory.desired))
        self.odometry, self.desired, self.stamps = odometry, memory.desired, memory.stamps
        self.last, self.earlier = memory.last, memory.earlier
        self.lost = memory.lost.view(np.uint8)
        self.bounds = np.array(bounds, np.float64)
        self.timeout, self.open_loop = timeout_ns, open_loop

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def control(
        self, world: cython.Py_ssize_t, now: cython.longlong, period: cython.double
    ) -> cython.void:
        """Update the odometry, then apply the limited command to the wheels."""
        if self.open_loop:
            self.odometry.drive(
                world, self.last[world, 0], self.last[world, 1], self.last[world, 2], period
            )
        elif not self.advance(world, period):
            self.lost[world] = 1
            return
        self.lost[world] = 0
        old: cython.bint = now - self.stamps[world] > self.timeout
        axis: cython.Py_ssize_t
        for axis in range(3):
            desired: cython.double = 0.0 if old else self.desired[world, axis]
            before: cython.double = self.last[world, axis]
            earlier: cython.double = self.earlier[world, axis]
            self.last[world, axis] = limited(
                desired, before, earlier, period, column(self.bounds[axis])
            )
            self.earlier[world, axis] = before
        self.drive(world, old)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def advance(self, world: cython.Py_ssize_t, period: cython.double) -> cython.bint:  # noqa: ARG002
        """Update the odometry from the wheels; False where they cannot be measured."""
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def drive(self, world: cython.Py_ssize_t, old: cython.bint) -> cython.void:
        """Command the wheels for what is driven now.

        Args:
            world: Index of the world.
            old: Whether the last command is too old.
        """


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def limited(
    desired: cython.double,
    before: cython.double,
    earlier: cython.double,
    dt: cython.double,
    bounds: cython.pointer(cython.double),  # type: ignore[valid-type]
) -> cython.double:
    """Return the limited velocity: jerk first, then acceleration, then velocity.

    Args:
        desired: Now.
        before: The last one.
        earlier: The one before that.
        dt: Since the last one [s].
        bounds: Least and greatest velocity, acceleration, jerk; infinite for none.
    """
    held: cython.double = desired
    if isfinite(bounds[4]) or isfinite(bounds[5]):
        change: cython.double = before - earlier
        held = (
            before + change + clipped(held - before - change, bounds[4], bounds[5], 2.0 * dt * dt)
        )
    if isfinite(bounds[2]) or isfinite(bounds[3]):
        held = before + clipped(held - before, bounds[2], bounds[3], dt)
    return min(max(held, bounds[0]), bounds[1])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def clipped(
    value: cython.double, low: cython.double, high: cython.double, factor: cython.double
) -> cython.double:
    """Return a value within bounds times a factor; infinite bounds stay infinite for factor 0."""
    held: cython.double = value
    if isfinite(low):
        held = max(held, low * factor)
    if isfinite(high):
        held = min(held, high * factor)
    return held


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def tangent(angle: cython.double) -> cython.double:
    """Return the tangent of an angle [rad]."""
    return sin(angle) / cos(angle)


def limit_speeds(speeds: Sequence[Floats], dt: float, bounds: Floats) -> Floats:
    """Return ``limited`` of many values at once, for callers in Python.

    Args:
        speeds: Wanted, before and earlier, shape (n,) each.
        dt: Since the last one [s].
        bounds: As there, shape (6,).
    """
    given: cython.double[:, ::1] = np.ascontiguousarray(speeds, np.float64)
    ends: cython.double[::1] = np.ascontiguousarray(bounds, np.float64)
    held = np.empty(given.shape[1])
    out: cython.double[::1] = held
    since: cython.double = dt
    i: cython.Py_ssize_t
    for i in range(out.shape[0]):
        out[i] = limited(given[0, i], given[1, i], given[2, i], since, column(ends))
    return held
