"""Projections, clipping volumes and shears.

Source of the formulas: Goldman, More matrices and transformations: shear and pseudo-perspective,
Graphics Gems II; and the OpenGL specification for clipping volumes.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats
from gazelle_ros.transformations.vectors import EPS, eigenvector, fixed_point, unit_vector


def projection_matrix(
    point: npt.ArrayLike,
    normal: npt.ArrayLike,
    direction: npt.ArrayLike | None = None,
    perspective: npt.ArrayLike | None = None,
    pseudo: bool = False,  # noqa: FBT001, FBT002  # callers pass it by position
) -> Floats:
    """Return the matrix that projects onto a plane.

    Args:
        point: In the plane.
        normal: Of the plane.
        direction: Project along it; by default along the normal.
        perspective: Project from this point instead.
        pseudo: Keep relative depth in a perspective projection.
    """
    result = np.identity(4)
    place = np.asarray(point, dtype=np.float64)[:3]
    unit = unit_vector(np.asarray(normal, dtype=np.float64)[:3])
    height = float(place @ unit)
    if perspective is not None:
        eye = np.asarray(perspective, dtype=np.float64)[:3]
        shift = eye + unit if pseudo else eye
        result[:3, :3] = float((eye - place) @ unit) * np.identity(3) - np.outer(shift, unit)
        result[:3, 3] = height * shift
        result[3, :3] = -unit
        result[3, 3] = float(eye @ unit)
        return result
    along = unit if direction is None else np.asarray(direction, dtype=np.float64)[:3]
    along = along / float(along @ unit)
    result[:3, :3] -= np.outer(along, unit)
    result[:3, 3] = height * along
    return result


def projection_from_matrix(
    matrix: npt.ArrayLike,
    pseudo: bool = False,  # noqa: FBT001, FBT002  # callers pass it by position
) -> tuple[Floats, Floats, Floats | None, Floats | None, bool]:
    """Recover the arguments of `projection_matrix` from a projection.

    Raises:
        ValueError: It is not a projection.
    """
    m = np.asarray(matrix, dtype=np.float64)
    if not pseudo and eigenvector(m, 1.0):
        return _parallel_from(m)
    values, vectors = np.linalg.eig(m)
    nonzero = np.flatnonzero(np.abs(np.real(values)) > 1e-8)
    if not len(nonzero):
        raise ValueError("no eigenvector not corresponding to eigenvalue 0")
    point = np.real(vectors[:, nonzero[-1]]).squeeze()
    point = point / point[3]
    normal = -m[3, :3]
    perspective = m[:3, 3] / float(point[:3] @ normal)
    if pseudo:
        perspective = perspective - normal
    return point, normal, None, perspective, pseudo


def _parallel_from(m: Floats) -> tuple[Floats, Floats, Floats | None, Floats | None, bool]:
    directions = eigenvector(m[:3, :3], 0.0)
    if not directions:
        raise ValueError("no eigenvector corresponding to eigenvalue 0")
    normals = eigenvector(m[:3, :3].T, 0.0)
    normal = unit_vector(normals[0]) if normals else np.zeros(3)
    return fixed_point(m), normal, unit_vector(directions[0]), None, False


def clip_matrix(
    left: float,
    right: float,
    bottom: float,
    top: float,
    near: float,
    far: float,
    perspective: bool = False,  # noqa: FBT001, FBT002  # callers pass it by position
) -> Floats:
    """Return the matrix that maps a box, or a frustum, to the cube from -1 to 1.

    Raises:
        ValueError: The volume is empty, or a frustum starts behind the eye.
    """
    if left >= right or bottom >= top or near >= far:
        raise ValueError("invalid frustrum")
    wide, high, deep = right - left, top - bottom, far - near
    if not perspective:
        return np.array(
            [
                [2.0 / wide, 0.0, 0.0, -(right + left) / wide],
                [0.0, 2.0 / high, 0.0, -(top + bottom) / high],
                [0.0, 0.0, 2.0 / deep, -(far + near) / deep],
                [0.0, 0.0, 0.0, 1.0],
            ]
        )
    if near <= EPS:
        raise ValueError("invalid frustrum: near <= 0")
    double = 2.0 * near
    return np.array(
        [
            [-double / wide, 0.0, (right + left) / wide, 0.0],
            [0.0, -double / high, (top + bottom) / high, 0.0],
            [0.0, 0.0, -(far + near) / deep, double * far / deep],
            [0.0, 0.0, -1.0, 0.0],
        ]
    )


def shear_matrix(
    angle: float, direction: npt.ArrayLike, point: npt.ArrayLike, normal: npt.ArrayLike
) -> Floats:
    """Return the matrix that shears along a plane.

    Args:
        angle: By which the normal is bent [rad].
        direction: Of the shear, in the plane.
        point: In the plane.
        normal: Of the plane.

    Raises:
        ValueError: The direction is not in the plane.
    """
    unit = unit_vector(np.asarray(normal, dtype=np.float64)[:3])
    along = unit_vector(np.asarray(direction, dtype=np.float64)[:3])
    if abs(float(unit @ along)) > 1e-6:
        raise ValueError("direction and normal vectors are not orthogonal")
    slope = math.tan(angle)
    result = np.identity(4)
    result[:3, :3] += slope * np.outer(along, unit)
    height = float(np.asarray(point, dtype=np.float64)[:3] @ unit)
    result[:3, 3] = -slope * height * along
    return result


def shear_from_matrix(matrix: npt.ArrayLike) -> tuple[float, Floats, Floats, Floats]:
    """Return angle [rad], direction, point (homogeneous) and normal of a shear.

    Raises:
        ValueError: It is not a shear.
    """
    m = np.asarray(matrix, dtype=np.float64)
    inside = eigenvector(m[:3, :3], 1.0, tolerance=1e-4)
    if len(inside) < 2:
        raise ValueError("no two linear independent eigenvectors found")
    normals = [np.cross(a, b) for a, b in itertools.combinations(inside, 2)]
    normal = unit_vector(max(normals, key=lambda vector: float(vector @ vector)))
    bent = (m[:3, :3] - np.identity(3)) @ normal
    slope = math.sqrt(float(bent @ bent))
    with np.errstate(invalid="ignore"):
        direction = bent / slope
    return math.atan(slope), direction, fixed_point(m), normal
