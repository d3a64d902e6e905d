# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc"
"""Where bodies believe they are, from what their wheels say."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.engines.planar.bodies import Bodies
from cython.cimports.gazelle.engines.planar.columns import CAR, DRIVE_KIND, WHEELBASE, YAW, X, Y
from cython.cimports.gazelle.engines.planar.drive_motion import bounded
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import floor

from gazelle.array_types import Floats

PI = cython.declare(cython.double, 3.141592653589793)


@cython.cclass
class Reckoning(System):
    """Those who reckon, a row each.

    Args:
        velocity: In the bodies' own frames: x, y [m/s], yaw [rad/s], shape (nworld * stride, 3).
        share: By which they are wrong, shape (nworld * count, 3).
        pose: Where they believe they are: x, y [m], heading [rad], shape (nworld * count, 3).
        count: Of a world.
        stride: Rows of ``velocity`` of a world, of which the first ``count`` are theirs.
        dt: Of a step [s].
        euler: Turn first and then go straight on, as Stage's odometry does, not along the arc.
    """

    def __init__(
        self,
        velocity: Floats,
        share: Floats,
        pose: Floats,
        *,
        count: int,
        stride: int,
        dt: float,
        euler: bool,
    ) -> None:
        System.__init__(self, count)
        self.velocity, self.share, self.pose = velocity, share, pose
        self.count, self.stride, self.dt, self.euler = count, stride, dt, euler

    def reckon(self) -> None:
        """``update`` of all rows."""
        self.update(0, self.pose.shape[0], 0)

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Add what a step comes to."""
        for i in range(first, last):
            b = i // self.count * self.stride + i % self.count
            x = self.velocity[b, 0] * (self.dt * (1.0 + self.share[i, 0]))
            y = self.velocity[b, 1] * (self.dt * (1.0 + self.share[i, 1]))
            turn = self.velocity[b, 2] * (self.dt * (1.0 + self.share[i, 2]))
            heading, chord = self.pose[i, 2] + turn, 1.0
            if not self.euler:
                half = 0.5 * turn
                heading -= half
                chord = sin(half) / half if half != 0.0 else 1.0
            c, s = chord * cos(heading), chord * sin(heading)
            self.pose[i, 0] += c * x - s * y
            self.pose[i, 1] += s * x + c * y
            yaw = self.pose[i, 2] + turn
            if abs(yaw) > PI:
                yaw -= 2.0 * PI * floor(yaw / (2.0 * PI) + 0.5)
            self.pose[i, 2] = yaw


@cython.cclass
class PoseMemory(System):
    """Remembers where bodies are, a row each: at the beginning of a step, for its end.

    Args:
        bodies: Which.

    Attributes:
        poses: x, y [m] and heading [rad], shape (nworld * nbody, 3).
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self, max(1, bodies.nbody))
        self.bodies, self.poses = bodies, np.zeros((bodies.nworld * bodies.nbody, 3))

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Remember some of them."""
        for b in range(first, min(last, self.poses.shape[0])):
            self.poses[b, 0] = self.bodies.rows[b, X]
            self.poses[b, 1] = self.bodies.rows[b, Y]
            self.poses[b, 2] = self.bodies.rows[b, YAW]


@cython.cclass
class StallMemory(System):
    """Remembers which bodies did not make a move, a row each.

    Args:
        bodies: Which.

    Attributes:
        stalled: Whether one did not since it was last cleared, shape (nworld * nbody,).
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self, max(1, bodies.nbody))
        self.bodies, self.stalled = bodies, np.zeros(bodies.nworld * bodies.nbody, np.uint8)

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Look at some of them."""
        for b in range(first, min(last, self.stalled.shape[0])):
            self.stalled[b] |= self.bodies.stalled[b]


@cython.cclass
class DriveVelocities(System):
    """How drives move their bodies, a row each: of cars not what they are told.

    Args:
        bodies: Which.

    Attributes:
        velocities: In the bodies' own frames: x, y [m/s], yaw [rad/s], shape (nworld * nbody, 3).
    """

    def __init__(self, bodies: Bodies) -> None:
        System.__init__(self, max(1, bodies.nbody))
        self.bodies, self.velocities = bodies, np.zeros((bodies.nworld * bodies.nbody, 3))

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Work out some of them."""
        for b in range(first, min(last, self.velocities.shape[0])):
            note_velocity(self.bodies, b, self.velocities)


def note_velocity(w: Bodies, b: int, velocities: Floats) -> None:
    """Write down how the drive of a body moves it."""
    k = b % w.drives.shape[0]
    vx, turn = w.velocity[b, 0], w.velocity[b, 2]
    if w.drives[k, DRIVE_KIND] == CAR:
        vx, turn = vx * cos(turn), vx * sin(turn) / w.drives[k, WHEELBASE]
        vx, turn = bounded(w, vx, k, 0), bounded(w, turn, k, 2)
    velocities[b, 0], velocities[b, 1], velocities[b, 2] = vx, w.velocity[b, 1], turn
