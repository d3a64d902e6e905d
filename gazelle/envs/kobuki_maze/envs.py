"""frobs_rl's tasks for Kobuki as Gymnasium environments."""

from __future__ import annotations

from functools import partial

from gazelle.envs.kobuki_maze.rules import DYNAMIC_1, DYNAMIC_2, DYNAMIC_3, EMPTY, MAZE
from gazelle.envs.kobuki_maze.task import KobukiTask
from gazelle.envs.settings_env import SettingsEnv, many_worlds


class KobukiMazeEnv(SettingsEnv):
    """A Kobuki drives through a maze, from point to point, past two boxes that move.

    The task ``KobukiMazeEnv-v0`` of frobs_rl's resources with its maze, observation, actions, reward and
    ends, in simulated time. Id: ``gazelle/KobukiMaze-v0``. The data sheets of the other four tasks
    say what they do otherwise.

    ## Observation

    ``Box``, float32, shape (15,); nothing is rounded.

    ======  ====================================================  =======  =====  =====
    Index   Meaning                                               Min      Max    Unit
    ======  ====================================================  =======  =====  =====
    0       distance to the goal                                  0        75     m
    1       direction of the goal, left positive                  -pi      pi     rad
    2..4    x, y, yaw                                             -10.5    5.5    m
                                                                  -13.5    13.5   m
                                                                  -pi      pi     rad
    5, 6    x and y of the goal                                   as 2, 3
    7..14   ranges of a laser: from straight back over the        0        30     m
            right in steps of 45 degrees; 30 for nothing
    ======  ====================================================  =======  =====  =====

    ## Action

    ``Box(-1, 1, (2,), float32)``: forward speed [m/s] and yaw rate [rad/s]; numbers outside are clipped.
    A step takes 0.2 s; frobs_rl's take as long as two calls of services do.

    ## Reward

    ``-10 * distance - 4 * angle - points left``, where ``angle`` is between the base's axis, ahead or
    back, and the goal, and a way has 7 points. 10 in place of that where a point is reached; the 100 that frobs_rl has
    for the last one are never paid, as it counts the point only after the reward. A range below
    0.25 m is a collision and adds -200 in each step; it does not end the episode.

    ## Start

    At (-5, 7.5) with any heading. One of four ways of seven points is drawn. Two boxes of 1 m stand
    at (-2.5, -5) and (-6.5, -5) with any heading and go along it by up to 0.02 m a step: 100
    steps ahead, then 200 back, and so on.

    ## End

    Terminated at the last point of the way, which is a success: within 0.5 m. Truncated after
    1,000 steps (200 s; frobs_rl's training has 15,000 of its steps).

    ## Info

    ``is_success``, ``is_collision`` (in this step), ``collisions`` (steps with one, in this episode),
    ``distance`` [m], ``goal`` and ``position`` (x, y) [m], ``waypoints`` (points of the way that were reached).

    ## Options

    Those that every task takes, see docs/reference/gymnasium.md.

    ## Versions

    - v0: the first.
    """

    task_class = partial(KobukiTask, MAZE)


KobukiMazeVectorEnv = many_worlds(KobukiMazeEnv)


class KobukiEmptyEnv(SettingsEnv):
    """A Kobuki drives to a goal where nothing stands.

    The task ``KobukiEmptyEnv-v0`` of frobs_rl's resources. Id: ``gazelle/KobukiEmpty-v0``. As
    `KobukiMazeEnv` but for:

    - Observation: ``Box``, shape (2,): distance to the goal, up to 37 m, and its direction.
    - Action: speeds up to 0.3 m/s and 0.3 rad/s.
    - Reward: ``-0.5 * distance``; 10 at the goal.
    - Start: uniformly in x from -5.3 to 25, y from -7 to 6.3 m, any heading; the goal in x from -6 to 26, y from
      -8 to 7 m.
    - End: within 0.5 m of the goal; truncated after 1,000 steps.
    """

    task_class = partial(KobukiTask, EMPTY)


KobukiEmptyVectorEnv = many_worlds(KobukiEmptyEnv)


class KobukiDynamic1Env(SettingsEnv):
    """A Kobuki drives to a goal among eight boxes that move.

    The task of ``kobuki_dynamic_v1.py`` of frobs_rl's resources. Id: ``gazelle/KobukiDynamic1-v0``. As
    `KobukiMazeEnv` but for:

    - Observation: ``Box``, shape (38,): distance to the goal, up to 71 m, its direction, and 36 ranges from
      straight back over the right in steps of 9 degrees.
    - Action: speeds up to 0.3 m/s and 0.3 rad/s.
    - Reward: ``-0.5 * distance``; 10 at the goal; -50 more in each step with a range below 0.19 m.
    - Start: at the origin with any heading, the goal uniformly in x and y from -25 to 25 m. Boxes stand around at
      13 m, and turn back every 1,000 steps.
    - End: within 0.5 m of the goal; truncated after 1,000 steps.
    """

    task_class = partial(KobukiTask, DYNAMIC_1)


KobukiDynamic1VectorEnv = many_worlds(KobukiDynamic1Env)


class KobukiDynamic2Env(SettingsEnv):
    """`KobukiDynamic1Env` with ``-0.5 * angle`` in its reward, as `KobukiMazeEnv` defines the angle.

    The task of ``kobuki_dynamic_v2.py`` of frobs_rl's resources. Id: ``gazelle/KobukiDynamic2-v0``.
    """

    task_class = partial(KobukiTask, DYNAMIC_2)


KobukiDynamic2VectorEnv = many_worlds(KobukiDynamic2Env)


class KobukiDynamic3Env(SettingsEnv):
    """`KobukiDynamic2Env` with speeds up to 1 m/s and 1 rad/s, and goals up to 15 m away in x and y.

    The task ``KobukiDynamicEnv-v3`` of frobs_rl's resources, as it is tested there; it trains with goals up
    to 25 m away. Id: ``gazelle/KobukiDynamic3-v0``.
    """

    task_class = partial(KobukiTask, DYNAMIC_3)


KobukiDynamic3VectorEnv = many_worlds(KobukiDynamic3Env)
