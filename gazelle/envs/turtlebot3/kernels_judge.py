"""What a TurtleBot3 task makes of a control step, world by world.

The same arithmetic as ``observations``, ``rewards`` and ``terminations``, in native code.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.engines.native import each, kernel, lesser, part, whole
from gazelle.engines.planar.columns import YAW, X, Y
from gazelle.envs.planar.kernels_lidar import report, see
from gazelle.envs.planar.tables import Flags, Floats, Table, Worlds

_SPLIT = 2.0**27 + 1.0

# Columns of the rules.
COLLISION_RANGE = 0
GOAL_DISTANCE = 1
GOAL_REWARD = 2
COLLISION_REWARD = 3
OBSTACLE_RANGE = 4
OBSTACLE_REWARD = 5
SEES_OBSTACLE = 6


@part
def round2(x: float) -> float:
    """As ``gazelle.envs.decimals.round2``."""
    product = x * 100.0
    high = x * _SPLIT
    high -= high - x
    error = (high * 100.0 - product) + (x - high) * 100.0
    below = math.floor(product)
    if product - below == 0.5 and error != 0.0:
        return (below + 1.0 if error > 0.0 else below) / 100.0
    return float(np.rint(product) / 100.0)


@part
def turning(heading: float, index: float) -> float:
    """As ``rewards.turning_reward``."""
    phi = -math.pi / 4 + heading + math.pi / 8 * index + math.pi / 2
    turns = 0.25 + (0.5 * phi % (2.0 * math.pi)) / math.pi
    return float(1.0 - 4.0 * abs(0.5 - turns % 1.0))


@whole
def observe(
    first: int, last: int, worlds: Worlds, cleaned: Floats, pose: Floats, nbody: int, robot: int,
    goals: Floats, goal: Table, rules: Floats, observation: Table, distances: Floats,
    headings: Floats, nearest: Floats,
) -> None:  # fmt: skip
    """The observation of worlds[first] to worlds[last - 1], a row an index."""
    count = cleaned.shape[1]
    for i in range(first, last):
        b = worlds[i] * nbody + robot
        least = np.inf
        for k in each(0, count):
            observation[i, k] = cleaned[i, k]
            value = observation[i, k]  # in single precision, as ``observations.sight`` has it
            least = lesser(least, value)
        gx, gy = goals[goal[worlds[i]], 0], goals[goal[worlds[i]], 1]
        dx, dy = gx - pose[b, X], gy - pose[b, Y]
        angle = math.atan2(dy, dx) - pose[b, YAW]
        angle = angle - 2.0 * math.pi if angle > math.pi else angle
        angle = angle + 2.0 * math.pi if angle < -math.pi else angle
        distances[i], headings[i], nearest[i] = round2(math.hypot(dx, dy)), round2(angle), least
        observation[i, count], observation[i, count + 1] = headings[i], distances[i]
        if rules[SEES_OBSTACLE] != 0.0:
            ray = 0
            while ray + 1 < count and observation[i, ray] != least:
                ray += 1
            observation[i, count + 2], observation[i, count + 3] = round2(least), ray


@part
def judge(
    first: int, last: int, distances: Floats, headings: Floats, nearest: Floats,
    angular: Floats, step: float, middle: float, start_distance: Floats, rules: Floats,
    reward: Floats, crashed: Flags, arrived: Flags,
) -> None:  # fmt: skip
    """Reward and ends of a control step in the worlds first to last."""
    for w in range(first, last):
        hit = 0.0 < nearest[w] < rules[COLLISION_RANGE]
        there = distances[w] < rules[GOAL_DISTANCE]
        pay = round2(turning(headings[w], middle - angular[w] / step) * 5.0)
        pay *= 2.0 ** (distances[w] / start_distance[w])
        pay += rules[OBSTACLE_REWARD] if round2(nearest[w]) < rules[OBSTACLE_RANGE] else 0.0
        pay = rules[COLLISION_REWARD] if hit else pay
        reward[w] = rules[GOAL_REWARD] if there else pay
        crashed[w], arrived[w] = hit, there


@kernel
def look(
    first: int, last: int, seeing: Table, reporting: Table, observing: Table,
) -> None:  # fmt: skip
    """The observation of worlds[first] to worlds[last - 1], without a step.

    Each tuple holds what a kernel takes after the range of worlds: ``see``, ``report`` and
    ``observe``.
    """
    see(first, last, *seeing)
    report(first, last, *reporting)
    observe(first, last, *observing)
