"""From what a lidar reports to numbers that a policy can take."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

R = TypeVar("R", np.float32, np.float64)


def clean_ranges(ranges: NDArray[R], *, nearest: float, farthest: float) -> NDArray[R]:
    """Replace what is not a number by one.

    Args:
        ranges: As a lidar reports them [m], shape (n, samples): +inf when nothing is in range,
            -inf when something is too near (REP 117), NaN when the ray failed.
        nearest: Stands for -inf [m].
        farthest: Stands for +inf, and caps what a longer lidar sees [m].

    Returns:
        Ranges [m] in [0, farthest], shape (n, samples), of the same precision; NaN became 0.
    """
    kind = ranges.dtype.type
    cleaned: NDArray[R] = np.fmax(ranges, kind(0.0))
    if np.fmin.reduce(ranges, axis=None, initial=0.0) == -np.inf:
        cleaned[np.isneginf(ranges)] = nearest
    np.fmin(cleaned, kind(farthest), out=cleaned)
    return cleaned


def nearest_obstacle(ranges: NDArray[R]) -> tuple[NDArray[R], NDArray[np.intp]]:
    """The shortest range [m] of each scan and the index of its ray, each of shape (n,)."""
    ray = ranges.argmin(axis=1)
    return ranges[np.arange(len(ranges)), ray], ray
