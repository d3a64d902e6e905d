"""Translations, turns, reflections and scalings as 4x4 matrices, and what made a matrix.

Points are shapes (3,) or (4,), homogeneous. Source of the formulas: Goldman, Matrices and
transformations, Graphics Gems I, and Recovering the data from the transformation matrix,
Graphics Gems II.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats
from gazelle_ros.transformations.vectors import eigenvector, fixed_point, unit_vector


def _three(values: npt.ArrayLike) -> Floats:
    return np.asarray(values, dtype=np.float64)[:3]


def _four_by_four(matrix: npt.ArrayLike) -> Floats:
    return np.asarray(matrix, dtype=np.float64)


def identity_matrix() -> Floats:
    """Return the identity."""
    return np.identity(4)


def inverse_matrix(matrix: npt.ArrayLike) -> Floats:
    """Return the inverse of a matrix."""
    return np.asarray(np.linalg.inv(_four_by_four(matrix)), dtype=np.float64)


def translation_matrix(direction: npt.ArrayLike) -> Floats:
    """Return the matrix that translates by a vector."""
    result = np.identity(4)
    result[:3, 3] = _three(direction)
    return result


def translation_from_matrix(matrix: npt.ArrayLike) -> Floats:
    """Return the translation of a matrix, shape (3,)."""
    return _four_by_four(matrix)[:3, 3].copy()


def reflection_matrix(point: npt.ArrayLike, normal: npt.ArrayLike) -> Floats:
    """Return the matrix that reflects at a plane, given by a point in it and its normal."""
    unit = unit_vector(_three(normal))
    result = np.identity(4)
    result[:3, :3] -= 2.0 * np.outer(unit, unit)
    result[:3, 3] = 2.0 * float(_three(point) @ unit) * unit
    return result


def reflection_from_matrix(matrix: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Return point (homogeneous) and normal of the plane of a reflection.

    Raises:
        ValueError: It is not a reflection.
    """
    m = _four_by_four(matrix)
    normals = eigenvector(m[:3, :3], -1.0)
    if not normals:
        raise ValueError("no unit eigenvector corresponding to eigenvalue -1")
    return fixed_point(m), normals[0]


def rotation_matrix(
    angle: float, direction: npt.ArrayLike, point: npt.ArrayLike | None = None
) -> Floats:
    """Return the matrix that rotates about an axis.

    Args:
        angle: By how much [rad].
        direction: Of the axis, any length.
        point: On the axis; by default the origin.
    """
    x, y, z = unit_vector(_three(direction))
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    along = np.outer((x, y, z), (x, y, z))
    cosine = math.cos(angle)
    result = np.identity(4)
    result[:3, :3] = cosine * np.identity(3) + (1.0 - cosine) * along + math.sin(angle) * cross
    if point is not None:
        fixed = _three(point)
        result[:3, 3] = fixed - result[:3, :3] @ fixed
    return result


def rotation_from_matrix(matrix: npt.ArrayLike) -> tuple[float, Floats, Floats]:
    """Return angle [rad], direction and a point (homogeneous) of the axis of a rotation.

    Raises:
        ValueError: It is not a rotation.
    """
    m = _four_by_four(matrix)
    turn = m[:3, :3]
    directions = eigenvector(turn.T, 1.0)
    if not directions:
        raise ValueError("no unit eigenvector corresponding to eigenvalue 1")
    direction = directions[-1]
    point = fixed_point(m)
    skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    cosine = (float(np.trace(turn)) - 1.0) / 2.0
    return math.atan2(float(skew @ direction) / 2.0, cosine), direction, point


def scale_matrix(
    factor: float, origin: npt.ArrayLike | None = None, direction: npt.ArrayLike | None = None
) -> Floats:
    """Return the matrix that scales.

    Args:
        factor: By how much; -1 mirrors at a point.
        origin: Fixed point; by default the origin.
        direction: Scale along it only.
    """
    result = np.identity(4)
    if direction is None:
        shrink = (1.0 - factor) * np.identity(3)
    else:
        unit = unit_vector(_three(direction))
        shrink = (1.0 - factor) * np.outer(unit, unit)
    result[:3, :3] -= shrink
    if origin is not None:
        result[:3, 3] = shrink @ _three(origin)
    return result


def scale_from_matrix(matrix: npt.ArrayLike) -> tuple[float, Floats, Floats | None]:
    """Return factor, origin (homogeneous) and direction (None if alike in all) of a scaling.

    Raises:
        ValueError: Nothing stays where it is.
    """
    m = _four_by_four(matrix)
    factor = float(np.trace(m[:3, :3])) - 2.0
    directions = eigenvector(m[:3, :3], factor)
    if directions:
        return factor, fixed_point(m), unit_vector(directions[0])
    return (factor + 2.0) / 3.0, fixed_point(m), None
