"""Wheels on a left and a right side, in native code (``diff_drive_controller``)."""

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
class DiffDriveControlLaw(BaseLaw):
    """Turns both sides; the odometry uses the mean of each.

    Args:
        wheels: Those of the left side, then those of the right one.
        turned: Last angle of each side [rad], shape (nworld, 2); used in place.
        sizes: Left and right radius and separation [m], shape (3,); used in place.
        base: Arguments of ``BaseLaw``.
        open_loop: Likewise.
    """

    position: cython.double[:, ::1]
    command: cython.double[:, ::1]
    turned: cython.double[:, ::1]
    sizes: cython.double[::1]
    joints: cython.Py_ssize_t[::1]
    columns: cython.Py_ssize_t[::1]
    count: cython.Py_ssize_t

    def __init__(
        self, wheels: JointHandles, turned: Floats, sizes: Floats, base: Any, *, open_loop: bool
    ) -> None:
        BaseLaw.__init__(self, *base, open_loop=open_loop)
        self.position, self.joints = wheels.states.position, wheels.columns
        self.command, self.columns = wheels.commands["velocity"]
        self.turned, self.sizes, self.count = turned, sizes, len(wheels) // 2

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def side(self, world: cython.Py_ssize_t, which: cython.Py_ssize_t) -> cython.double:
        """Return the mean rotation of a side's wheels [rad]."""
        total: cython.double = 0.0
        i: cython.Py_ssize_t
        for i in range(which * self.count, (which + 1) * self.count):
            total += self.position[world, self.joints[i]]
        return total / self.count

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def advance(self, world: cython.Py_ssize_t, period: cython.double) -> cython.bint:
        """Update the odometry by the rotation of both sides."""
        left: cython.double = self.side(world, 0)
        right: cython.double = self.side(world, 1)
        if not (isfinite(left) and isfinite(right)):
            return False
        left_way: cython.double = (left - self.turned[world, 0]) * self.sizes[0]
        right_way: cython.double = (right - self.turned[world, 1]) * self.sizes[1]
        self.turned[world, 0] = left
        self.turned[world, 1] = right
        self.odometry.advance(
            world, (left_way + right_way) * 0.5, 0.0, (right_way - left_way) / self.sizes[2], period
        )
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def drive(self, world: cython.Py_ssize_t, old: cython.bint) -> cython.void:  # noqa: ARG002
        """Command the wheels of both sides."""
        half: cython.double = self.last[world, 2] * self.sizes[2] * 0.5
        left: cython.double = (self.last[world, 0] - half) / self.sizes[0]
        right: cython.double = (self.last[world, 0] + half) / self.sizes[1]
        i: cython.Py_ssize_t
        for i in range(self.count):
            self.command[world, self.columns[i]] = left
            self.command[world, self.columns[self.count + i]] = right

    def measure(self) -> Floats:
        """Return the current rotation of each side [rad], shape (nworld, 2)."""
        found = np.empty((self.nworld, 2))
        w: cython.Py_ssize_t
        for w in range(self.nworld):
            found[w, 0], found[w, 1] = self.side(w, 0), self.side(w, 1)
        return found
