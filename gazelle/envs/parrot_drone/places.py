"""Start positions of the drone: over the field, with free space around and ahead of it."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats
from gazelle.envs.starts import chessboard

# x and y of what stands in the work space [m]: a barrier, and the stairs with the platform.
_STANDING = ((5.6, 6.4, -1.0, 1.04), (8.4, 9.6, 2.5, 4.6))
_AROUND, _AHEAD = 0.6, 1.4
_SIDE = 0.5
JITTER = 0.2
"""Largest offset of a start from the middle of its square, along x and along y [m]."""


def squares(*, held_out: bool) -> Floats:
    """Return middles of start squares (x, y) [m], shape (n, 2): one colour of a chessboard.

    Args:
        held_out: Those of the other colour, which trainings do not see.
    """
    middle = chessboard(20, 10, held_out=held_out) * _SIDE
    x, y = middle.T
    free = ~((x > 8.0) & (y > 3.0))  # that would be the goal
    for x0, x1, y0, y1 in _STANDING:
        free &= (x < x0 - _AHEAD) | (x > x1 + _AROUND) | (y < y0 - _AROUND) | (y > y1 + _AROUND)
    return np.asarray(middle[free], np.float64)
