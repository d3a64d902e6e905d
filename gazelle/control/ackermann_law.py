"""A driven wheel behind and a steered one in front, in native code (``ackermann``)."""

# mypy: disallow-untyped-decorators=False, disallow-subclassing-any=False

from __future__ import annotations

from typing import Any

import cython
from cython.cimports.gazelle.control.base_law import BaseLaw, tangent
from cython.cimports.libc.math import isfinite

from gazelle.array_types import Floats
from gazelle.control.interfaces import JointHandles


@cython.cclass
class AckermannLaw(BaseLaw):
    """Rolls and steers; multipliers count for the odometry alone.

    Args:
        wheel: Driven wheel.
        front: Steered joint.
        turned: Last angle of the wheel [rad], shape (nworld,); used in place.
        sizes: Radius of the wheel for commands and for the odometry, distance of the axles [m], factor
            of the measured angle; shape (4,).
        base: Arguments of ``BaseLaw``.
        open_loop: Likewise.
    """

    position: cython.double[:, ::1]
    speed: cython.double[:, ::1]
    angle: cython.double[:, ::1]
    turned: cython.double[::1]
    sizes: cython.double[::1]
    wheel: cython.Py_ssize_t
    front: cython.Py_ssize_t
    wheel_column: cython.Py_ssize_t
    front_column: cython.Py_ssize_t

    def __init__(
        self, wheel: JointHandles, front: JointHandles, turned: Floats, sizes: Floats, base: Any,
        *, open_loop: bool,
    ) -> None:  # fmt: skip
        BaseLaw.__init__(self, *base, open_loop=open_loop)
        self.position = wheel.states.position
        self.wheel, self.front = wheel.columns[0], front.columns[0]
        self.speed, columns = wheel.commands["velocity"]
        self.wheel_column = columns[0]
        self.angle, columns = front.commands["position"]
        self.front_column = columns[0]
        self.turned, self.sizes = turned, sizes

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def advance(self, world: cython.Py_ssize_t, period: cython.double) -> cython.bint:
        """Update the odometry by the wheel's rotation and the steering angle."""
        turned: cython.double = self.position[world, self.wheel]
        angle: cython.double = self.position[world, self.front]
        if not (isfinite(turned) and isfinite(angle)):
            return False
        forward: cython.double = (turned - self.turned[world]) * self.sizes[1]
        self.turned[world] = turned
        turning: cython.double = tangent(angle * self.sizes[3]) * forward / self.sizes[2]
        self.odometry.advance(world, forward, 0.0, turning, period)
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def drive(self, world: cython.Py_ssize_t, old: cython.bint) -> cython.void:  # noqa: ARG002
        """Command the wheel, and the steering angle given as the turning rate."""
        self.speed[world, self.wheel_column] = self.last[world, 0] / self.sizes[0]
        self.angle[world, self.front_column] = self.last[world, 2]
