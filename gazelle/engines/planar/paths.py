# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Bodies that follow way-points, or turn evenly where they are."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import COS, SIN, YAW, X, Y, Z
from cython.cimports.gazelle.engines.planar.grid_cells import relink_one
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import floor, fmod

from gazelle.array_types import Floats

PI = 3.141592653589793


@cython.cclass
class PathFollower(System):
    """One body on its path, in all worlds.

    Args:
        points: Time [s], x, y, z [m] and the change of these a second to the next, of
            way-points, shape (n, 7); none to stay at the start.
        start: x, y, z [m] and heading [rad].
        spin: Turning rate where there are no way-points [rad/s].
        loop: Whether the path begins anew at its end.
        epoch: When it began in each world [s], shape (nworld,).
    """

    def __init__(
        self,
        points: Floats,
        start: Floats,
        *,
        spin: float,
        loop: bool,
        epoch: Floats,
    ) -> None:
        System.__init__(self)
        self.points, self.start = np.ascontiguousarray(points), start
        self.spin, self.loop, self.epoch = spin, loop, epoch

    def carry(self, bodies: Bodies, body: int) -> None:
        """Say which body follows the path."""
        self.bodies, self.body = bodies, body

    def update(self, first: int, last: int, time: int) -> None:
        """Put the body where its path says."""
        for w in range(first, last):
            b = w * self.bodies.nbody + self.body
            elapsed = time / 1e9 - self.epoch[w]
            if self.points.shape[0] == 0:
                yaw = self.start[3] + self.spin * elapsed
                put(self.bodies, b, self.start[0], self.start[1], self.start[2], yaw)
            else:
                x, y, z = self.place(elapsed)
                put(self.bodies, b, x, y, z, self.start[3])

    def place(self, elapsed: float) -> tuple[float, float, float]:
        """Where the path is after a time [s]."""
        last = self.points.shape[0] - 1
        begin, end = self.points[0, 0], self.points[last, 0]
        if self.loop and end > 0.0:
            elapsed = fmod(elapsed, end)
            elapsed = elapsed + end if elapsed < 0.0 else elapsed
        moment = max(min(elapsed, end), begin)
        leg = 0
        while leg + 1 < last and self.points[leg + 1, 0] <= moment:
            leg += 1
        since = moment - self.points[leg, 0]
        return (
            self.points[leg, 1] + since * self.points[leg, 4],
            self.points[leg, 2] + since * self.points[leg, 5],
            self.points[leg, 3] + since * self.points[leg, 6],
        )


def put(w: Bodies, b: int, x: float, y: float, z: float, yaw: float) -> None:
    """Put a body somewhere, whatever is there."""
    w.rows[b, X], w.rows[b, Y], w.rows[b, Z] = x, y, z
    if abs(yaw) > PI:
        yaw -= 2.0 * PI * floor(yaw / (2.0 * PI) + 0.5)
    if yaw != w.rows[b, YAW]:
        w.rows[b, YAW], w.rows[b, COS], w.rows[b, SIN] = yaw, cos(yaw), sin(yaw)
    if w.head.shape[1] > 1:
        relink_one(w, b)
