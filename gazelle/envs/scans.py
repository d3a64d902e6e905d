"""From what a lidar reports to numbers that a policy can take."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats


def clean_ranges(ranges: Floats, *, nearest: float, farthest: float) -> Floats:
    """Replace what is not a number by one.

    Args:
        ranges: As a lidar reports them [m], shape (n, samples): +inf when nothing is in range,
            -inf when something is too near (REP 117), NaN when the ray failed.
        nearest: Stands for -inf [m].
        farthest: Stands for +inf, and caps what a longer lidar sees [m].

    Returns:
        Ranges [m] in [0, farthest], shape (n, samples); NaN became 0.
    """
    cleaned = np.where(np.isnan(ranges), 0.0, ranges)
    cleaned[np.isneginf(cleaned)] = nearest
    return np.clip(cleaned, 0.0, farthest, out=cleaned)


def nearest_obstacle(ranges: Floats) -> tuple[Floats, NDArray[np.intp]]:
    """The shortest range [m] of each scan and the index of its ray, each of shape (n,)."""
    ray = ranges.argmin(axis=1)
    return ranges[np.arange(len(ranges)), ray], ray
