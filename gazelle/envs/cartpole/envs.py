"""The cart and pole as Gymnasium environments."""

from __future__ import annotations

from typing import Unpack

from gymnasium.vector import AutoresetMode

from gazelle.envs.cartpole.task import CartPoleTask
from gazelle.envs.options import TaskOptions, TaskSettings, check_whole, read_options
from gazelle.envs.single_env import TaskEnv
from gazelle.envs.vector_env import TaskVectorEnv


class CartPoleStayUpEnv(TaskEnv):
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
    1      velocity of the cart                   -50     50      m/s
    2      angle of the pole, upright is 0        -1.4    1.4     rad
    3      angular velocity of the pole           -50     50      rad/s
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

    Terminated when the cart is more than 1.0 m from the middle or the pole leans by more than
    0.7 rad. Truncated after 1,000 steps (40 s), which is a success (``info["is_success"]``).

    ## Options

    Those that every task takes; see docs/gymnasium.md.

    ## Versions

    - v0: the first.
    """

    task: CartPoleTask

    def __init__(self, **options: Unpack[TaskOptions]) -> None:
        settings = read_options(TaskSettings, options)
        super().__init__(
            CartPoleTask(1, settings), seed=settings.seed, render_mode=settings.render_mode
        )


class CartPoleStayUpVectorEnv(TaskVectorEnv):
    """`CartPoleStayUpEnv` in many worlds at once.

    Args:
        num_envs: How many.
        autoreset_mode: See `TaskVectorEnv`.
        options: Those that every task takes.
    """

    task: CartPoleTask

    def __init__(
        self,
        num_envs: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
        **options: Unpack[TaskOptions],
    ) -> None:
        check_whole("num_envs", num_envs, 1)
        settings = read_options(TaskSettings, options)
        super().__init__(
            CartPoleTask(num_envs, settings),
            seed=settings.seed,
            render_mode=settings.render_mode,
            autoreset_mode=autoreset_mode,
        )
