"""Rewards of the TurtleBot3 DQN tasks (``turtlebot3_machine_learning``, ROS 1)."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.envs.turtlebot3.row_laws import find_waves, scale_rewards
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


def travelling_reward(
    rules: Rules,
    *,
    heading: Floats,
    index: Floats,
    distance: Floats,
    start_distance: Floats,
    nearest: Floats,
) -> Floats:
    """Return the reward of a step that neither collides nor arrives.

    Args:
        rules: Of the stage.
        heading: Of the goal, rounded [rad], shape (n,).
        index: Of the action, see ``turn_index``, shape (n,).
        distance: To the goal, rounded [m], shape (n,).
        start_distance: To this goal when it was set, rounded [m], shape (n,).
        nearest: Shortest range, rounded as in the published state [m], shape (n,).

    Returns:
        ``round(5 * turning_reward, 2) * 2 ** (distance / start_distance)`` plus the obstacle
        term, shape (n,).
    """
    reward: Floats = np.exp2(distance / start_distance)
    scale_rewards(heading, index, nearest, rules.obstacle_range, rules.obstacle_reward, reward)
    return reward


def overrule(rules: Rules, reward: Floats, *, collided: Bools, reached: Bools) -> Floats:
    """Replace the step's reward by the collision's, and either by the goal's."""
    overruled = reward.copy()
    np.putmask(overruled, collided, rules.collision_reward)
    np.putmask(overruled, reached, rules.goal_reward)
    return overruled
