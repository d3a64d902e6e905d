# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc, no-any-return"
"""Bodies that follow way-points, or turn evenly where they are."""

from __future__ import annotations

import cython
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import COS, SIN, YAW, X, Y, Z
from cython.cimports.gazelle.engines.planar.grid_cells import relink_one
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.paths import PathSystem
from cython.cimports.libc.math import floor

from gazelle.native.paths import ModelPath

PI = 3.141592653589793


@cython.cclass
class PathFollower(PathSystem):
    """One body on its path, in all worlds.

    Args:
        path: Of the model, which it keeps upright.
        bodies: Of all models.
        body: Index of the body.
        heading: At the beginning [rad].
    """

    def __init__(self, path: ModelPath, bodies: Bodies, body: int, heading: float) -> None:
        PathSystem.__init__(self, path)
        self.bodies, self.body, self.heading = bodies, body, heading

    def update(self, first: int, last: int, time: int) -> None:
        """Move the body to the pose of its path."""
        for w in range(first, last):
            b = w * self.bodies.nbody + self.body
            elapsed = time / 1e9 - self.epoch[w]
            if self.legs.shape[0] == 0:
                yaw = self.heading + self.spin[2] * elapsed
                put(self.bodies, b, self.start[0], self.start[1], self.start[2], yaw)
            else:
                moment = self.moment(elapsed)
                leg = self.leg(moment)
                since = moment - self.legs[leg, 0]
                put(
                    self.bodies,
                    b,
                    self.legs[leg, 1] + since * self.legs[leg, 8],
                    self.legs[leg, 2] + since * self.legs[leg, 9],
                    self.legs[leg, 3] + since * self.legs[leg, 10],
                    self.heading,
                )


def put(w: Bodies, b: int, x: float, y: float, z: float, yaw: float) -> None:
    """Set the pose of a body, regardless of obstacles."""
    w.rows[b, X], w.rows[b, Y], w.rows[b, Z] = x, y, z
    if abs(yaw) > PI:
        yaw -= 2.0 * PI * floor(yaw / (2.0 * PI) + 0.5)
    if yaw != w.rows[b, YAW]:
        w.rows[b, YAW], w.rows[b, COS], w.rows[b, SIN] = yaw, cos(yaw), sin(yaw)
    if w.head.shape[1] > 1:
        relink_one(w, b)
