"""The fleet as Gymnasium environments."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Unpack

from gymnasium.vector import AutoresetMode

from gazelle.envs.agv_fleet.task import AGVFleetTask, FleetOptions, FleetSettings
from gazelle.envs.limits import MAX_ENVS
from gazelle.envs.options import check_integer, read_options
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv


class AGVFleetVectorEnv(TaskVectorEnv):
    """AGVs in halls with shelves drive to goals of their own and avoid each other.

    Each AGV is one environment of the vector: AGVs 0 to ``agents - 1`` share the first hall, the
    next ones the second, and so on. One policy learns from all of them. The id is
    ``gazelle/AGVFleet-v0``; `gazelle.envs.agv_fleet.parallel_env` is the same under PettingZoo's
    parallel API. The hall measures 30 m by 20 m, with two rows of four shelves; an AGV is 0.8 m
    long and 0.5 m wide. One step is 0.2 s. There is no noise.

    ## Observation

    ``Box``, float32, shape (n + 4,); n is ``lidar_samples``, 24 by default.

    =======  ==============================================  =====  =====  =====
    Index    Meaning                                         Min    Max    Unit
    =======  ==============================================  =====  =====  =====
    0..n-1   range of ray i, at angle i * 2 pi / n,          0      6      m
             counter-clockwise from straight ahead, from
             the AGV's middle; 6 where nothing is met
    n        distance to the goal                            0      36.06  m
    n+1      heading: angle to the goal, left positive       -pi    pi     rad
    n+2      forward speed                                   0      1      m/s
    n+3      yaw rate                                        -1     1      rad/s
    =======  ==============================================  =====  =====  =====

    ## Action

    ``Box(-1, 1, (2,), float32)``; numbers outside are clipped.

    =====  =============  ========  ==========  =====
    Index  Meaning        at -1     at 1        Unit
    =====  =============  ========  ==========  =====
    0      forward speed  0         1           m/s
    1      yaw rate       -1        1 (left)    rad/s
    =====  =============  ========  ==========  =====

    ## Reward

    Metres that the AGV came nearer to its goal, less 0.02; 10 more when the goal is reached. A
    collision gives -10 instead.

    ## Starting state

    AGVs stand at places of a grid of 1.5 m, clear of shelves and walls and 1.2 m from each other,
    with any heading. Goals are other places of that grid.

    ## Episode end

    * Terminated: the AGV bumps into something. It starts again somewhere else in its hall, while
      the others continue; under PettingZoo it stays, in the way of the others, until all reset.
    * A goal is reached within 0.5 m; then there is a new one, and the episode continues.
    * Truncated: after 500 steps (``max_episode_steps``).

    ## Info

    ``is_success`` (a goal was reached in this step), ``is_collision``, ``distance`` [m] (to the
    goal that was gone for), ``goal`` (x, y) [m] (the one to go for next), ``position`` (x, y) [m], ``goals_reached`` (in this episode), and
    ``is_timeout``; where an episode begins ``scenario``: start (x, y, heading) and goal (x, y).

    ## Arguments

    =====================  ========  =======================================================
    Argument               Default   Meaning
    =====================  ========  =======================================================
    ``num_envs``           1         AGVs in all, a multiple of ``agents`` or less than it
    ``agents``             8         AGVs in a hall, 99 or fewer (90 at held-out places)
    ``lidar_samples``      24        rays in the observation, 2 or more
    ``places``             training  where AGVs start and goals are: on a grid of 1.5 m, or
                                     "held-out": in the middles of its squares
    ``seed``               None      for a first ``reset`` without one; None draws one
    ``max_episode_steps``  500       see above
    ``render_mode``        None      "rgb_array": the hall from above, 630 by 430
    ``threads``            all       native threads; results do not depend on it
    ``engine``             "planar"  there is no other
    ``autoreset_mode``     SameStep  see `TaskVectorEnv`
    =====================  ========  =======================================================

    ## Version history

    * v0: first version.

    Raises:
        TaskError: An option is invalid.
    """

    @staticmethod
    def evaluation_options(trained: Mapping[str, Any]) -> dict[str, Any]:
        """Return options for evaluation: places that were not used in training."""
        del trained
        return {"places": "held-out"}

    @staticmethod
    def fitting_num_envs(num_envs: int, options: Mapping[str, Any]) -> int:
        """Return the number of AGVs: as many, or as many more as fill the last hall."""
        agents = read_options(FleetSettings, options).agents
        return -(-num_envs // agents) * agents

    def __init__(
        self,
        num_envs: int = 1,
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
        **options: Unpack[FleetOptions],
    ) -> None:
        check_integer("num_envs", num_envs, 1, MAX_ENVS)
        settings = read_options(FleetSettings, options)
        task = AGVFleetTask(num_envs, settings)
        super().__init__(
            task,
            seed=settings.seed,
            render_mode=settings.render_mode,
            autoreset_mode=autoreset_mode,
        )


class AGVFleetEnv(TaskEnv):
    """One AGV alone in the hall; `AGVFleetVectorEnv` is the data sheet."""

    def __init__(self, **options: Unpack[FleetOptions]) -> None:
        settings = read_options(FleetSettings, options)
        super().__init__(
            AGVFleetTask(1, settings), seed=settings.seed, render_mode=settings.render_mode
        )
