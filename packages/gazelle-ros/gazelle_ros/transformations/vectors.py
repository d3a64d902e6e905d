"""Lengths and directions of vectors."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from gazelle_ros.base.array_types import Floats

EPS = 4.0 * float(np.finfo(np.float64).eps)
"""Threshold of zero where a formula divides."""


def vector_norm(data: npt.ArrayLike, axis: int | None = None, out: Floats | None = None) -> Any:
    """Return the length of vectors: of all of `data` as one, or along an axis.

    Args:
        data: Any shape.
        axis: Along which the vectors lie.
        out: Takes the result, which is not returned then.
    """
    values = np.asarray(data, dtype=np.float64)
    squares = np.atleast_1d(np.sum(values * values, axis=axis))
    if out is not None:
        np.sqrt(squares, out=out)
        return None
    roots = np.sqrt(squares)
    return float(roots[0]) if axis is None or values.ndim == 1 else roots


def unit_vector(data: npt.ArrayLike, axis: int | None = None, out: Floats | None = None) -> Any:
    """Return the vectors scaled to length 1; see `vector_norm`.

    A vector of length 0 gives NaN. A vector of length 0 gives NaN.
    """
    values = np.asarray(data, dtype=np.float64)
    norm = np.sqrt(np.sum(values * values, axis=axis, keepdims=axis is not None))
    with np.errstate(invalid="ignore", divide="ignore"):
        scaled = values / norm
    if out is not None:
        out[...] = scaled
        return None
    return scaled


def random_vector(size: Any) -> Floats:
    """Return random numbers between 0 and 1.

    Args:
        size: The shape.
    """
    return np.asarray(np.random.default_rng().random(size), dtype=np.float64)


def eigenvector(matrix: Floats, value: float, tolerance: float = 1e-8) -> list[Floats]:
    """Return real unit eigenvectors of an eigenvalue, as many as numpy finds."""
    values, vectors = np.linalg.eig(matrix)
    found = np.flatnonzero(np.abs(np.real(values) - value) < tolerance)
    return [np.real(vectors[:, index]).squeeze() for index in found]


def fixed_point(matrix: Floats) -> Floats:
    """Return a fixed point of a transformation, homogeneous, shape (4,).

    Raises:
        ValueError: There is none.
    """
    found = eigenvector(matrix, 1.0)
    if not found:
        raise ValueError("no eigenvector corresponding to eigenvalue 1")
    point = found[-1]
    return np.asarray(point / point[3])
