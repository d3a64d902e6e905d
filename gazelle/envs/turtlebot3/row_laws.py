# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc, no-any-return"
"""Formulas of the TurtleBot3 tasks for one world after another."""

from __future__ import annotations

import math

import cython
import numpy as np
from cython.cimports.gazelle.envs.decimals import round_all, round_one
from cython.cimports.gazelle.envs.polar import distance_of, heading_of
from cython.cimports.gazelle.envs.scans import clean_all, nearest_of
from cython.cimports.libc.math import fabs, floor, fmod
from numpy.typing import NDArray

from gazelle.array_types import Floats, Floats32

PI = cython.declare(cython.double, math.pi)


def see(
    ranges: Floats,
    nearest: float,
    farthest: float,
    pose: Floats,
    goal: Floats,
    state: Floats32,
    found: Floats,
) -> None:
    """Find what robots see.

    Args:
        ranges: As the lidar reports them [m], shape (n, samples).
        nearest: Stands for what is too near [m].
        farthest: Caps ranges [m].
        pose: Of the robots: x, y [m] and heading [rad], shape (n, 3).
        goal: In the world frame [m], shape (n, 2).
        state: For the ranges [m], heading and distance of the goal and, where there is room, the
            shortest range and its index, shape (n, samples + 2) or (n, samples + 4).
        found: For the shortest range, the same rounded, and the rounded distance [m] and heading
            [rad] of the goal, and these two before they are rounded, shape (6, n).
    """
    samples = ranges.shape[1]
    clean_all(ranges, state, nearest, farthest)
    for i in range(ranges.shape[0]):
        ray = nearest_of(state, i, samples)
        x, y = goal[i, 0] - pose[i, 0], goal[i, 1] - pose[i, 1]
        found[0, i] = state[i, ray]
        found[4, i], found[5, i] = distance_of(x, y), heading_of(x, y, pose[i, 2])
        if state.shape[1] > samples + 2:
            state[i, samples + 3] = ray
    round_all(found[0], found[1], 100.0)
    round_all(found[4], found[2], 100.0)
    round_all(found[5], found[3], 100.0)
    for i in range(ranges.shape[0]):
        state[i, samples], state[i, samples + 1] = found[3, i], found[2, i]
        if state.shape[1] > samples + 2:
            state[i, samples + 2] = found[1, i]


def wave_of(heading: float, index: float) -> float:
    """Return what ``rewards.turning_reward`` says of one turn."""
    phi = -PI / 4.0 + heading + PI / 8.0 * index + PI / 2.0
    turned = fmod(0.5 * phi, 2.0 * PI)
    if turned < 0.0:
        turned += 2.0 * PI
    turns = 0.25 + turned / PI
    return 1.0 - 4.0 * fabs(0.5 - (turns - floor(turns)))


def find_waves(heading: Floats, index: Floats, wave: Floats) -> None:
    """Find what ``rewards.turning_reward`` says of turns, shape (n,)."""
    for i in range(heading.shape[0]):
        wave[i] = wave_of(heading[i], index[i])


def judge_all(
    found: Floats,
    angular: Floats,
    collision: float,
    arrival: float,
    near: float,
    penalty: float,
    crash: float,
    prize: float,
    reward: Floats,
    ends: NDArray[np.uint8],
) -> None:
    """Find which robots collide and arrive, and what a step pays.

    Args:
        found: As of ``see``, shape (6, n).
        angular: Commanded yaw rates [rad/s], shape (n,).
        collision: A shorter range is a collision [m]; one of 0 is a failed ray.
        arrival: A shorter rounded distance is a reached goal [m].
        near: A shorter rounded range is penalised [m].
        penalty: Added there.
        crash: Reward of a collision.
        prize: Reward of a reached goal, collision or not.
        reward: Factors of the rewards of turns; becomes the rewards, shape (n,).
        ends: For collisions, and for arrivals, shape (2, n).
    """
    for i in range(reward.shape[0]):
        turning = round_one(wave_of(found[3, i], 2.0 - angular[i] / 0.75) * 5.0, 100.0)
        reward[i] = turning * reward[i] + (penalty if found[1, i] < near else 0.0)
        ends[0, i] = found[0, i] > 0.0 and found[0, i] < collision
        ends[1, i] = found[2, i] < arrival
        if ends[0, i]:
            reward[i] = crash
        if ends[1, i]:
            reward[i] = prize
