# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc, no-any-return"
"""Quaternions (x, y, z, w) row by row: their headings, and checks of what users hand in."""

from __future__ import annotations

import cython
from cython.cimports.libc.math import fabs

from gazelle.array_types import Floats

SMALL = cython.declare(cython.double, 1e-100)
LARGE = cython.declare(cython.double, 1e100)


def find_headings(quaternions: Floats, ahead: Floats, aside: Floats) -> None:
    """Find where the x axis points after unit quaternions, shape (n, 4), along x and along y, (n,)."""
    for i in range(quaternions.shape[0]):
        x, y, z, w = quaternions[i, 0], quaternions[i, 1], quaternions[i, 2], quaternions[i, 3]
        ahead[i] = 1.0 - 2.0 * (y * y + z * z)
        aside[i] = 2.0 * (w * z + x * y)


def are_orientations(quaternions: Floats) -> bool:
    """Return whether all quaternions, shape (n, 4), can be divided by their lengths."""
    for i in range(quaternions.shape[0]):
        largest = 0.0
        for k in range(4):
            size = fabs(quaternions[i, k])
            if not size < LARGE:
                return False
            largest = max(largest, size)
        if not largest > SMALL:
            return False
    return True


def are_within(values: Floats, most: float) -> bool:
    """Return whether all values, shape (n, columns), are numbers of at most a magnitude."""
    for i in range(values.shape[0]):
        for k in range(values.shape[1]):
            if not fabs(values[i, k]) <= most:
                return False
    return True
