"""Observations of the TurtleBot3 tasks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from gazelle.array_types import Floats, Floats32
from gazelle.envs.turtlebot3.row_laws import see
from gazelle.envs.turtlebot3.rules import Rules


@dataclass(slots=True)
class RobotViews:
    """Observed state of n worlds at one moment.

    Attributes:
        ranges: Cleaned ranges [m], shape (n, samples), numbers of single precision.
        found: Shortest of them [m], the same rounded to 0.01 m, distance and heading, shape (4, n).
        ray: Index of the shortest, shape (n,).
        distance: To the goal, rounded to 0.01 m, shape (n,).
        heading: Of the goal, rounded to 0.01 rad, shape (n,).
        position: Of the robots in the world frame [m], shape (n, 2).
    """

    ranges: Floats32
    found: Floats
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
    count, samples = ranges.shape
    # Single precision, as in a LaserScan message and in the observation: what is worked out of
    # ranges here comes out the same from those.
    cleaned, shortest = np.empty((count, samples), np.float32), np.empty(count, np.float32)
    ray, found = np.empty(count, np.intp), np.empty((4, count))
    whole, farthest = np.ascontiguousarray(ranges), rules.range_max
    see(whole, range_min, farthest, pose, goal, cleaned, shortest, ray, found)
    return RobotViews(cleaned, found, ray, found[2], found[3], pose[:, :2])


def observation(rules: Rules, seen: RobotViews) -> Floats32:
    """Return the state: ranges, heading, distance and, if the stage has it, the nearest obstacle.

    Returns:
        Shape (n, samples + 2) or (n, samples + 4).
    """
    count, samples = seen.ranges.shape
    state = np.empty((count, samples + (4 if rules.sees_obstacle else 2)), np.float32)
    state[:, :samples], state[:, samples] = seen.ranges, seen.heading
    state[:, samples + 1] = seen.distance
    if rules.sees_obstacle:
        state[:, samples + 2], state[:, samples + 3] = seen.found[1], seen.ray
    return state


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
