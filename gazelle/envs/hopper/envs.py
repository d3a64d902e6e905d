"""The leg as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar

from gazelle.envs.hopper.task import HopperTask
from gazelle.envs.options import DynamicsSettings, TaskSettings
from gazelle.envs.settings_env import SettingsEnv, many_worlds


class HopperStayUpEnv(SettingsEnv):
    """A leg with three joints and a round foot stays up.

    The task ``HopperStayUp-v0`` of openai_ros with its observation, actions, reward and ends, in simulated time. Id:
    ``gazelle/HopperStayUp-v0``. The leg is Gazelle's own: 0.55 kg as published, its base 1 m high when straight.

    ## Observation

    ``Box``, float32, shape (11,), all rounded to 0.1. The bounds are the published ones, which what is seen can pass.

    ======  ===================================================  =====  =====  =====
    Index   Meaning                                              Min    Max    Unit
    ======  ===================================================  =====  =====  =====
    0       always 0: the published code takes the distance      0      3      m
            of the desired point from itself
    1..3    roll, pitch and yaw of the base                      -1.57  1.57   rad
                                                                 -3.15  3.15
    4       always 0: the published code reads the foot's        0      14.16  N
            force and returns another, empty one
    5..7    joints haa, hfe and kfe                              -1.6   1.6    rad
                                                                 -1.6   0
    8..10   x, y and height of the base                          -3     3      m
                                                                 0      3
    ======  ===================================================  =====  =====  =====

    ## Action

    ``Discrete(6)``: 0 moves haa by 0.05 rad from where it is, 1 by -0.05; 2 and 3 hfe, 4 and 5 kfe. The others hold. A step
    takes 0.05 s; openai_ros looks 20 times a second whether joints are within 0.1 rad of it, which they are at once.

    ## Reward

    100, less the sum of the absolute joint angles, ``|force - 7.08|`` (so always 7.08), the sum of absolute roll, pitch and
    yaw, and the distance of the base from (0, 0, 1); all as observed. The published 1,000 for the end are used nowhere.

    ## Start

    Straight, with roll and pitch of up to 0.03 rad each, uniformly (0 in openai_ros).

    ## End

    Terminated when the height as observed is below 0.5 m or from 3 m, or roll or pitch reach 1.57 rad. Truncated after 1,000 steps
    (50 s; 10,000 in openai_ros), which is a success (``info["is_success"]``).

    **No policy can do that with this leg.** All but the base is in one plane, and the base is a ball on the axis of haa. A lean
    sideways grows as ``cosh(3.19 t)``, whatever the joints do. All that they can make up for is 0.0046 rad
    (``tools/hopper_bound.py``), and 85 % of the starts lean more. Of the published leg only the total mass, the names
    and the limits are known.

    ## Options

    Those that every task takes (docs/reference/gymnasium.md); it needs an engine in space.

    ## Versions

    - v0: the first.
    """

    task_class = HopperTask
    settings_class: ClassVar[type[TaskSettings]] = DynamicsSettings


HopperStayUpVectorEnv = many_worlds(HopperStayUpEnv)
