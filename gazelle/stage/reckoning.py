# cython: annotation_typing=False, infer_types=True
# mypy: disable-error-code="attr-defined, misc"
"""Dead reckoning of Stage's robots, and memories of a step."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.native.elementary import cos, sin
from cython.cimports.gazelle.native.system import System
from cython.cimports.libc.math import floor

from gazelle.array_types import Bytes, Floats

PI = cython.declare(cython.double, 3.141592653589793)


@cython.cclass
class Reckoning(System):
    """Robots with odometry, a row each.

    Args:
        velocity: In the bodies' own frames: x, y [m/s], yaw [rad/s], shape (nworld * stride, 3).
        share: By which they are wrong, shape (nworld * count, 3).
        pose: Their odometry: x, y [m], heading [rad], shape (nworld * count, 3).
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
        """Update all rows."""
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
    """Poses at the beginning of a step, a row each.

    Args:
        now: x, y [m] and heading [rad] of bodies, a view of what moves, shape (nworld * n, 3).
        nworld: Number of worlds.

    Attributes:
        poses: The copy, of the same shape.
    """

    def __init__(self, now: Floats, nworld: int) -> None:
        System.__init__(self, max(1, len(now) // nworld))
        self.now, self.poses = now, np.array(now)

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Copy some of them."""
        for b in range(first, min(last, self.poses.shape[0])):
            self.poses[b, 0] = self.now[b, 0]
            self.poses[b, 1] = self.now[b, 1]
            self.poses[b, 2] = self.now[b, 2]


@cython.cclass
class StallMemory(System):
    """Stalls since the memory was last cleared, a row each.

    Args:
        now: Of bodies, 1 where the last move was not made, shape (nworld * n,).
        nworld: Number of worlds.

    Attributes:
        stalled: 1 where a move was not made, of the same shape.
    """

    def __init__(self, now: Bytes, nworld: int) -> None:
        System.__init__(self, max(1, len(now) // nworld))
        self.now, self.stalled = now, np.zeros(len(now), np.uint8)

    def update(self, first: int, last: int, time: int) -> None:  # noqa: ARG002  time plays no part
        """Add some of them."""
        for b in range(first, min(last, self.stalled.shape[0])):
            self.stalled[b] |= self.now[b]
