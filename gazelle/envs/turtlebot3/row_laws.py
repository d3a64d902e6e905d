# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc, no-any-return"
"""Formulas of the TurtleBot3 tasks for one world after another."""

from __future__ import annotations

import math

import cython
import numpy as np
from cython.cimports.gazelle.envs.decimals import round_one
from cython.cimports.gazelle.envs.polar import distance_of, heading_of
from cython.cimports.gazelle.envs.scans import clean_all, find_nearest
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
    cleaned: Floats32,
    shortest: Floats32,
    ray: NDArray[np.intp],
    found: Floats,
) -> None:
    """Find what robots see.

    Args:
        ranges: As the lidar reports them [m], shape (n, samples).
        nearest: Stands for what is too near [m].
        farthest: Caps ranges [m].
        pose: Of the robots: x, y [m] and heading [rad], shape (n, 3).
        goal: In the world frame [m], shape (n, 2).
        cleaned: For the ranges [m], shape (n, samples).
        shortest: For the shortest of them [m], shape (n,).
        ray: For its index, shape (n,).
        found: For the shortest range, the same rounded, and the rounded distance [m] and heading
            [rad] of the goal, shape (4, n).
    """
    clean_all(ranges, cleaned, nearest, farthest)
    find_nearest(cleaned, shortest, ray)
    for i in range(ranges.shape[0]):
        x, y = goal[i, 0] - pose[i, 0], goal[i, 1] - pose[i, 1]
        found[0, i] = shortest[i]
        found[1, i] = round_one(shortest[i], 100.0)
        found[2, i] = round_one(distance_of(x, y), 100.0)
        found[3, i] = round_one(heading_of(x, y, pose[i, 2]), 100.0)


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


def scale_rewards(
    heading: Floats, index: Floats, nearest: Floats, near: float, penalty: float, reward: Floats
) -> None:
    """Multiply factors by the rounded rewards of turns, and add a penalty where a range is short.

    Args:
        heading: See ``rewards.travelling_reward``, shape (n,).
        index: Likewise.
        nearest: Likewise.
        near: A shorter range is penalised [m].
        penalty: Added there.
        reward: The factors; becomes the rewards, shape (n,).
    """
    for i in range(heading.shape[0]):
        turning = round_one(wave_of(heading[i], index[i]) * 5.0, 100.0)
        reward[i] = turning * reward[i] + (penalty if nearest[i] < near else 0.0)
