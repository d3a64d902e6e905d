"""Parameters of openai_ros' driving tasks, as published."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

Place = tuple[float, float]
StepRewards = tuple[tuple[float, float], tuple[float, float]]
CONTROL_PERIOD = 0.2
"""Of all of them [s]: how long openai_ros sleeps after each command to a TurtleBot."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveRules:
    """Parameters of one task."""

    world: str
    """Bundled world."""
    robot: str
    """Bundled robot."""
    robot_args: Mapping[str, str] = field(default_factory=dict)
    """Arguments of its file (xacro)."""
    space_step: float = 0.004
    """Physics step in three dimensions [s]; at longer ones a light base's wheels slip."""
    start: Place = (0.0, 0.0)
    """Place of the published start, looking along x [m]."""
    start_margin: float = 0.85
    """Distance of other starts from all that stands [m]: enough to turn round from there."""
    every: int
    """Stride of the observed rays: 0, n, 2n, ..."""
    decimals: int | None = None
    """Ranges are rounded to a given number of decimals; None: cut to whole metres."""
    far: float = 6.0
    """Observed where nothing is in range, and upper bound of the space [m]."""
    least: float = 0.0
    """Observed where a range is not a number, and lower bound of the space [m]."""
    clamped: bool = False
    """True: ranges are kept within these two."""
    crash_range: float | None = None
    """A shorter range is a crash [m]; None: a range that is observed as the least is one."""
    velocities: tuple[Place, ...]
    """Forward speed [m/s] and yaw rate [rad/s] of each action."""
    rewards: StepRewards
    """Reward of a step with action 0, and with another one; each not nearer to the goal, and nearer."""
    end_reward: float = 200.0
    """Reward of the last step at the goal; minus that elsewhere."""
    goal: Place | None = None
    """Place to reach [m]; None if it should just not crash."""
    tolerance: float = 0.05
    """Largest distance from the goal along x and along y [m]."""
    bounds: tuple[float, float, float, float] | None = None
    """x and y that it must stay within: lowest x, highest x, lowest y, highest y [m]."""
    place_decimals: int = 2
    """Of x, y and yaw."""
    sees_yaw: bool = False
    """True: yaw is observed behind x and y."""
    sees_goal: bool = False
    """True: the goal is observed behind those, and counts as observed."""


def _turns(turning: float, rate: float) -> tuple[Place, ...]:
    return ((0.5, 0.0), (turning, rate), (turning, -rate))


MAZE = DriveRules(
    world="turtlebot2_maze",
    robot="kobuki",
    every=120,
    decimals=1,
    crash_range=0.5,
    velocities=_turns(0.1, 0.3),
    rewards=((5.0, 5.0), (1.0, 1.0)),
)
WALL = DriveRules(
    world="turtlebot2_wall",
    robot="kobuki",
    every=144,
    crash_range=0.5,
    velocities=_turns(0.05, 0.3),
    rewards=((5.0, 10.0), (1.0, 6.0)),
    goal=(5.0, 0.0),
    bounds=(-1.0, 6.0, -3.0, 3.0),
)
TURTLEBOT3_WORLD = DriveRules(
    world="turtlebot3_world",
    robot="turtlebot3_burger",
    space_step=0.02,
    start=(-2.0, -0.5),
    start_margin=0.4,
    every=3,
    crash_range=0.2,
    velocities=_turns(0.05, 0.3),
    rewards=((5.0, 5.0), (1.0, 1.0)),
)
HUSARION = DriveRules(
    world="rosbot_playground",
    robot="rosbot",
    space_step=0.01,
    start_margin=0.6,
    every=18,
    decimals=1,
    least=0.3,
    clamped=True,
    velocities=((0.5, 0.0), (0.0, 1.5), (0.0, -1.5), (0.5, 0.0)),
    rewards=((0.0, 10.0), (0.0, 10.0)),
    goal=(-2.94, 3.92),
    tolerance=0.1,
    bounds=(-7.0, 3.0, -5.0, 3.0),
    place_decimals=1,
    sees_yaw=True,
    sees_goal=True,
)
SUMMIT_XL = DriveRules(
    world="summit_xl_room",
    robot="summit_xl",
    space_step=0.01,
    every=144,
    crash_range=0.5,
    velocities=_turns(0.05, 0.3),
    rewards=((1.0, 10.0), (1.0, 10.0)),
    goal=(-2.94, 3.92),
    bounds=(-4.005, 4.0, -4.005, 4.0),  # -4.00 itself, as seen, is within
    sees_yaw=True,
)
