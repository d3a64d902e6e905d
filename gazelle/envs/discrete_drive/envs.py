"""openai_ros' driving tasks as Gymnasium environments."""

from __future__ import annotations

from functools import partial
from typing import ClassVar

from gazelle.envs.discrete_drive.rules import (
    HUSARION,
    MAZE,
    SUMMIT_XL,
    TURTLEBOT3_WORLD,
    WALL,
)
from gazelle.envs.discrete_drive.task import DriveSettings, drive_task
from gazelle.envs.options import TaskSettings
from gazelle.envs.settings_env import SettingsEnv, many_worlds
from gazelle.envs.starts import held_out_starts


class DriveEnv(SettingsEnv):
    """A base with a laser drives by one of a few velocities; the subclasses are tasks."""

    settings_class: ClassVar[type[TaskSettings]] = DriveSettings
    evaluation_options = staticmethod(held_out_starts)


class TurtleBot2MazeEnv(DriveEnv):
    """A TurtleBot 2 drives through a loop of corridors without coming near a wall.

    The task ``MyTurtleBot2Maze-v0`` of openai_ros (``TurtleBot2Maze-v0`` of its first version) with its
    observation, actions, reward and ends, in simulated time. Id: ``gazelle/TurtleBot2Maze-v0``. The base
    is a Kobuki of the published figures; the maze is Gazelle's own, as the published one is on a
    server that is gone: corridors of 2 m in a loop with turns both ways.

    ## Observation

    ``Box(0, 6)``, float32, shape (6,): ranges [m] of rays 0, 120, ..., 600 of a laser with 720 rays from
    90 degrees right to 90 degrees left, so from the right, 30 degrees apart, rounded to 0.1 m. Nothing
    in range is 6, the laser's range. Only these six rays are cast.

    ## Action

    ``Discrete(3)``, for 0.2 s each, as long as openai_ros sleeps (of wall time there):

    =======  ===================  ================
    Action   Forward speed [m/s]  Yaw rate [rad/s]
    =======  ===================  ================
    0        0.5                  0
    1        0.1                  0.3 (left)
    2        0.1                  -0.3 (right)
    =======  ===================  ================

    ## Reward

    5 for driving ahead, 1 for turning, -200 for a crash.

    ## Start

    At the origin, at rest, looking along x. With ``starts="training"`` or ``"held-out"`` anywhere in the
    corridors with any heading, 0.85 m or more from walls, so that it
    can turn round.

    ## End

    Terminated when one of the six ranges is below 0.5 m. Truncated after 500 steps (100 s; openai_ros has
    10,000, its first version 100), which is a success (``info["is_success"]``).

    ## Options

    Those that every task takes (docs/reference/gymnasium.md) and ``starts``.

    ## Versions

    - v0: the first.
    """

    task_class = partial(drive_task, MAZE)


TurtleBot2MazeVectorEnv = many_worlds(TurtleBot2MazeEnv)


class TurtleBot2WallEnv(DriveEnv):
    """A TurtleBot 2 drives round a wall to a place behind it.

    The task ``MyTurtleBot2Wall-v0`` of openai_ros with its observation, actions, reward and ends, in
    simulated time. Id: ``gazelle/TurtleBot2Wall-v0``. The wall is Gazelle's own: 2 m long, across the
    way to the goal, half way.

    ## Observation

    ``Box``, float32, shape (7,).

    =====  ==========================================================  =====  =====  =====
    Index  Meaning                                                     Min    Max    Unit
    =====  ==========================================================  =====  =====  =====
    0..4   ranges of rays 0, 144, 288, 432 and 576 of 720, from 90     0      6      m
           degrees right to 90 left, cut to whole metres
    5, 6   x and y, rounded to 0.01                                    -2     7      m
                                                                       -4     4
    =====  ==========================================================  =====  =====  =====

    The yaw is not seen, so this is no Markov process: two headings look alike. ``course=(1, 4)`` shows more of what was
    seen and done behind it: for each of these numbers of steps the direction of the way since then [rad],
    then for each of them the share of steps with action 0, 1 and 2 (`CourseTask`). The recipe uses it.

    ## Action

    As `TurtleBot2MazeEnv`, with 0.05 m/s where it turns.

    ## Reward

    5 for driving ahead, 1 for turning, 5 more where x and y as seen are nearer to the goal than
    before. The last step: 200 at the goal, -200 elsewhere.

    ## Start

    At the origin, at rest, looking along x; ``starts`` as there, within the work space.

    ## End

    Terminated when one of the five ranges is below 0.5 m, when x leaves (-1, 6] or y leaves
    (-3, 3], and at the goal: x and y as seen within 0.05 m of (5, 0). Steps ahead are 0.1 m
    long, so the goal can be missed by half a step. Truncated after 500 steps (10,000 in openai_ros).

    ## Options

    Those that every task takes (docs/reference/gymnasium.md), ``starts``, ``goal``, another place (x, y) [m], and ``course``.

    ## Versions

    - v0: the first.
    """

    task_class = partial(drive_task, WALL)


TurtleBot2WallVectorEnv = many_worlds(TurtleBot2WallEnv)


