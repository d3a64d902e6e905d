"""The TurtleBot3 tasks as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar, Unpack

from gymnasium.vector import AutoresetMode

from gazelle.envs.limits import MAX_ENVS
from gazelle.envs.options import (
    NavigationOptions,
    NavigationSettings,
    check_integer,
    held_out_options,
    read_options,
)
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.turtlebot3.task import TurtleBot3Task
from gazelle.envs.vector_env import TaskVectorEnv


class TurtleBot3Env(TaskEnv):
    """A TurtleBot3 burger drives to goals among walls and obstacles, seeing with a lidar.

    The DQN tasks of ROBOTIS' ``turtlebot3_machine_learning`` for ROS 1 (Noetic), stages 1 to 4,
    with its state, actions, rewards, terminations and goals, in simulated time: one step is
    0.2 s, the period of the lidar (5 Hz). Ids: ``gazelle/TurtleBot3Stage1-v0`` to
    ``gazelle/TurtleBot3Stage4-v0``.

    ======  ==========================  =====================================================
    Stage   Arena, inside               Obstacles
    ======  ==========================  =====================================================
    1       square of 3.7 m             none
    2       square of 3.7 m             four pillars, radius 0.15 m, at (±0.6, ±0.6) m
    3       square of 3.7 m             the same four, turning about the origin at 0.13 rad/s
    4       square of 4.7 m with walls  two moving pillars, radius 0.12 m
    ======  ==========================  =====================================================

    ## Observation

    ``Box``, float32, shape (28,), in stage 1 (26,); n is ``lidar_samples``, 24 by default.

    =======  ==========================================  =====  =====  ======
    Index    Meaning                                     Min    Max    Unit
    =======  ==========================================  =====  =====  ======
    0..n-1   range of ray i, at angle i * 2 pi / (n-1),  0      3.5    m
             counter-clockwise from straight ahead
    n        heading: angle to the goal, left positive   -pi    pi     rad
    n+1      distance to the goal                        0      5.24   m
    n+2      shortest range (not in stage 1)             0      3.5    m
    n+3      index of its ray (not in stage 1)           0      n-1    1
    =======  ==========================================  =====  =====  ======

    The longest distance is 6.65 m in stage 4, and not bounded in a world of your own. Heading,
    distance and shortest range are rounded to two decimals; ranges are not, nor to the lidar's
    resolution, which Gazebo does not use either. A range of +inf becomes 3.5, NaN becomes 0. A later revision of the published stage 1 pads its 26 numbers
    with two zeros to 28; this task does not.

    The robot's file describes 360 rays, and ROBOTIS instructs to edit ``<samples>`` to 24. Here that
    is done to the loaded description: ``lidar_samples`` rays are cast, over the same angles.
    For a robot file of your own a warning says so; one with fewer rays is an error.

    ## Action

    ``Discrete(5)``. The last command holds for the whole step.

    =======  ===================  ================
    Action   Forward speed [m/s]  Yaw rate [rad/s]
    =======  ===================  ================
    0        0.15                 1.5 (left)
    1        0.15                 0.75
    2        0.15                 0
    3        0.15                 -0.75
    4        0.15                 -1.5 (right)
    =======  ===================  ================

    ## Reward

    ``round(5 * turn, 2) * 2 ** (distance / start_distance)`` plus the obstacle term, where
    ``turn = 1 - 4 * |0.5 - frac(0.25 + ((0.5 * phi) mod (2 * pi)) / pi)|`` and
    ``phi = heading + pi/4 + action * pi/8``: 1 for the turn that points at the goal, -1 for the
    opposite one. ``start_distance`` is the distance when the goal was set. A collision's reward
    takes the place of this, and a goal's the place of both.

    =====================================  =======  ===========  =======
    .                                      Stage 1  Stages 2, 3  Stage 4
    =====================================  =======  ===========  =======
    collision                              -200     -150         -500
    goal                                   200      200          1000
    obstacle term, shortest range < 0.5 m  0        0            -5
    (as observed: rounded)
    =====================================  =======  ===========  =======

    ## Starting state

    Everything is where the world's file puts it; the robot is at rest at the origin, in stage 4
    at (-0.7, 0), looking along x. Goals of stages 1 to 3: a grid of 0.1 m in x, y in
    [-1.2, 1.2], more than 0.4 m (along x or y) from the pillars' places and the origin, each
    at least 1 m (along x or y) from the one before. Goals of stage 4: thirteen places, never
    the same one twice in a row.

    ## Episode end

    * Terminated: a range below 0.13 m is a collision (a range of 0 is a failed ray and is not).
    * A goal is reached at a rounded distance below 0.2 m. With ``respawn=True``, as published,
      the episode continues: a new goal is set, which the next observation shows. The first goal
      is (0.6, 0), and a goal not reached stays for the next episode. With ``respawn=False`` every
      episode has one fresh goal, and reaching it terminates the episode: success, collision
      and time-out are then the three outcomes, which is what training and evaluation by
      success rate want.
    * Truncated: after 501 steps, as in the published loop, by Gymnasium's ``TimeLimit``
      (``max_episode_steps``).

    ## Info

    ``is_success`` (a goal was reached in this step), ``is_collision``, ``distance`` [m],
    ``heading`` [rad] (as observed), ``goal`` (x, y) [m] (the one to go for next),
    ``position`` (x, y) [m] of the robot, ``goals_reached`` (in this episode), and ``is_timeout`` where the environment counts the
    steps itself: in the vector environment, or when made without ``gymnasium.make``. Where an
    episode begins, ``scenario`` is what sets it apart: start (x, y, heading), goal (x, y), and how
    long ago [s] each obstacle began its way, if that was drawn.

    ## Arguments

    =====================  ===========  =========================================================
    Argument               Default      Meaning
    =====================  ===========  =========================================================
    ``stage``              set by id    1 to 4
    ``engine``             "mujoco"     physics engine
    ``seed``               None         for a first ``reset`` without one; None draws one
    ``max_episode_steps``  501          see above
    ``render_mode``        None         "rgb_array": pictures of 480 by 400, the goal in red
    ``lidar_samples``      24           rays in the observation, 2 or more
    ``world``              the stage's  world file or bundled name
    ``robot``              the burger   robot file or bundled name
    ``goals``              "published"  or a list of (x, y) [m], or "training" or "held-out"
    ``starts``             "published"  or "training" or "held-out", see below
    ``seen_goals``         None         list of (x, y) [m] that "held-out" goals keep away from
    ``respawn``            True         whether the episode continues at a goal
    ``margin``             0.0          ranges are collisions so much sooner [m], up to 0.15
    ``threads``            all          native threads; results do not depend on it
    ``time_step``          0.02         physics step [s]; must divide 0.2
    =====================  ===========  =========================================================

    ``goals`` and ``starts`` other than as published are places in the free space of the world (of
    yours too): those that the robot can get to from the stage's start, 0.3 m (goals) or 0.4 m
    (starts) from all that stands, on a square lattice of 0.1 m or more. "training" takes the
    points of the lattice, "held-out" the middles of its squares, away from the published goals
    and from ``seen_goals``; so nothing held out was ever trained on. A robot then starts with any
    heading, 0.5 m or more from its goal, with nothing within 0.35 m of its lidar, and moving
    obstacles are anywhere on their way. Every episode has a goal of its own then.

    The step of 0.02 s is chosen by measurement: with random actions for 1 s the robot is then
    7 mm (median, at most 13 mm) from where steps of 0.001 s take it, having driven 150 mm; at
    0.01 s it is 4 mm, at half the speed.

    Deliberate differences from the published node: no sleep of 0.5 s of wall time at a new goal,
    and the robot is not stopped there; pose and scan are of the same instant; a wall nearer than
    the lidar's 0.12 m (-inf) counts as 0.12 m, hence as a collision, where the node saw none; an
    episode that ends in a collision at the goal reports the goal (``is_success``).

    ## Version history

    * v0: first version.

    Raises:
        TaskError: An option or the robot does not fit the task.
        FormatError: A file cannot be read.
    """

    continuous: ClassVar[bool] = False
    evaluation_options = staticmethod(held_out_options)

    def __init__(self, stage: int = 1, **options: Unpack[NavigationOptions]) -> None:
        settings = read_options(NavigationSettings, options)
        task = TurtleBot3Task(stage, 1, continuous=self.continuous, settings=settings)
        super().__init__(task, seed=settings.seed, render_mode=settings.render_mode)


class TurtleBot3ContinuousEnv(TurtleBot3Env):
    """The TurtleBot3 tasks with two real numbers as action.

    Ids: ``gazelle/TurtleBot3Stage1Continuous-v0`` to ``gazelle/TurtleBot3Stage4Continuous-v0``.
    All is as in `TurtleBot3Env` but the action and, in the reward, the action's index.

    ## Action

    ``Box(-1, 1, (2,), float32)``; numbers outside are clipped.

    =====  =============  =====  ====  ========  ==========  =====
    Index  Meaning        Min    Max   at -1     at 1        Unit
    =====  =============  =====  ====  ========  ==========  =====
    0      forward speed  -1     1     0         0.22        m/s
    1      yaw rate       -1     1     -1.5      1.5 (left)  rad/s
    =====  =============  =====  ====  ========  ==========  =====

    0.22 m/s is the burger's top speed. It could turn at 2.84 rad/s; 1.5 rad/s is the span of the
    five discrete actions, which is where the published reward is defined.

    ## Reward

    The index of the action in ``phi`` is the real number ``2 - yaw_rate / 0.75``: at the yaw rates
    of the five discrete actions the reward is theirs.

    ## Version history

    * v0: first version.
    """

    continuous: ClassVar[bool] = True


class TurtleBot3VectorEnv(TaskVectorEnv):
    """`TurtleBot3Env` in many worlds at once; that page is the data sheet.

    ``gymnasium.make_vec(id, num_envs=1024, vectorization_mode="vector_entry_point")`` makes it.
    Episodes that end are followed by the next one in the same step; ``info["final_obs"]`` and
    ``info["final_info"]`` hold what was last; `TaskVectorEnv` documents other modes. World 0 is,
    bit for bit, the single environment with the same seed, whatever ``num_envs`` and ``threads``.

    Args:
        num_envs: Number of worlds.
        stage: 1 to 4.
        autoreset_mode: ``SameStep``, ``NextStep`` or ``Disabled``, or Gymnasium's constants.
        options: As there; ``max_episode_steps`` is None unless given, and the ids give 501.

    Raises:
        TaskError: An option or the robot does not fit the task.
        FormatError: A file cannot be read.
    """

    continuous: ClassVar[bool] = False
    evaluation_options = staticmethod(held_out_options)

    def __init__(
        self,
        num_envs: int = 1,
        stage: int = 1,
        *,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
        **options: Unpack[NavigationOptions],
    ) -> None:
        check_integer("num_envs", num_envs, 1, MAX_ENVS)
        settings = read_options(NavigationSettings, options)
        task = TurtleBot3Task(stage, num_envs, continuous=self.continuous, settings=settings)
        super().__init__(
            task,
            seed=settings.seed,
            render_mode=settings.render_mode,
            autoreset_mode=autoreset_mode,
        )


class TurtleBot3ContinuousVectorEnv(TurtleBot3VectorEnv):
    """`TurtleBot3ContinuousEnv` in many worlds at once; that page is the data sheet."""

    continuous: ClassVar[bool] = True
