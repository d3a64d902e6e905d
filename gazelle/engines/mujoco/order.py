"""MuJoCo's order of quaternions, (w, x, y, z), which no other room sees."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


# Taken by an array, which is several times faster for one than indexing by a list.
_TO_WXYZ, _TO_XYZW = np.array([3, 0, 1, 2]), np.array([1, 2, 3, 0])


def wxyz_from_xyzw(q: Floats) -> Floats:
    """MuJoCo's order of many quaternions, shape (..., 4)."""
    return q.take(_TO_WXYZ, axis=-1)


def xyzw_from_wxyz(q: Floats) -> Floats:
    """The public order of many quaternions, shape (..., 4)."""
    return q.take(_TO_XYZW, axis=-1)
