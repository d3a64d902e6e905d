"""Parameters of frobs_rl's tasks for Kobuki, as published."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gazelle.array_types import Floats

Place = tuple[float, float]
CONTROL_PERIOD = 0.2
"""Of all of them [s]; frobs_rl's steps take as long as two calls of services happen to."""
BOX_STEP = 0.02
"""Farthest that a box goes in a step [m]."""
LASER_MAX = 30.0
"""Stands for nothing in range [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class KobukiRules:
    """Parameters of one task."""

    world: str
    """Bundled world."""
    robot: str
    """Robot file in the package ``kobuki_maze_rl``."""
    boxes: tuple[Place, ...] = ()
    """Initial positions of the moving boxes [m]."""
    box_steps: tuple[int, int] = (1000, 1000)
    """Number of steps before they first turn back, and later."""
    speed: float = 0.3
    """Greatest forward speed [m/s] and yaw rate [rad/s]."""
    starts: tuple[Place, Place] = ((0.0, 0.0), (0.0, 0.0))
    """Corners of where it starts [m]; its heading is any."""
    goals: tuple[Place, Place] | None = None
    """Corners of where goals are [m]; None: they are the points of ``ways``."""
    ways: tuple[tuple[Place, ...], ...] = ()
    """Goals one after the other [m]; one way is drawn for each episode."""
    farthest: float
    """Bound of the distance to a goal in the space [m]."""
    sees_place: bool = False
    """True if x, y, yaw and the goal are observed."""
    sees_ranges: bool = True
    """True if the laser is observed."""
    distance_weight: float = 0.5
    """Taken for each metre to the goal, each step."""
    heading_weight: float = 0.0
    """Taken for each radian between the base's axis, either way, and the goal, each step."""
    remaining_weight: float = 0.0
    """Taken for each point of the way that is left, each step."""
    collision_range: float = 0.19
    """A shorter range is a collision [m]."""
    collision_reward: float = -50.0
    """Added in each step with a collision; none is the end."""
    goal_reward: float = 10.0
    """Of a goal reached, in place of what is taken."""
    tolerance: float = 0.5
    """Tolerance of a goal [m]."""

    def paths(self) -> Floats:
        """Return the goals of each path [m], shape (ways, points, 2).

        A single point without any.
        """
        return np.array(self.ways) if self.ways else np.zeros((1, 1, 2))


EMPTY = KobukiRules(
    world="empty",
    robot="kobuki_lidar",
    starts=((-5.3, -7.0), (25.0, 6.3)),
    goals=((-6.0, -8.0), (26.0, 7.0)),
    farthest=37.0,
    sees_ranges=False,
    collision_reward=0.0,
)
DYNAMIC_1 = KobukiRules(
    world="kobuki_boxes",
    robot="kobuki_lidar",
    boxes=((-13, 13), (0, 13), (13, 13), (13, 0), (13, -13), (0, -13), (-13, -13), (-13, 0)),
    goals=((-25.0, -25.0), (25.0, 25.0)),
    farthest=71.0,
)
DYNAMIC_2 = replace(DYNAMIC_1, heading_weight=0.5)
DYNAMIC_3 = replace(DYNAMIC_2, speed=1.0, goals=((-15.0, -15.0), (15.0, 15.0)))
MAZE = KobukiRules(
    world="kobuki_maze",
    robot="kobuki_lidar_maze",
    boxes=((-2.5, -5.0), (-6.5, -5.0)),
    box_steps=(100, 200),
    speed=1.0,
    starts=((-5.0, 7.5), (-5.0, 7.5)),
    ways=tuple(
        ((-8.5, 0.0), (-8.5, -2.0), *rest)
        for rest in (
            ((-1.0, -7.0), (-1.0, -11.5), (3.0, -11.5), (3.0, -6.0), (3.0, 0.0)),
            ((-1.0, -7.0), (-1.0, -11.5), (-6.0, -9.5), (-8.5, -9.5), (-8.5, -11.5)),
            ((-8.7, -3.0), (-8.7, -4.0), (-8.7, -5.0), (-8.7, -6.0), (-8.7, -7.0)),
            ((0.0, -4.0), (0.0, -3.5), (0.0, -3.0), (0.0, -2.5), (0.0, -2.0)),
        )
    ),
    farthest=75.0,
    sees_place=True,
    distance_weight=10.0,
    heading_weight=4.0,
    remaining_weight=1.0,
    collision_range=0.25,
    collision_reward=-200.0,
)
