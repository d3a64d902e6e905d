"""The flight to a place as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar

from gazelle.envs.options import TaskSettings
from gazelle.envs.parrot_drone.task import ParrotDroneSettings, ParrotDroneTask
from gazelle.envs.settings_env import SettingsEnv, many_worlds
from gazelle.envs.starts import held_out_starts


class ParrotDroneGotoEnv(SettingsEnv):
    """A quadrotor flies over barriers to a place above a platform.

    The task ``ParrotDroneGoto-v0`` of openai_ros with its observation, actions, reward and ends, in simulated
    time. Id: ``gazelle/ParrotDroneGoto-v0``. The drone has mass, inertia, controllers with their noise, and
    the sonar of SJTU's simulated AR.Drone (``libplugin_drone.so``, docs/reference/plugins.md); its shape, the barriers,
    the stairs and the platform are Gazelle's own, and stand where the published world has such things.

    ## Observation

    ``Box``, float32, shape (7,).

    =====  ==================================================  =====  =====  =====
    Index  Meaning                                             Min    Max    Unit
    =====  ==================================================  =====  =====  =====
    0      x, cut to whole metres                              -2     11     m
    1      y, cut likewise                                     -2     6      m
    2      z, cut likewise                                     -2     4      m
    3      roll, rounded to 0.1                                -3.15  3.15   rad
    4      pitch, rounded to 0.1                               -1.6   1.6    rad
    5      yaw, rounded to 0.1                                 -3.15  3.15   rad
    6      sonar, which looks ahead from 0.5 m before and      0      5      m
           0.3 m above the middle, rounded to 0.1
    =====  ==================================================  =====  =====  =====

    The published bounds are a metre narrower, the work space; at an end the drone is beyond it. Those of
    roll and pitch are 1.57, of yaw infinite, of the sonar 0.5 to 5. The velocity is not seen.

    ## Action

    ``Discrete(6)``: 0 commands 0.5 m/s forward, 1 backward, 2 to the left, 3 to the right, 4 up, 5 down, for a
    second each, as long as openai_ros sleeps (of wall time there). The command has noise, drawn
    with each action: up to 0.05 m/s upwards and 0.05 rad/s about z, and up to 0.03 more that stays for six
    seconds or so.

    ## Reward

    10 for a step after which it is nearer to (9, 4, 2) as observed, 0 for others. At an end 200 where x is 9 and y
    is 4 as observed, -200 elsewhere. In the first step the distance before it is not the observed one but the
    true one. The parameter ``not_ending_point_reward`` of 1 is used nowhere.

    ## Start

    It hovers at the origin, 0.85 m high, looking along x: where a take-off ends, which openai_ros waits for.
    With ``starts="training"`` or ``"held-out"`` anywhere in the work space, with room around.

    ## End

    Terminated where x and y as observed are within 1 m of the goal, however high it is; where they or z leave
    the work space (x -1 to 10, y -1 to 5, z -1 to 3; an upper edge belongs to it); where the sonar measures less
    than 0.5 m, or roll or pitch are beyond 1.57 rad. Truncated after 100 steps (100 s; 10,000 in openai_ros).
    A success (``info["is_success"]``) is what earns 200; a collision is the sonar's end, or a flip.

    ## Options

    Those that every task takes (docs/reference/gymnasium.md) and ``starts``; it needs an engine in space. The physics
    step is 4 ms. The published controller makes thrust alternate between too much and none, from step to
    step, by which a drone climbs 2 cm a second; with ``time_step=0.001``, as in Gazebo, half a centimetre.

    ## Versions

    - v0: the first.
    """

    task_class = ParrotDroneTask
    settings_class: ClassVar[type[TaskSettings]] = ParrotDroneSettings
    evaluation_options = staticmethod(held_out_starts)


ParrotDroneGotoVectorEnv = many_worlds(ParrotDroneGotoEnv)
