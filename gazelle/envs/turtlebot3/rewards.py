"""Rewards of the TurtleBot3 DQN tasks (``turtlebot3_machine_learning``, ROS 1)."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.envs.turtlebot3.observations import RobotViews
from gazelle.envs.turtlebot3.row_laws import find_waves, judge_all
from gazelle.envs.turtlebot3.rules import Rules


def turning_reward(heading: Floats, index: Floats) -> Floats:
    """Return a measure of how well a turn fits the direction of the goal.

    A triangle wave of ``phi = heading + pi/4 + index * pi/8`` with period 2 pi: 1 where the
    action turns the robot right at the goal, -1 where it turns it away. The published code
    knows five whole indices; the formula holds between them as well.

    Args:
        heading: Of the goal [rad], shape (n,).
        index: Of the action, 0 (left) to 4 (right), see ``turn_index``, shape (n,).

    Returns:
        Numbers in [-1, 1], shape (n,).
    """
    wave = np.empty(len(heading))
    find_waves(heading, index, wave)
    return wave


def judge(
    rules: Rules, seen: RobotViews, angular: Floats, start_distance: Floats, margin: float = 0.0
) -> tuple[Floats, Bools, Bools]:
    """Return what a step pays, and whether it collides and arrives, each of shape (n,).

    It pays ``round(5 * turning_reward, 2) * 2 ** (distance / start_distance)`` plus the obstacle
    term. The collision's reward replaces that, and the goal's either.

    Args:
        rules: Of the stage.
        seen: At the end of the step.
        angular: Commanded yaw rates [rad/s], -1.5 to 1.5, shape (n,).
        start_distance: To this goal when it was set, rounded [m], shape (n,).
        margin: Distance before the limit at which a range counts as a collision [m].
    """
    reward: Floats = np.exp2(seen.distance / start_distance)
    ends = np.empty((2, len(reward)), np.bool_)
    judge_all(
        seen.found,
        angular,
        rules.collision_range + margin,
        rules.goal_distance,
        rules.obstacle_range,
        rules.obstacle_reward,
        rules.collision_reward,
        rules.goal_reward,
        reward,
        ends.view(np.uint8),
    )
    return reward, ends[0], ends[1]
