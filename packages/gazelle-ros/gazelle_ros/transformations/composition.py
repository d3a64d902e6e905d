"""Matrices made of several parts, taken apart, compared and fitted."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats
from gazelle_ros.transformations.euler import euler_from_matrix, euler_matrix
from gazelle_ros.transformations.quaternions import quaternion_matrix
from gazelle_ros.transformations.vectors import EPS


def concatenate_matrices(*matrices: npt.ArrayLike) -> Floats:
    """Return the product of matrices: the last acts first."""
    result = np.identity(4)
    for matrix in matrices:
        result = result @ np.asarray(matrix, dtype=np.float64)
    return result


def is_same_transform(matrix0: npt.ArrayLike, matrix1: npt.ArrayLike) -> bool:
    """Return whether two matrices, which may differ by a factor, move points alike."""
    one, two = (np.array(matrix, dtype=np.float64) for matrix in (matrix0, matrix1))
    return bool(np.allclose(one / one[3, 3], two / two[3, 3]))


def compose_matrix(
    scale: npt.ArrayLike | None = None,
    shear: npt.ArrayLike | None = None,
    angles: npt.ArrayLike | None = None,
    translate: npt.ArrayLike | None = None,
    perspective: npt.ArrayLike | None = None,
) -> Floats:
    """Return the matrix that scales, shears, rotates, translates, and projects, in this order.

    Args:
        scale: Factors along x, y and z.
        shear: Of x along y, x along z, and y along z.
        angles: Euler angles about still x, y and z axes [rad].
        translate: The vector.
        perspective: The last row of the projection, shape (4,).
    """
    last, move, turn, bend, size = (np.identity(4) for _ in range(5))
    if perspective is not None:
        last[3, :] = np.asarray(perspective, dtype=np.float64)[:4]
    if translate is not None:
        move[:3, 3] = np.asarray(translate, dtype=np.float64)[:3]
    if angles is not None:
        first, second, third = np.asarray(angles, dtype=np.float64)[:3].tolist()
        turn = euler_matrix(first, second, third, "sxyz")
    if shear is not None:
        bend[0, 1], bend[0, 2], bend[1, 2] = np.asarray(shear, dtype=np.float64)[:3]
    if scale is not None:
        size[:3, :3] = np.diag(np.asarray(scale, dtype=np.float64)[:3])
    result = last @ move @ turn @ bend @ size
    return np.asarray(result / result[3, 3])


def decompose_matrix(
    matrix: npt.ArrayLike,
) -> tuple[Floats, list[float], list[float], Floats, Floats]:
    """Return scale, shear, angles, translation and perspective; see `compose_matrix`.

    Raises:
        ValueError: The matrix is of another kind, or degenerate.

    Source: Thomas, Decomposing a matrix into simple transformations, Graphics Gems II, 1991.
    """
    m = np.array(matrix, dtype=np.float64)
    if abs(m[3, 3]) < EPS:
        raise ValueError("M[3, 3] is zero")
    m /= m[3, 3]
    affine = m.copy()
    affine[3] = (0.0, 0.0, 0.0, 1.0)
    if abs(np.linalg.det(affine)) < EPS:
        raise ValueError("matrix is singular")
    perspective = np.array([0.0, 0.0, 0.0, 1.0])
    if np.any(np.abs(m[3, :3]) > EPS):
        perspective = m[3] @ np.linalg.inv(affine)
    turn, upper = np.linalg.qr(affine[:3, :3])
    signs = np.where(np.diag(upper) < 0.0, -1.0, 1.0)
    turn, upper = turn * signs, upper * signs[:, None]
    if np.linalg.det(turn) < 0.0:
        turn, upper = -turn, -upper
    scale = np.diag(upper).copy()
    shear = [
        float(upper[0, 1] / scale[1]),
        float(upper[0, 2] / scale[2]),
        float(upper[1, 2] / scale[2]),
    ]
    return scale, shear, list(euler_from_matrix(turn)), affine[:3, 3].copy(), perspective


def orthogonalization_matrix(lengths: npt.ArrayLike, angles: npt.ArrayLike) -> Floats:
    """Return the matrix from fractional coordinates of a crystal's cell to Cartesian ones.

    Args:
        lengths: Of the cell's edges.
        angles: Between them, in degrees.
    """
    a, b, c = np.asarray(lengths, dtype=np.float64).tolist()
    alpha, beta, gamma = np.radians(np.asarray(angles, dtype=np.float64)).tolist()
    mixed = (math.cos(alpha) * math.cos(beta) - math.cos(gamma)) / (
        math.sin(alpha) * math.sin(beta)
    )
    return np.array(
        [
            [a * math.sin(beta) * math.sqrt(1.0 - mixed * mixed), 0.0, 0.0, 0.0],
            [-a * math.sin(beta) * mixed, b * math.sin(alpha), 0.0, 0.0],
            [a * math.cos(beta), b * math.cos(alpha), c, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def superimposition_matrix(
    v0: npt.ArrayLike,
    v1: npt.ArrayLike,
    scaling: bool = False,  # noqa: FBT001, FBT002  # callers pass it by position
    usesvd: bool = True,  # noqa: FBT001, FBT002
) -> Floats:
    """Return the rotation and translation that map points closest to others.

    Args:
        v0: The points, shape (3, n) or (4, n), n at least 3.
        v1: Vectors to rotate to.
        scaling: Allow scaling, too.
        usesvd: Use a singular value decomposition, else quaternions.

    Raises:
        ValueError: The shapes differ, or are too small.

    Sources: Kabsch, A discussion of the solution for the best rotation, 1978; Horn, Closed-form
    solution of absolute orientation using unit quaternions, 1987.
    """
    one = np.asarray(v0, dtype=np.float64)[:3]
    two = np.asarray(v1, dtype=np.float64)[:3]
    if one.shape != two.shape or one.shape[1] < 3:
        raise ValueError("Vector sets are of wrong shape or type.")
    middle, goal = one.mean(axis=1), two.mean(axis=1)
    one, two = one - middle[:, None], two - goal[:, None]
    result = np.identity(4)
    result[:3, :3] = _kabsch(one, two) if usesvd else _horn(one, two)
    if scaling:
        result[:3, :3] *= math.sqrt(float(np.sum(two * two)) / float(np.sum(one * one)))
    result[:3, 3] = goal - result[:3, :3] @ middle
    return result


def _kabsch(one: Floats, two: Floats) -> Floats:
    left, _, right = np.linalg.svd(two @ one.T)
    if np.linalg.det(left) * np.linalg.det(right) < 0.0:
        left[:, -1] *= -1.0
    return np.asarray(left @ right)


def _horn(one: Floats, two: Floats) -> Floats:
    s = one @ two.T
    skew = np.array([s[1, 2] - s[2, 1], s[2, 0] - s[0, 2], s[0, 1] - s[1, 0]])
    form = np.empty((4, 4))  # in the order x, y, z, w
    form[:3, :3] = s + s.T - np.trace(s) * np.identity(3)
    form[:3, 3] = form[3, :3] = skew
    form[3, 3] = np.trace(s)
    best = np.linalg.eigh(form)[1][:, -1]
    return quaternion_matrix(best)[:3, :3]
