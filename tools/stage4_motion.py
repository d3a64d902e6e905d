"""Work out the key frames of stage 4's two moving obstacles and print them as SDF.

The task that these come from moves each obstacle by a fixed step every tick of 0.1 s and
goes on to the next leg once it is near the leg's goal on both axes. Legs are straight, so
one key frame a change of leg repeats the path exactly. The last key frame leads back to the
start at the last leg's speed, which makes a loop of it.

Run ``python tools/stage4_motion.py`` and paste the output into
``gazelle/assets/turtlebot3_gazebo/worlds/turtlebot3_stage_4.world``. Figures: ROBOTIS, turtlebot3_simulations.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass

TICK = 0.1
"""Time between two steps [s]."""
NEAR = 0.05
"""How near each coordinate must be to the goal's for the next leg to begin [m]."""
HEIGHT = 0.125
"""Height of the middle of the obstacle that stands on the floor [m]."""


@dataclass(frozen=True)
class Leg:
    """A straight stretch: the step a tick [m], and the point to come near to [m]."""

    dx: float
    dy: float
    x: float
    y: float


OBSTACLE_1 = ((2.0, 2.0), (
    Leg(-0.005, -0.012, 1.5, 0.8), Leg(-0.01, 0.007, 0.5, 1.5),
    Leg(-0.008, -0.002, -0.3, 1.3), Leg(-0.007, -0.005, -1.0, 0.8),
    Leg(-0.01, 0.007, -2.0, 1.5), Leg(-0.002, -0.007, -2.2, 0.8),
    Leg(0.004, -0.011, -1.8, -0.3), Leg(0.003, -0.007, -1.5, -1.0),
    Leg(0.009, 0.007, -0.6, -0.3), Leg(0.011, -0.011, 0.5, -1.4),
    Leg(0.006, -0.006, 1.1, -2.0), Leg(0.009, 0.01, 2.0, -1.0),
    Leg(-0.008, 0.01, 1.2, 0.0), Leg(-0.007, 0.005, 0.5, 0.5),
    Leg(0.017, 0.008, 2.2, 1.3), Leg(-0.002, 0.007, 2.0, 2.0),
))  # fmt: skip
OBSTACLE_2 = ((-2.0, -2.0), (
    Leg(0.007, -0.001, -1.3, -2.1), Leg(0.009, 0.009, -0.4, -1.2),
    Leg(-0.006, 0.006, -1.0, -0.6), Leg(0.008, -0.001, -0.2, -0.7),
    Leg(0.013, -0.013, 1.1, -2.0), Leg(0.009, 0.01, 2.0, -1.0),
    Leg(-0.008, 0.01, 1.2, 0.0), Leg(-0.007, 0.02, 0.5, 2.0),
    Leg(-0.013, -0.001, -2.1, 1.8), Leg(0.008, -0.008, -0.5, 0.2),
    Leg(-0.002, -0.0115, -0.9, -2.1), Leg(-0.011, 0.001, -2.0, -2.0),
))  # fmt: skip


def key_frames(start: tuple[float, float], legs: tuple[Leg, ...]) -> list[tuple[float, ...]]:
    """Return rows of (time [s], x [m], y [m]), the first and the last at the start."""
    x, y = start
    ticks = 0
    rows = [(0.0, x, y)]
    for leg in legs:
        while True:
            x, y, ticks = x + leg.dx, y + leg.dy, ticks + 1
            if abs(x - leg.x) < NEAR and abs(y - leg.y) < NEAR:
                break
            if math.dist((x, y), start) > 10:
                raise ValueError(f"{leg} is missed")
        rows.append((ticks * TICK, x, y))
    last = legs[-1]
    ticks += round(math.dist((x, y), start) / math.hypot(last.dx, last.dy))
    rows.append((ticks * TICK, *start))
    return rows


def as_sdf(rows: list[tuple[float, ...]]) -> str:
    """Return the rows as the children of a motion plugin."""
    lines = ["<loop>true</loop>"]
    for time, x, y in rows:
        pose = f"{x:.4f} {y:.4f} {HEIGHT} 0 0 0"
        lines.append(f"<waypoint><time>{time:.1f}</time><pose>{pose}</pose></waypoint>")
    return "\n".join(f"        {line}" for line in lines) + "\n"


if __name__ == "__main__":
    for title, (start, legs) in (("obstacle_1", OBSTACLE_1), ("obstacle_2", OBSTACLE_2)):
        sys.stdout.write(f"<!-- {title} -->\n{as_sdf(key_frames(start, legs))}")
