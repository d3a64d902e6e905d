"""Four driven wheels steered in front and behind, in native code (``four_wheel``)."""

# mypy: disallow-untyped-decorators=False, disallow-subclassing-any=False

from __future__ import annotations

from typing import Any

import cython
from cython.cimports.gazelle.control.base_law import BaseLaw, tangent
from cython.cimports.gazelle.native.elementary import atan2, cos, sin
from cython.cimports.libc.math import INFINITY, copysign, fabs, isfinite, sqrt

from gazelle.array_types import Bools, Floats
from gazelle.control.interfaces import JointHandles

# Below that a base does not drive [m/s], and a wheel is not steered [rad].
_SLOW = cython.declare(cython.double, 0.001)

# Tangents of front and rear that are nearer to each other are alike.
_BENT = cython.declare(cython.double, 0.01)


@cython.cclass
class FourWheelLaw(BaseLaw):
    """Steers all wheels about one point, and rolls each as fast as it is far from it.

    Args:
        wheels: Front left, front right, rear left, rear right.
        steers: The joints that steer them, likewise.
        arrays: Wanted angles in front and behind [rad], shape (nworld, 2); whether a velocity is desired
            instead, shape (nworld,); measured angles, shape (nworld, 2). Used in place.
        sizes: Track between steering joints, wheel base, radius, and how far wheels are outside of
            the steering joints [m], shape (4,).
        base: Arguments of ``BaseLaw``.
        open_loop: Likewise.
    """

    position: cython.double[:, ::1]
    velocity: cython.double[:, ::1]
    speed: cython.double[:, ::1]
    steer: cython.double[:, ::1]
    wheels: cython.Py_ssize_t[::1]
    steers: cython.Py_ssize_t[::1]
    speed_columns: cython.Py_ssize_t[::1]
    steer_columns: cython.Py_ssize_t[::1]
    angles: cython.double[:, ::1]
    by_twist: cython.uchar[::1]
    measured: cython.double[:, ::1]
    track: cython.double
    length: cython.double
    radius: cython.double
    offset: cython.double

    def __init__(
        self, wheels: JointHandles, steers: JointHandles, arrays: tuple[Floats, Bools, Floats],
        sizes: Floats, base: Any, *, open_loop: bool,
    ) -> None:  # fmt: skip
        BaseLaw.__init__(self, *base, open_loop=open_loop)
        self.position, self.velocity = wheels.states.position, wheels.states.velocity
        self.wheels, self.steers = wheels.columns, steers.columns
        self.speed, self.speed_columns = wheels.commands["velocity"]
        self.steer, self.steer_columns = steers.commands["position"]
        self.angles, self.by_twist, self.measured = arrays[0], arrays[1].view("u1"), arrays[2]
        self.track, self.length, self.radius, self.offset = (float(each) for each in sizes)

    # -- driving -------------------------------------------------------------------------

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def drive(self, world: cython.Py_ssize_t, old: cython.bint) -> cython.void:
        """Command steering and wheels."""
        forward: cython.double = self.last[world, 0]
        by_twist: cython.bint = self.by_twist[world] != 0
        front: cython.double = 0.0 if old else tangent(self.angles[world, 0])
        rear: cython.double = 0.0 if old else tangent(self.angles[world, 1])
        bend: cython.double = front - rear
        turning: cython.double = self.last[world, 2] if by_twist else forward * bend / self.length
        moving: cython.bint = fabs(forward) > _SLOW
        # Where angles in front and behind are alike, the speed is that along the wheels.
        bent: cython.bint = by_twist or fabs(bend) > _BENT
        sign: cython.double = copysign(1.0, forward)
        across: cython.double
        axle: cython.Py_ssize_t
        side: cython.Py_ssize_t
        for axle in range(2):
            if by_twist:  # that of the front axle; the rear's is opposite
                across = (0.5 if axle == 0 else -0.5) * self.length * turning
            else:
                across = forward * (front if axle == 0 else rear)
            for side in range(2):
                outward: cython.double = -1.0 if side == 0 else 1.0
                along: cython.double = forward + outward * (0.5 * self.track * turning)
                rolling: cython.double = across if bent else 0.0
                size: cython.double = sign * sqrt(along * along + rolling * rolling)
                size += outward * self.offset * turning
                i: cython.Py_ssize_t = 2 * axle + side
                self.speed[world, self.speed_columns[i]] = size / self.radius if moving else 0.0
                angle: cython.double = 0.0
                if moving:  # at most a quarter of a turn
                    angle = atan2(across * sign, max(along * sign, 0.0))
                elif not by_twist:
                    angle = self.standing_angle(front if axle == 0 else rear, bend, outward)
                self.steer[world, self.steer_columns[i]] = angle

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def standing_angle(
        self, slope: cython.double, bend: cython.double, outward: cython.double
    ) -> cython.double:
        """Return the steering angle of a wheel while the base stands [rad]."""
        away: cython.double = self.length + outward * 0.5 * self.track * bend
        return atan2(self.length * slope / away, 1.0) if fabs(away) > _SLOW else 0.0

    # -- odometry ----------------------------------------------------------------------

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def advance(self, world: cython.Py_ssize_t, period: cython.double) -> cython.bint:
        """Update the odometry by wheel speeds and steering angles."""
        i: cython.Py_ssize_t
        for i in range(4):
            known: cython.bint = isfinite(self.velocity[world, self.wheels[i]])
            if not (known and isfinite(self.position[world, self.steers[i]])):
                return False
        front: cython.double = self.mean_angle(world, 0)
        rear: cython.double = self.mean_angle(world, 1)
        self.measured[world, 0] = front
        self.measured[world, 1] = rear
        lean: cython.double = tangent(front) - tangent(rear)
        front_bend: cython.double = cos(front) * lean / self.length
        rear_bend: cython.double = cos(rear) * lean / self.length
        ahead: cython.double = self.pace(world, 0, front_bend, front)
        behind: cython.double = self.pace(world, 1, rear_bend, rear)
        if period > 0.0:
            self.odometry.drive(
                world,
                0.5 * (ahead * cos(front) + behind * cos(rear)),
                0.5 * (ahead * sin(front) + behind * sin(rear)),
                0.5 * (ahead * front_bend + behind * rear_bend),
                period,
            )
        return True

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def mean_angle(self, world: cython.Py_ssize_t, axle: cython.Py_ssize_t) -> cython.double:
        """Return the angle in the middle of an axle, from two wheels about one point [rad]."""
        left: cython.double = self.position[world, self.steers[2 * axle]]
        right: cython.double = self.position[world, self.steers[2 * axle + 1]]
        if fabs(left) <= _SLOW and fabs(right) <= _SLOW:
            return 0.0
        total: cython.double = tangent(left) + tangent(right)
        if total == 0.0:
            total = INFINITY
        return atan2(2.0 * tangent(left) * tangent(right) / total, 1.0)

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def pace(
        self,
        world: cython.Py_ssize_t,
        axle: cython.Py_ssize_t,
        bend: cython.double,
        angle: cython.double,
    ) -> cython.double:
        """Return the speed of the middle of an axle [m/s], from those of its two wheels."""
        turn: cython.double = self.track * bend
        total: cython.double = 0.0
        squares: cython.double = 0.0
        side: cython.Py_ssize_t
        for side in range(2):
            outward: cython.double = -1.0 if side == 0 else 1.0
            root: cython.double = sqrt(1.0 + outward * turn * cos(angle) + 0.25 * turn * turn)
            rolled: cython.double = self.velocity[world, self.wheels[2 * axle + side]] / (
                1.0 + outward * self.offset * bend / root
            )
            total += rolled
            squares += rolled * rolled
        size: cython.double = sqrt(squares / (2.0 + 0.5 * turn * turn))
        return self.radius * copysign(1.0, total) * size
