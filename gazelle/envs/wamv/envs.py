"""The way between the buoys as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar

from gazelle.envs.options import TaskSettings
from gazelle.envs.settings_env import SettingsEnv, many_worlds
from gazelle.envs.starts import held_out_starts
from gazelle.envs.wamv.task import WamvSettings, WamvTask


class WamvBuoysEnv(SettingsEnv):
    """A catamaran with two propellers goes between two pairs of buoys and stops at the second.

    The task ``WamvNavTwoSetsBuoys-v0`` of openai_ros with its observation, actions, reward and ends, in simulated
    time. Id: ``gazelle/WamvBuoys-v0``. The WAM-V has mass, inertia, resistance and propellers as published with
    VRX (180 kg, hulls of 4.9 m; ``libusv_gazebo_dynamics_plugin.so`` and ``libusv_gazebo_thrust_plugin.so``,
    docs/reference/plugins.md); its shape and the buoys are Gazelle's own. The water is still: the published one has
    three waves, of 13 cm together.

    ## Observation

    ``Box``, float32, shape (9,), all rounded to 0.1.

    =====  =====================================================  =====  =====  =====
    Index  Meaning                                                Min    Max    Unit
    =====  =====================================================  =====  =====  =====
    0, 1   x and y                                                -4     33     m
                                                                  -8     8
    2, 3   roll and pitch                                         -1.6   1.6    rad
    4      yaw                                                    -3.15  3.15   rad
    5, 6   velocity along the world's x and y                     -4     4      m/s
    7      turning rate                                           -3     3      rad/s
    8      distance of the origin from (30, 0, 1)                 0      40     m
    =====  =====================================================  =====  =====  =====

    The published bounds are those of the work space for 0 and 1, and 1 for 5, 6 and 7, which the vessel passes.

    ## Action

    ``Discrete(4)``: 0 turns both propellers ahead, 1 both astern, 2 to the left (left astern, right ahead), 3 to the
    right; all with full power, for a second each, as long as openai_ros sleeps (of wall time there). Ahead is 243 N,
    astern 100 N: straight ahead it reaches 2.3 m/s, on the spot 2 rad/s.

    ## Reward

    100 for a step after which it is nearer to the goal as observed, -100 for others. At an end 1,000 at the goal, -1,000
    elsewhere.

    ## Start

    At the origin, at rest, looking along x. With ``starts="training"`` or ``"held-out"`` up to 23 m ahead and 3 m
    aside of it, turned by up to 0.6 rad.

    ## End

    Terminated within 0.5 m of (30, 0) along x and along y, and outside x -1 to 30 and y -5 to 5, as observed (an upper edge
    belongs to it). So it must be slow there, or be there just when a second is over. Truncated after 100 steps (100 s;
    10,000 in openai_ros). A success (``info["is_success"]``) is the goal.

    ## Options

    Those that every task takes (docs/reference/gymnasium.md) and ``starts``; it needs an engine in space.

    ## Versions

    - v0: the first.
    """

    task_class = WamvTask
    settings_class: ClassVar[type[TaskSettings]] = WamvSettings
    evaluation_options = staticmethod(held_out_starts)


WamvBuoysVectorEnv = many_worlds(WamvBuoysEnv)
