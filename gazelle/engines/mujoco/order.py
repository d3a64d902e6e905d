"""MuJoCo's order of quaternions, (w, x, y, z), which no other room sees."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def wxyz_from_xyzw(q: Floats) -> Floats:
    """MuJoCo's order of many quaternions, shape (..., 4)."""
    return q[..., [3, 0, 1, 2]]


def xyzw_from_wxyz(q: Floats) -> Floats:
    """The public order of many quaternions, shape (..., 4)."""
    return q[..., [1, 2, 3, 0]]
