"""Where bodies believe they are, from what their wheels say."""

# ruff: noqa: FBT001  # kernels take their arguments in order

from __future__ import annotations

import math

from gazelle.engines.native import kernel
from gazelle.engines.planar.tables import Floats


@kernel
def reckon(
    first: int, last: int, count: int, stride: int, velocity: Floats, share: Floats,
    pose: Floats, dt: float, euler: bool,
) -> None:  # fmt: skip
    """Add what a step comes to.

    Args:
        first: Of those who reckon, counted through all worlds.
        last: The one after the last.
        count: Of a world.
        stride: Rows of ``velocity`` of a world, of which the first ``count`` are theirs.
        velocity: In their own frames: x, y [m/s], yaw [rad/s], shape (rows, 3).
        share: By which they are wrong, shape (last, 3).
        pose: Where they believe they are: x, y [m], heading [rad], shape (last, 3).
        dt: [s].
        euler: Turn first and then go straight on, as Stage's odometry does, not along the arc.
    """
    for i in range(first, last):
        b = i // count * stride + i % count
        x = velocity[b, 0] * (dt * (1.0 + share[i, 0]))
        y = velocity[b, 1] * (dt * (1.0 + share[i, 1]))
        turn = velocity[b, 2] * (dt * (1.0 + share[i, 2]))
        heading, chord = pose[i, 2] + turn, 1.0
        if not euler:
            half = 0.5 * turn
            heading -= half
            chord = math.sin(half) / half if half != 0.0 else 1.0
        cos, sin = chord * math.cos(heading), chord * math.sin(heading)
        pose[i, 0] += cos * x - sin * y
        pose[i, 1] += sin * x + cos * y
        yaw = pose[i, 2] + turn
        if abs(yaw) > math.pi:
            yaw -= 2.0 * math.pi * math.floor(yaw / (2.0 * math.pi) + 0.5)
        pose[i, 2] = yaw
