"""Gymnasium-Robotics' Fetch tasks as Gymnasium environments."""

from __future__ import annotations

from typing import Unpack

from gymnasium.vector import AutoresetMode

from gazelle.envs.fetch.options import FetchOptions, FetchSettings
from gazelle.envs.fetch.task import FetchTask
from gazelle.envs.goal_envs import TaskGoalEnv, TaskGoalVectorEnv
from gazelle.envs.limits import MAX_ENVS
from gazelle.envs.options import check_integer, read_options


class FetchEnv(TaskGoalEnv):
    """Fetch's gripper, pointing down at a table, gets itself or an object to a goal.

    The tasks of Gymnasium-Robotics' ``FetchReach-v4``, ``FetchPush-v4``, ``FetchSlide-v4`` and
    ``FetchPickAndPlace-v4`` (M. Plappert et al., "Multi-Goal Reinforcement Learning", 2018, arXiv
    1802.09464). Ids: ``gazelle/FetchReach-v0``, ``gazelle/FetchPush-v0``,
    ``gazelle/FetchSlide-v0``, ``gazelle/FetchPickAndPlace-v0``, and with ``Dense`` before the
    version for the dense reward. One step is 0.04 s.

    ## Observation

    ``Dict`` of ``observation``, ``achieved_goal`` and ``desired_goal``, float32 (there float64),
    without bounds. Goals have shape (3,): a place in the world frame [m]; what is achieved is the
    place of the gripper (Reach) or of the object. ``observation`` has shape (25,), of Reach (10,):
    rows 0 to 2, 9 and 10, 20 to 24.

    ======  =========================================================================  ====
    Index   Meaning                                                                    Unit
    ======  =========================================================================  ====
    0-2     place of the point between the fingers                                     m
    3-5     place of the object                                                        m
    6-8     place of the object, from the gripper                                      m
    9-10    how far the right and the left finger are open                             m
    11-13   angles of the object about x, y, z: R = Rx Ry Rz                           rad
    14-16   way of the object in a step, less the gripper's                            m
    17-19   turn of the object in a step                                               rad
    20-22   way of the gripper in a step                                               m
    23-24   way of the right and the left finger in a step                             m
    ======  =========================================================================  ====

    ## Action

    ``Box(-1, 1, (4,))``: where the gripper is wanted, in steps of 5 cm along x, y and z from where it
    is, and how fast the fingers open (only PickAndPlace; else they are closed). Actions beyond the
    bounds are cut.

    ## How the gripper moves

    There a body that MuJoCo calls mocap is put where the gripper is wanted, and a soft weld pulls the
    arm after it. Here it is wanted 0.66 of the way there in a step, and motors hold the velocity that
    leads there: of the gripper alone (``control="gripper"``), or of the arm's joints, by inverse
    kinematics (``control="joint"``). Ways in the first steps with an action of 1 along x, and then in
    those with 0:

    =====================  =====  =====  =====  =====  =====  =====
    step                   1      2      3      4      5      6
    =====================  =====  =====  =====  =====  =====  =====
    Gymnasium-Robotics     30 mm  33 mm  32 mm  32 mm  2 mm   -1 mm
    ``gripper``            29 mm  33 mm  33 mm  33 mm  4 mm   0 mm
    ``joint``              33 mm  33 mm  33 mm  33 mm  0 mm   0 mm
    ``original``           31 mm  33 mm  32 mm  32 mm  2 mm   -1 mm
    =====================  =====  =====  =====  =====  =====  =====

    ``control="original"`` has such a body and such a weld (0.02 s), an arm without motors with joints that
    have the dampers (50 N m s/rad), armatures (1 kg m²) and spring of there, fingers of 4 kg as there,
    and the physics step of there. Gravity pulls at the arm in both. The links are not those of there,
    and fingers move as below: those of there are servos with an armature of 100 kg, which coast.

    The physics step is 0.01 s, of ``original`` 0.002 s as there. Fingers open and close at up to
    0.5 m/s with 60 N (there position servos of 30,000 N/m against 1,000 N s/m).

    ## Reward

    ``reward_type="sparse"``: -1 where what is achieved is more than 5 cm from the goal, else 0.
    ``"dense"``: minus the distance [m]. ``compute_reward`` takes any number of goals at once.

    ## Start

    ==============  =====================  ======================  ====================
    task            gripper [m]            object, from gripper    goal
    ==============  =====================  ======================  ====================
    Reach           1.342 0.749 0.535      none                    gripper ± 0.15
    Push            1.346 0.749 0.414      ± 0.15 in x and y       ± 0.15, on the table
    Slide           0.993 0.749 0.413      ± 0.1 in x and y        0.4 ahead, ± 0.3
    PickAndPlace    1.342 0.749 0.535      ± 0.15 in x and y       ± 0.15, half of them
                                                                   up to 0.45 above
    ==============  =====================  ======================  ====================

    Objects begin at least 0.1 m from the gripper. The cube has 5 cm and 2 kg, the puck 5 cm across, 4
    cm height and 2 kg, with a friction of 0.1 on its table. All is drawn uniformly.

    ## End

    Never terminated; truncated after 50 steps. ``info["is_success"]`` says whether the goal is
    nearer than 5 cm. Evaluations count the last step, as papers do.

    ## Options

    ``reward_type``, and those that every task takes; see docs/reference/gymnasium.md.

    ## Versions

    - v0: the first, after version 4 there.

    Args:
        task: ``Reach``, ``Push``, ``Slide`` or ``PickAndPlace``; the ids say it.
        options: See above.
    """

    task: FetchTask

    def __init__(self, task: str, **options: Unpack[FetchOptions]) -> None:
        settings = read_options(FetchSettings, options)
        super().__init__(
            FetchTask(task, 1, settings), seed=settings.seed, render_mode=settings.render_mode
        )


class FetchVectorEnv(TaskGoalVectorEnv):
    """`FetchEnv` in many worlds at once.

    Args:
        task: As there.
        num_envs: Number of environments.
        autoreset_mode: See `TaskVectorEnv`.
        options: As there.
    """

    task: FetchTask

    def __init__(
        self,
        task: str,
        num_envs: int = 1,
        autoreset_mode: AutoresetMode | str = AutoresetMode.SAME_STEP,
        **options: Unpack[FetchOptions],
    ) -> None:
        check_integer("num_envs", num_envs, 1, MAX_ENVS)
        settings = read_options(FetchSettings, options)
        super().__init__(
            FetchTask(task, num_envs, settings),
            seed=settings.seed,
            render_mode=settings.render_mode,
            autoreset_mode=autoreset_mode,
        )
