"""Observations of the TurtleBot3 tasks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from gymnasium.spaces import Box

from gazelle.array_types import Floats, Floats32
from gazelle.envs.turtlebot3.row_laws import see
from gazelle.envs.turtlebot3.rules import Rules


@dataclass(slots=True)
class RobotViews:
    """Observed state of n worlds at one moment.

    Attributes:
        state: Cleaned ranges [m], heading, distance and, if the stage has it, the nearest obstacle,
            shape (n, samples + 2) or (n, samples + 4), numbers of single precision.
        found: As of ``row_laws.see``, shape (6, n).
        distance: To the goal, rounded to 0.01 m, shape (n,).
        heading: Of the goal, rounded to 0.01 rad, shape (n,).
        position: Of the robots in the world frame [m], shape (n, 2).
        goal: In the world frame [m], shape (n, 2).
    """

    state: Floats32
    found: Floats
    distance: Floats
    heading: Floats
    position: Floats
    goal: Floats


def sight(
    rules: Rules,
    *,
    ranges: Floats,
    range_min: float,
    pose: Floats,
    goal: Floats,
) -> RobotViews:
    """Compute the robots' views.

    Args:
        rules: Of the stage.
        ranges: As the lidar reports them [m], shape (n, samples).
        range_min: The lidar's nearest distance [m].
        pose: Of the robots in the world frame: x, y [m] and heading [rad], shape (n, 3).
        goal: In the world frame [m], shape (n, 2).
    """
    count, samples = ranges.shape
    # Single precision, as in a LaserScan message and in the observation: what is worked out of
    # ranges here comes out the same from those.
    state = np.empty((count, samples + (4 if rules.sees_obstacle else 2)), np.float32)
    found = np.empty((6, count))
    whole, farthest = np.ascontiguousarray(ranges), rules.range_max
    see(whole, range_min, farthest, pose, goal, state, found)
    return RobotViews(state, found, found[2], found[3], pose[:, :2], goal)


def observation_space(rules: Rules, samples: int, *, distance_max: float) -> Box:
    """Return the bounds of ``RobotViews.state``.

    Args:
        rules: Of the stage.
        samples: Rays of the lidar.
        distance_max: Longest distance to a goal [m].
    """
    low = [0.0] * samples + [-np.pi, 0.0]
    high = [rules.range_max] * samples + [np.pi, distance_max]
    if rules.sees_obstacle:
        low += [0.0, 0.0]
        high += [rules.range_max, samples - 1.0]
    return Box(np.array(low, dtype=np.float32), np.array(high, dtype=np.float32))
