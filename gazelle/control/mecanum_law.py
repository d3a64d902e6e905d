"""Four wheels with slanted rollers, in native code (``mecanum``)."""

# mypy: disallow-untyped-decorators=False, disallow-subclassing-any=False

from __future__ import annotations

from typing import Any

import cython
import numpy as np
from cython.cimports.gazelle.control.base_law import BaseLaw
from cython.cimports.libc.math import isfinite

from gazelle.array_types import Floats
from gazelle.control.interfaces import JointHandles


@cython.cclass
class MecanumLaw(BaseLaw):
    """Mixes forward, sideways and turning motion into four wheels, and back.

    Args:
        wheels: Four.
        turned: Last angles of the wheels [rad], shape (nworld, 4); used in place.
        radius: Of a wheel [m].
        mixing: From a velocity of the base to those of the wheel contacts, shape (4, 3).
        inverse: Back, shape (3, 4).
        base: Arguments of ``BaseLaw``.
        open_loop: Likewise.
    """

    position: cython.double[:, ::1]
    command: cython.double[:, ::1]
    turned: cython.double[:, ::1]
    mixing: cython.double[:, ::1]
    inverse: cython.double[:, ::1]
    joints: cython.Py_ssize_t[::1]
    columns: cython.Py_ssize_t[::1]
    radius: cython.double

    def __init__(
        self, wheels: JointHandles, turned: Floats, radius: float, mixing: Floats, inverse: Floats,
        base: Any, *, open_loop: bool,
    ) -> None:  # fmt: skip
        BaseLaw.__init__(self, *base, open_loop=open_loop)
        self.position, self.joints = wheels.states.position, wheels.columns
        self.command, self.columns = wheels.commands["velocity"]
        self.turned, self.radius = turned, radius
        self.mixing = np.ascontiguousarray(mixing)
        self.inverse = np.ascontiguousarray(inverse)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def advance(self, world: cython.Py_ssize_t, period: cython.double) -> cython.bint:
        """Update the odometry by the wheels' rotation."""
        i: cython.Py_ssize_t
        for i in range(4):
            if not isfinite(self.position[world, self.joints[i]]):
                return False
        forward: cython.double = 0.0
        sideways: cython.double = 0.0
        angle: cython.double = 0.0
        for i in range(4):
            turned: cython.double = self.position[world, self.joints[i]]
            rolled: cython.double = (turned - self.turned[world, i]) * self.radius
            self.turned[world, i] = turned
            forward += self.inverse[0, i] * rolled
            sideways += self.inverse[1, i] * rolled
            angle += self.inverse[2, i] * rolled
        self.odometry.advance(world, forward, sideways, angle, period)
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def drive(self, world: cython.Py_ssize_t, old: cython.bint) -> cython.void:  # noqa: ARG002
        """Command the wheels."""
        i: cython.Py_ssize_t
        for i in range(4):
            rim: cython.double = (
                self.mixing[i, 0] * self.last[world, 0]
                + self.mixing[i, 1] * self.last[world, 1]
                + self.mixing[i, 2] * self.last[world, 2]
            )
            self.command[world, self.columns[i]] = rim / self.radius
