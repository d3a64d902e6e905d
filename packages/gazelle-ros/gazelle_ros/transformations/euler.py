"""Euler angles of all 24 kinds.

A kind is named by four letters: ``s`` for axes that stand still or ``r`` for axes that turn
along, then the three axes in the order of the turns. Tuples ``(first axis, parity,
repetition, frame)`` mean the same, as in Shoemake, Euler angle conversion, Graphics Gems IV.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats
from gazelle_ros.transformations.quaternions import quaternion_matrix, quaternion_multiply
from gazelle_ros.transformations.vectors import EPS

Axes = str | tuple[int, int, int, int]
_LETTERS = "xyz"


def _names() -> dict[str, tuple[int, int, int, int]]:
    names = {}
    for first in range(3):
        for parity in range(2):
            for repetition in range(2):
                second = (first + 1 + parity) % 3
                third = first if repetition else 3 - first - second
                word = "".join(_LETTERS[axis] for axis in (first, second, third))
                names["s" + word] = (first, parity, repetition, 0)
                names["r" + word[::-1]] = (first, parity, repetition, 1)
    return names


AXES = _names()
"""Every name, and the tuple that means the same."""


def _kind(axes: Axes) -> tuple[tuple[int, int, int], bool, bool, bool]:
    """Return the axes of consecutive turns about fixed axes.

    Returns:
        The axes in order; whether two are the same; whether the order is odd; whether the
        angles are to be taken in reverse.
    """
    if isinstance(axes, str):
        axes = AXES[axes.lower()]
    first, parity, repetition, frame = axes
    second = (first + 1 + parity) % 3
    third = first if repetition else 3 - first - second
    return (first, second, third), bool(repetition), bool(parity), bool(frame)


def euler_matrix(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Floats:
    """Return the rotation matrix of three turns."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: Axes = "sxyz") -> Floats:
    """Return the quaternion of three turns.

    Arrays of one number are numbers, as NumPy had it of old.
    """
    order, _, _, reverse = _kind(axes)
    angles = (ak, aj, ai) if reverse else (ai, aj, ak)
    result = np.array([0.0, 0.0, 0.0, 1.0])
    for axis, angle in zip(order, angles, strict=True):
        turn = np.zeros(4)
        half = np.asarray(angle, np.float64).item() / 2.0
        turn[axis], turn[3] = math.sin(half), math.cos(half)
        result = quaternion_multiply(turn, result)
    return result


def euler_from_matrix(matrix: npt.ArrayLike, axes: Axes = "sxyz") -> tuple[float, float, float]:
    """Return the three turns that make a rotation.

    Args:
        matrix: Shape (3, 3) or larger.
        axes: The kind.
    """
    order, repeated, odd, reverse = _kind(axes)
    frame = [order[0], order[1], 3 - order[0] - order[1]]
    # With its axes in this order, the matrix is one of turns about x, y and then z or x.
    m = np.array(matrix, dtype=np.float64)[:3, :3][np.ix_(frame, frame)].tolist()
    first, second, third = _turns_xyx(m) if repeated else _turns_xyz(m)
    if odd:  # a left-handed order of axes turns every angle round
        first, second, third = -first, -second, -third
    return (third, second, first) if reverse else (first, second, third)


def _turns_xyz(m: Any) -> tuple[float, float, float]:
    cosine = math.hypot(m[0][0], m[1][0])
    second = math.atan2(-m[2][0], cosine)
    if cosine > EPS:
        return math.atan2(m[2][1], m[2][2]), second, math.atan2(m[1][0], m[0][0])
    return math.atan2(-m[1][2], m[1][1]), second, 0.0


def _turns_xyx(m: Any) -> tuple[float, float, float]:
    sine = math.hypot(m[0][1], m[0][2])
    second = math.atan2(sine, m[0][0])
    if sine > EPS:
        return math.atan2(m[0][1], m[0][2]), second, math.atan2(m[1][0], -m[2][0])
    return math.atan2(-m[1][2], m[1][1]), second, 0.0


def euler_from_quaternion(
    quaternion: npt.ArrayLike, axes: Axes = "sxyz"
) -> tuple[float, float, float]:
    """Return the three turns that make a rotation given as a quaternion of any norm."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)
