"""The moving cube as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar

from gazelle.envs.moving_cube.task import MovingCubeSettings, MovingCubeTask
from gazelle.envs.options import TaskSettings
from gazelle.envs.settings_env import SettingsEnv, many_worlds


class MovingCubeEnv(SettingsEnv):
    """A cube moves along y by speeding up and slowing down the wheel in its face.

    The task ``MovingCubeOneDiskWalk-v0`` of openai_ros with its observation, actions, reward and
    ends, in simulated time. Id: ``gazelle/MovingCubeOneDiskWalk-v0``. Cube and wheel weigh 0.5 kg
    each, the cube is 0.2 m wide, the wheel has a radius of 0.08 m; the cube does not slip (friction
    of 1,000,000, as published). A jump of the wheel's speed by 100 rad/s rolls the cube over its
    edge; one by 50 rad/s only rocks it. So it moves for good by -50, 50 and 0 rad/s for half a second
    each: it is sped up in one jump and slowed down in two.

    ## Observation

    ``Box``, float32, shape (6,). The bounds are the published ones, which what is seen can pass.

    =====  =====================================  ======  ======  =======  =======
    Index  Meaning                                Min     Max     Unit     Rounded
    =====  =====================================  ======  ======  =======  =======
    0      speed of the wheel                     -50     50      rad/s    1
    1      way along y from the start             -10     10      m        0.1
    2      roll of the cube                       -2 pi   2 pi    rad      0.1
    3      pitch                                  -0.3    0.3     rad      0.1
    4      speed along y                          -100    100     m/s      0.1
    5      yaw                                    -100    100     rad      0.1
    =====  =====================================  ======  ======  =======  =======

    ## Action

    ``Discrete(3)``: 0 commands 50 rad/s, 1 for -50 rad/s, 2 for 0. With ``n_actions=5`` also 3
    for 10 rad/s more than the last command and 4 for 10 rad/s less, within 50 rad/s; openai_ros
    decodes these but its parameters leave them out.

    A step takes 0.04 s. openai_ros waits until joint states show the wheel within 0.1 rad/s of
    the command, which its controller needs about 0.01 s for.

    ## Reward

    ``100 * (change of y) + 100 * (speed along y) - 100 * |sin(yaw)|``, each part rounded to a whole
    number, from rounded observations. In the step in which it tilts too far **+10** in place of
    that: the published parameter is -10 and the published code takes it times -1, so that failing
    earns points. ``failure_reward=-10`` is what was probably meant.

    ## Start

    The cube rests at the origin, with a yaw of up to 0.05 rad, uniformly (0 in openai_ros); the
    wheel has 10 rad/s.

    ## End

    Terminated when pitch or yaw, rounded, are beyond 0.3 rad. Truncated after 1,000 steps (40 s; openai_ros
    has 10,000). Gazelle counts an episode as a success (``info["is_success"]``) that lasts to the
    end and is 1 m along y then; ``info["distance"]`` is what is left of that metre.

    ## Options

    Those that every task takes (docs/reference/gymnasium.md), ``n_actions``, ``failure_reward`` and ``shows_hold``:
    with the last a seventh entry counts the steps in which the command stayed the same, 0 to 25. While the
    cube rests, nothing else that is observed changes, so that a policy without a memory cannot wait.

    ## Versions

    - v0: the first.
    """

    task_class = MovingCubeTask
    settings_class: ClassVar[type[TaskSettings]] = MovingCubeSettings


MovingCubeVectorEnv = many_worlds(MovingCubeEnv)
