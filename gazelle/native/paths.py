# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="misc, no-any-return"
"""Paths through way-points, and even turns, of which each world has its own time."""

from __future__ import annotations

from dataclasses import dataclass

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import fmod, sqrt

from gazelle.array_types import Floats


@dataclass(frozen=True, slots=True)
class ModelPath:
    """Poses over time: straight lines between way-points, or an even turn where there are none.

    Attributes:
        times: Of the way-points [s], increasing, shape (k,).
        positions: [m], shape (k, 3).
        quaternions: (x, y, z, w), neighbours on the same half, shape (k, 4).
        start: Position [m] without way-points, shape (3,).
        attitude: Quaternion (x, y, z, w) from which it turns, shape (4,).
        spin: Turning rate in that frame [rad/s], shape (3,).
        loop: Whether it begins again at its end.
        epoch: Time at which it began in each world [s], shape (nworld,); may be written later.
    """

    times: Floats
    positions: Floats
    quaternions: Floats
    start: Floats
    attitude: Floats
    spin: Floats
    loop: bool
    epoch: Floats

    @property
    def legs(self) -> Floats:
        """Time, pose, and change of that a second until the next way-point, shape (k, 15)."""
        found = np.zeros((len(self.times), 15))
        found[:, 0], found[:, 1:4], found[:, 4:8] = self.times, self.positions, self.quaternions
        span = np.diff(self.times)[:, None]
        found[:-1, 8:11] = np.diff(self.positions, axis=0) / span
        found[:-1, 11:] = np.diff(self.quaternions, axis=0) / span
        return found


@cython.cclass
class PathSystem(System):
    """Something that moves along a path in all worlds, a row each.

    Args:
        path: Its path.
    """

    def __init__(self, path: ModelPath) -> None:
        System.__init__(self)
        self.legs, self.epoch, self.loop = path.legs, path.epoch, path.loop
        self.start = np.array([*path.start, *path.attitude])
        self.spin = np.array(path.spin, np.float64)

    def leg(self, moment: float) -> int:
        """Return the leg on which a path is at a time within the way-points [s]."""
        leg, last = 0, self.legs.shape[0] - 1
        while leg + 1 < last and self.legs[leg + 1, 0] <= moment:
            leg += 1
        return leg

    def moment(self, elapsed: float) -> float:
        """Return a time within the way-points."""
        begin, end = self.legs[0, 0], self.legs[self.legs.shape[0] - 1, 0]
        if self.loop and end > 0.0:
            elapsed = fmod(elapsed, end)
            elapsed = elapsed + end if elapsed < 0.0 else elapsed
        return max(min(elapsed, end), begin)


@cython.cclass
class PosePath(PathSystem):
    """A pose that moves along a path, written to arrays.

    Args:
        path: Of a frame.
        position: Written [m], shape (nworld, 3).
        quaternion: Written, (w, x, y, z), shape (nworld, 4).
        arm: Of what is written in that frame [m], shape (3,).
        turned: Its quaternion in that frame (x, y, z, w), shape (4,).
        moved: Set to 1 at every update, shape (1,).
    """

    def __init__(
        self,
        path: ModelPath,
        position: Floats,
        quaternion: Floats,
        *,
        arm: Floats,
        turned: Floats,
        moved: Floats,
    ) -> None:
        PathSystem.__init__(self, path)
        self.position, self.quaternion, self.moved = position, quaternion, moved
        self.uses = position, quaternion
        held = np.array([*arm, *turned], np.float64)
        self.arm, self.plain = held, held.tolist() == [0.0] * 6 + [1.0]

    def update(self, first: int, last: int, time: int) -> None:
        """Write poses."""
        self.moved[0] = 1.0
        for world in range(first, last):
            elapsed = time / 1e9 - self.epoch[world]
            if self.legs.shape[0] == 0:
                self.turn(world, elapsed)
            else:
                self.go(world, elapsed)

    def go(self, world: int, elapsed: float) -> None:
        """Write the pose between two way-points."""
        moment = self.moment(elapsed)
        leg = self.leg(moment)
        since = moment - self.legs[leg, 0]
        self.write(
            world,
            self.legs[leg, 1] + since * self.legs[leg, 8],
            self.legs[leg, 2] + since * self.legs[leg, 9],
            self.legs[leg, 3] + since * self.legs[leg, 10],
            self.legs[leg, 4] + since * self.legs[leg, 11],
            self.legs[leg, 5] + since * self.legs[leg, 12],
            self.legs[leg, 6] + since * self.legs[leg, 13],
            self.legs[leg, 7] + since * self.legs[leg, 14],
        )

    def turn(self, world: int, elapsed: float) -> None:
        """Write the pose after a rotation at constant angular velocity."""
        x, y, z = self.spin[0], self.spin[1], self.spin[2]
        rate = sqrt(x * x + y * y + z * z)
        half = rate * elapsed / 2.0
        share = sin(half) / rate if rate > 0.0 else 0.0
        x, y, z, w = share * x, share * y, share * z, cos(half)
        a, b, c, d = self.start[3], self.start[4], self.start[5], self.start[6]
        self.write(
            world,
            self.start[0],
            self.start[1],
            self.start[2],
            w * a + d * x + (y * c - z * b),
            w * b + d * y + (z * a - x * c),
            w * c + d * z + (x * b - y * a),
            w * d - (x * a + y * b + z * c),
        )

    def write(
        self,
        world: int,
        px: float,
        py: float,
        pz: float,
        x: float,
        y: float,
        z: float,
        w: float,
    ) -> None:
        """Write the pose of what a frame carries that has this pose."""
        if self.plain:
            self.place(world, px, py, pz)
            self.face(world, x, y, z, w)
            return
        norm = sqrt(x * x + y * y + z * z + w * w)
        norm = norm if norm > 0.0 else 1.0
        x, y, z, w = x / norm, y / norm, z / norm, w / norm
        a, b, c = self.arm[0], self.arm[1], self.arm[2]
        i, j, k = 2.0 * (y * c - z * b), 2.0 * (z * a - x * c), 2.0 * (x * b - y * a)
        self.place(
            world,
            px + (a + w * i + (y * k - z * j)),
            py + (b + w * j + (z * i - x * k)),
            pz + (c + w * k + (x * j - y * i)),
        )
        a, b, c, d = self.arm[3], self.arm[4], self.arm[5], self.arm[6]
        self.face(
            world,
            w * a + d * x + (y * c - z * b),
            w * b + d * y + (z * a - x * c),
            w * c + d * z + (x * b - y * a),
            w * d - (x * a + y * b + z * c),
        )

    def place(self, world: int, x: float, y: float, z: float) -> None:
        """Write a position."""
        self.position[world, 0], self.position[world, 1], self.position[world, 2] = x, y, z

    def face(self, world: int, x: float, y: float, z: float, w: float) -> None:
        """Write a quaternion, at length one; zero becomes the identity."""
        norm = sqrt(x * x + y * y + z * z + w * w)
        if not norm > 0.0:
            norm, w = 1.0, 1.0
        self.quaternion[world, 0], self.quaternion[world, 1] = w / norm, x / norm
        self.quaternion[world, 2], self.quaternion[world, 3] = y / norm, z / norm
