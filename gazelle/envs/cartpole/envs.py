"""The cart and pole as Gymnasium environments."""

from __future__ import annotations

from typing import ClassVar

from gazelle.envs.cartpole.task import CartPoleTask
from gazelle.envs.options import DynamicsSettings, TaskSettings
from gazelle.envs.settings_env import SettingsEnv, many_worlds


class CartPoleStayUpEnv(SettingsEnv):
    """A cart on a rail moves to and fro so that the pole on it stays up.

    The task ``CartPoleStayUp-v0`` of openai_ros, with its observation, actions, reward and ends,
    in simulated time: one step is 0.04 s (``running_step``). Id: ``gazelle/CartPoleStayUp-v0``.
    openai_ros does not publish its robot; masses and lengths are those of Barto, Sutton and Anderson
    (1983): a cart of 1 kg, a pole of 0.1 kg and 1 m, without friction.

    ## Observation

    ``Box``, float32, shape (4,).

    =====  =====================================  ======  ======  =====
    Index  Meaning                                Min     Max     Unit
    =====  =====================================  ======  ======  =====
    0      position of the cart on the rail       -5      5       m
    1      velocity of the cart                   -inf    inf     m/s
    2      angle of the pole, upright is 0        -1.4    1.4     rad
    3      angular velocity of the pole           -inf    inf     rad/s
    =====  =====================================  ======  ======  =====

    ## Action

    ``Discrete(2)``: 0 takes 1 m/s (``pos_step``) from the velocity that the cart is commanded, 1 adds
    it. The command stays until the next step and lies within 50 m/s; the motor has 100 N.

    ## Reward

    1 for every step, also for the one in which it falls.

    ## Start

    The cart stands in the middle; the pole leans by up to 0.05 rad, uniformly. In openai_ros it
    stands upright and falls to whichever side the simulator's noise decides.

    ## End

    Terminated when the cart is 1.0 m or more from the middle or the pole leans by 0.7 rad or
    more. Truncated after 1,000 steps (40 s), which is a success (``info["is_success"]``).

    ## Options

    Those that every task takes; see docs/reference/gymnasium.md.

    ## Versions

    - v0: the first.
    """

    task: CartPoleTask
    task_class = CartPoleTask
    settings_class: ClassVar[type[TaskSettings]] = DynamicsSettings


CartPoleStayUpVectorEnv = many_worlds(CartPoleStayUpEnv)
