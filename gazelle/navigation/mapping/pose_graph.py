"""Poses that constraints between them hold together, by least squares.

G. Grisetti, R. Kümmerle, C. Stachniss and W. Burgard, "A tutorial on graph-based SLAM", 2010.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.navigation.following import Pose2

_ROUNDS, _STILL = 10, 1e-6


@dataclass(frozen=True, slots=True)
class PoseEdge:
    """Constraint between two poses.

    Attributes:
        first: Number of one.
        second: Number of the other.
        pose: The second in the frame of the first.
        weights: Of x, y and heading: inverse variances.
    """

    first: int
    second: int
    pose: Pose2
    weights: tuple[float, float, float]


def optimized(poses: Floats, edges: list[PoseEdge]) -> Floats:
    """Return poses that fit all edges best, the first one kept; shape (n, 3).

    Args:
        poses: x, y [m] and heading [rad] to begin with, shape (n, 3).
        edges: Between them.
    """
    poses = poses.copy()
    first = np.array([edge.first for edge in edges])
    second = np.array([edge.second for edge in edges])
    measured = np.array([edge.pose for edge in edges])
    weights = np.array([edge.weights for edge in edges])
    for _ in range(_ROUNDS):
        step = _step(poses, first, second, measured, weights)
        poses += step
        if np.abs(step).max() < _STILL:
            break
    return poses


def _step(
    poses: Floats, first: Indices, second: Indices, measured: Floats, weights: Floats
) -> Floats:
    """Compute one step of Gauss and Newton, shape (n, 3)."""
    a, b = poses[first], poses[second]
    cos, sin = np.cos(a[:, 2]), np.sin(a[:, 2])
    dx, dy = b[:, 0] - a[:, 0], b[:, 1] - a[:, 1]
    seen = np.stack((cos * dx + sin * dy, cos * dy - sin * dx, b[:, 2] - a[:, 2]), axis=1)
    error = seen - measured
    error[:, 2] = (error[:, 2] + math.pi) % (2.0 * math.pi) - math.pi
    one = np.ones(len(first))
    zero = 0.0 * one
    to_first = np.array(
        [[-cos, -sin, seen[:, 1]], [sin, -cos, -seen[:, 0]], [zero, zero, -one]]
    ).transpose(2, 0, 1)
    to_second = np.array([[cos, sin, zero], [-sin, cos, zero], [zero, zero, one]]).transpose(
        2, 0, 1
    )
    count = len(poses)
    blocks: Floats = np.zeros((count * count, 3, 3))
    right: Floats = np.zeros((count, 3))
    for i, jacobian in ((first, to_first), (second, to_second)):
        np.add.at(right, i, np.einsum("eki,ek->ei", jacobian, weights * error))
        for j, other in ((first, to_first), (second, to_second)):
            block = np.einsum("eki,ek,ekj->eij", jacobian, weights, other)
            np.add.at(blocks, i * count + j, block)
    # The first pose stays.
    blocks[0] += np.eye(3) * max(float(weights.max()), 1.0) * 1e3
    matrix = blocks.reshape(count, count, 3, 3).transpose(0, 2, 1, 3).reshape(3 * count, -1)
    step: Floats = np.asarray(np.linalg.solve(matrix, -right.ravel()), np.float64)
    return step.reshape(-1, 3)
