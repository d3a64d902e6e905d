"""Observations of the TurtleBot3 tasks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from gazelle.array_types import Floats, Floats32
from gazelle.envs.decimals import round2
from gazelle.envs.polar import distance_to, heading_to
from gazelle.envs.scans import clean_ranges, nearest_obstacle
from gazelle.envs.turtlebot3.rules import Rules


@dataclass(frozen=True, slots=True)
class RobotViews:
    """Observed state of n worlds at one moment.

    Attributes:
        ranges: Cleaned ranges [m], shape (n, samples), numbers of single precision.
        nearest: Shortest of them [m], shape (n,).
        rounded: The same, rounded to 0.01 m, shape (n,).
        ray: Its index, shape (n,).
        distance: To the goal, rounded to 0.01 m, shape (n,).
        heading: Of the goal, rounded to 0.01 rad, shape (n,).
        position: Of the robots in the world frame [m], shape (n, 2).
    """

    ranges: Floats32
    nearest: Floats
    rounded: Floats
    ray: NDArray[np.intp]
    distance: Floats
    heading: Floats
    position: Floats


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
    # Single precision, as in a LaserScan message and in the observation: what is worked out of
    # ranges here comes out the same from those.
    cleaned = clean_ranges(ranges, nearest=range_min, farthest=rules.range_max)
    shortest, ray = nearest_obstacle(cleaned)
    nearest = shortest.astype(np.float64)
    heading = heading_to(pose, pose[:, 2], goal)
    rounded, distance = round2(nearest), round2(distance_to(pose, goal))
    return RobotViews(cleaned, nearest, rounded, ray, distance, round2(heading), pose[:, :2])


def observation(rules: Rules, seen: RobotViews) -> Floats32:
    """Return the state: ranges, heading, distance and, if the stage has it, the nearest obstacle.

    Returns:
        Shape (n, samples + 2) or (n, samples + 4).
    """
    columns: list[NDArray[Any]] = [seen.ranges, seen.heading[:, None], seen.distance[:, None]]
    if rules.sees_obstacle:
        columns += [seen.rounded[:, None], seen.ray[:, None]]
    return np.concatenate(columns, axis=1, dtype=np.float32)


def observation_space(rules: Rules, samples: int, *, distance_max: float) -> Box:
    """Return the bounds of ``observation``.

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
