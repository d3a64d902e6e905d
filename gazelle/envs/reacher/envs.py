"""frobs_rl's reaching tasks as Gymnasium environments."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any, ClassVar

from gazelle.envs.options import TaskSettings
from gazelle.envs.reacher.rules import IRB120, IRB140, IRB140_SPEED, UR5
from gazelle.envs.reacher.task import ReachSettings, ReachTask
from gazelle.envs.settings_env import SettingsEnv, many_worlds


def _held_out(trained: Mapping[str, Any]) -> dict[str, Any]:
    """Return options for evaluation: goals that were not used in training."""
    del trained
    return {"goals": "held-out"}


class ReachEnv(SettingsEnv):
    """An arm reaches for a place; the subclasses are tasks."""

    settings_class: ClassVar[type[TaskSettings]] = ReachSettings
    evaluation_options = staticmethod(_held_out)


class UR5ReachEnv(ReachEnv):
    """A UR5 turns its joints until its tool is at a place.

    The task ``UR5ReacherEnv-v0`` of frobs_rl's resources with its observation, actions, reward and ends, in simulated time.
    Id: ``gazelle/UR5Reach-v0``. The arm is Gazelle's own, of rods with the published lengths, limits, speeds and masses; as for
    MoveIt, which moves it there, there is no floor, and links pass through each other.

    ## Observation

    ``Box``, float32, shape (12,).

    =====  =====================================================  ==========  =========  =====
    Index  Meaning                                                Min         Max        Unit
    =====  =====================================================  ==========  =========  =====
    0..2   direction from the tool to the goal, of length 1       -1          1          1
    3..5   the goal, x, y, z                                      0           0.7        m
                                                                  -0.5        0.5
                                                                  0.2         1
    6..11  joint angles, from the base on                         -2 pi       2 pi       rad
                                                                  (third: half of that)
    =====  =====================================================  ==========  =========  =====

    ## Action

    ``Box``, the limits of the joints, (6,), float32: by how much each joint shall turn [rad], cut to its limits. A step
    takes 0.5 s, in which a joint gets as far as its speed of some 3 rad/s allows; frobs_rl waits for the
    whole motion.

    ## Reward

    ``-distance - 0.01``, or 10 at the goal; 5 less where a joint is at a limit.

    ## Start

    Joints anywhere within their limits, uniformly. The goal is where the tool is in such a posture, out of several thousand
    drawn once that lie within the goal's box (frobs_rl checks with MoveIt whether a place in the box can be reached).

    ## End

    Terminated within 0.05 m of the goal. Truncated after 50 steps (10,000 in frobs_rl).

    ## Info

    ``is_success`` and ``distance`` [m] to the goal.

    ## Options

    Those that every task takes (docs/reference/gymnasium.md); it needs an engine in space. ``goals="held-out"`` draws goals from
    other places, which evaluations do; ``"training"`` ones are the published ones. ``control_period`` is the time of
    a step [s]: speeds are held for as long.

    ## Versions

    - v0: the first.
    """

    task_class = partial(ReachTask, UR5)


UR5ReachVectorEnv = many_worlds(UR5ReachEnv)


class ABBIRB120ReachEnv(ReachEnv):
    """An ABB IRB 120 turns its joints until its tool is at a place.

    The task ``ABBIRB120ReacherEnv-v0`` of frobs_rl's resources. Id: ``gazelle/ABBIRB120Reach-v0``. As `UR5ReachEnv`
    with the limits of this arm, and goals in x and y from -0.5 to 0.5 m, z from 0 to 1 m.
    """

    task_class = partial(ReachTask, IRB120)


ABBIRB120ReachVectorEnv = many_worlds(ABBIRB120ReachEnv)


class ABBIRB140ReachEnv(ReachEnv):
    """An ABB IRB 140 turns its joints until its tool is at a place.

    The task ``ABBIRB140ReacherPosEnv-v0`` of frobs_rl's resources. Id: ``gazelle/ABBIRB140Reach-v0``. As `UR5ReachEnv` but for

    - the limits of this arm, and goals in x from 0.3 to 1 m, y from -0.5 to 0.5 m, z from 0.2 to 1 m;
    - the reward: ``-100 * distance - 1``, or 100 at the goal; 1,000 less where a joint is at a limit;
    - the start: all joints at 0; and the end: within 0.1 m.
    """

    task_class = partial(ReachTask, IRB140)


ABBIRB140ReachVectorEnv = many_worlds(ABBIRB140ReachEnv)


class ABBIRB140VelocityReachEnv(ReachEnv):
    """An ABB IRB 140 turns its joints at slow speeds and keeps its tool at a place.

    The task ``ABBIRB140VelReacherEnv-v0`` of frobs_rl's resources. Id: ``gazelle/ABBIRB140VelocityReach-v0``. As `UR5ReachEnv`
    but for

    - the observation: joint angles, goal, direction, in this order; goals in x and y from -0.5 to 0.5 m, z from 0 to 1 m;
    - the action: ``Box(-0.2, 0.2, (6,))``, the speeds of the joints [rad/s] for 0.1 s; a joint within 0.09 rad of a
      limit does not turn towards it. The limits are those of that task, other than of `ABBIRB140ReachEnv`;
    - the reward: ``-distance``, or 100 within 0.05 m; 10 less where a joint is within 0.09 rad of a limit;
    - the end: there is none but the truncation after 300 steps. An episode that is at the goal then is a success.
    """

    task_class = partial(ReachTask, IRB140_SPEED)


ABBIRB140VelocityReachVectorEnv = many_worlds(ABBIRB140VelocityReachEnv)
