# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc"
"""From what a lidar reports to numbers that a policy can take."""

# ruff: noqa: FURB136  # loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Floats32

INF = cython.declare(cython.double, float("inf"))
if not cython.compiled:
    WIDE = 32  # in a compiled module, what scans.pxd says


def clean_ranges(ranges: Floats, *, nearest: float, farthest: float) -> Floats32:
    """Replace what is not a number by one.

    Args:
        ranges: As a lidar reports them [m], shape (n, samples): +inf when nothing is in range,
            -inf when something is too near (REP 117), NaN when the ray failed.
        nearest: Stands for -inf [m].
        farthest: Stands for +inf, and caps what a longer lidar sees [m].

    Returns:
        Ranges [m] in [0, farthest], shape (n, samples), in single precision, as a LaserScan and an
        observation have them; NaN became 0.
    """
    cleaned = np.empty(ranges.shape, np.float32)
    clean_all(np.ascontiguousarray(ranges), cleaned, nearest, farthest)
    return cleaned


def clean_all(ranges: Floats, cleaned: Floats32, nearest: float, farthest: float) -> None:
    """Clean ranges, shape (n, samples); rows of ``cleaned`` may be longer."""
    near: cython.float = nearest
    far: cython.float = farthest
    zero: cython.float = 0.0
    for i in range(ranges.shape[0]):
        for j in range(ranges.shape[1]):
            single = cython.cast(cython.float, ranges[i, j])
            known = single if single > zero else zero  # not a number is not greater
            known = near if ranges[i, j] == -INF else known
            cleaned[i, j] = known if known < far else far


def nearest_obstacle(ranges: Floats32) -> tuple[Floats32, NDArray[np.intp]]:
    """Return the shortest range [m] of each scan and the index of its ray, each of shape (n,)."""
    ray = np.empty(len(ranges), np.intp)
    find_nearest(np.ascontiguousarray(ranges, np.float32), ray)
    return ranges[np.arange(len(ranges)), ray], ray


def find_nearest(ranges: Floats32, ray: NDArray[np.intp]) -> None:
    """Find the first of the shortest ranges of each scan, shape (n, samples)."""
    for i in range(ranges.shape[0]):
        ray[i] = nearest_of(ranges, i, ranges.shape[1])


def nearest_of(ranges: Floats32, i: int, samples: int) -> int:
    """Return the index of the first of the shortest ranges, of those with which a row begins.

    Where there are many, most blocks of ranges side by side have none that is shorter than those before.
    """
    best, at, k = ranges[i, 0], 0, 1
    while k + WIDE <= samples:
        closer = 0
        for j in range(k, k + WIDE):
            closer += ranges[i, j] < best
        if closer:
            for j in range(k, k + WIDE):
                if ranges[i, j] < best:
                    best, at = ranges[i, j], j
        k += WIDE
    for j in range(k, samples):
        nearer = ranges[i, j] < best
        best = ranges[i, j] if nearer else best
        at = j if nearer else at
    return at