class TurtleBot3WorldEnv(DriveEnv):
    """A TurtleBot3 burger drives about the plaza with columns without coming near them.

    The task ``TurtleBot3World-v0`` of openai_ros with its observation, actions, reward and ends, in
    simulated time. Id: ``gazelle/TurtleBot3World-v0``.

    ## Observation

    ``Box(0, 6)``, float32, shape (120,): every third range of 360 counter-clockwise from straight
    ahead, cut to whole metres, so 0 to 3, and 6 where nothing is in range (3.5 m). With the published
    parameter ``new_ranges`` of 120 that is what the published code gives, although it declares a
    space of 3 numbers.

    ## Action

    As `TurtleBot2MazeEnv`, with 0.05 m/s where it turns.

    ## Reward

    5 for driving ahead, 1 for turning, -200 for a crash.

    ## Start

    At (-2, -0.5), at rest, looking along x; ``starts`` as in `TurtleBot2MazeEnv`.

    ## End

    Terminated when one of the ranges is below 0.2 m. The published task also ends at an
    acceleration above 50 m/s2 (5 in some copies), which is meant to notice bumps; here the range comes first.
    Truncated after 500 steps (10,000 in openai_ros), which is a success (``info["is_success"]``).

    ## Options

    Those that every task takes (docs/reference/gymnasium.md) and ``starts``.

    ## Versions

    - v0: the first.
    """

    task_class = partial(drive_task, TURTLEBOT3_WORLD)


TurtleBot3WorldVectorEnv = many_worlds(TurtleBot3WorldEnv)


class HusarionEnv(DriveEnv):
    """A ROSbot drives to a place in a playground.

    The task ``HusarionGetToPosTurtleBotPlayGround-v0`` of openai_ros with its observation, actions, reward
    and ends, in simulated time. Id: ``gazelle/Husarion-v0``. Robot and playground are Gazelle's own: four driven
    wheels of 85 mm under 2.84 kg, which slip when it turns; posts and blocks.

    ## Observation

    ``Box``, float32, shape (45,), all rounded to 0.1.

    ======  =========================================================  =====  =====  =====
    Index   Meaning                                                    Min    Max    Unit
    ======  =========================================================  =====  =====  =====
    0..39   every 18th range of 720 counter-clockwise from straight    0.3    6      m
            back, raised to 0.3; 6 for nothing in range
    40, 41  x and y                                                    -8     4      m
                                                                       -6     4
    42      yaw                                                        -3.15  3.15   rad
    43, 44  x and y of the goal                                        as 40, 41
    ======  =========================================================  =====  =====  =====

    ## Action

    ``Discrete(4)``, for 0.2 s each: 0 commands 0.5 m/s ahead, 1 for 1.5 rad/s left, 2 for 1.5 rad/s right, 3 for
    0.5 m/s ahead once more: that is called "backwards" in the published code, but is not. openai_ros waits until
    odometry shows the speed.

    ## Reward

    10 where x and y as seen are nearer to the goal than before, else 0. The last step: 200 at the goal, -200
    elsewhere.

    ## Start

    At the origin, at rest, looking along x. With ``starts="training"`` or ``"held-out"`` anywhere within the
    work space with any heading, 0.6 m or more from what stands.

    ## End

    Terminated when a range is seen as 0.3 m, when x leaves (-7, 3] or y leaves (-5, 3], and within 0.1 m of the
    goal, in x and in y. **The published goal (-2.94, 3.92) lies beyond the published work space**, so no episode
    can end well; ``goal=(-2.9, 2.5)``, say, can be reached. Truncated after 500 steps (10,000 in openai_ros).

    ## Options

    Those that every task takes (docs/reference/gymnasium.md), ``starts``, and ``goal``, another place (x, y) [m], which
    counts as it is seen, rounded to 0.1.

    ## Versions

    - v0: the first.
    """

    task_class = partial(drive_task, HUSARION)


HusarionVectorEnv = many_worlds(HusarionEnv)


class SummitXLRoomEnv(DriveEnv):
    """A Summit XL drives to a corner of a room with columns.

    The task ``SumitXlRoom-v0`` of openai_ros with its observation, actions, reward and ends, in simulated time. Id:
    ``gazelle/SummitXLRoom-v0``. Robot and room are Gazelle's own, of the published figures: 25 kg on four driven wheels of
    6.5 kg, which slip when it turns.

    ## Observation

    ``Box``, float32, shape (8,).

    ======  =========================================================  =====  =====  =====
    Index   Meaning                                                    Min    Max    Unit
    ======  =========================================================  =====  =====  =====
    0..4    ranges of rays 0, 144, ..., 576 of 720, from 90 degrees    0      6      m
            right to 90 left, cut to whole metres
    5, 6    x and y, rounded to 0.01                                   -5     5      m
    7       yaw, rounded to 0.01                                       -3.15  3.15   rad
    ======  =========================================================  =====  =====  =====

    ## Action

    ``Discrete(3)``, for 0.2 s each: 0.5 m/s ahead, or 0.05 m/s with 0.3 rad/s left or right.

    ## Reward

    10 where x and y as seen are nearer to (-2.94, 3.92) than before, else 1. The last step: 200 at the goal, -200
    elsewhere.

    ## Start

    At the origin, at rest, looking along x; ``starts`` as in `HusarionEnv`, 0.85 m from what stands.

    ## End

    Terminated when one of the five ranges is below 0.5 m, when x or y are beyond 4 m, and within 0.05 m of the
    goal, in x and in y; steps ahead are 0.1 m long. The published task also ends at an acceleration above 20 m/s2, which is
    meant to notice bumps. Truncated after 500 steps (10,000 in openai_ros).

    ## Options

    Those that every task takes (docs/reference/gymnasium.md), ``starts``, and ``goal``, another place (x, y) [m].

    ## Versions

    - v0: the first.
    """

    task_class = partial(drive_task, SUMMIT_XL)


SummitXLRoomVectorEnv = many_worlds(SummitXLRoomEnv)
