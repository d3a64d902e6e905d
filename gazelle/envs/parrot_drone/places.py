"""Where the drone can start: over the field, with room around and ahead of it."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats

# x and y of what stands in the work space [m]: a barrier, and the stairs with the platform.
_STANDING = ((5.6, 6.4, -1.0, 1.04), (8.4, 9.6, 2.5, 4.6))
_AROUND, _AHEAD = 0.6, 1.4
_SIDE = 0.5
JITTER = 0.2
"""How far from the middle of its square a start can be, along x and along y [m]."""


def squares(*, held_out: bool) -> Floats:
    """Middles of squares to start in (x, y) [m], shape (n, 2): those of one colour of a chessboard.

    Args:
        held_out: Those of the other colour, which trainings do not see.
    """
    column, row = np.meshgrid(np.arange(20), np.arange(10), indexing="ij")
    colour = (column + row) % 2 == int(held_out)
    middle = np.stack((column, row), axis=-1)[colour] * _SIDE
    x, y = middle.T
    free = ~((x > 8.0) & (y > 3.0))  # that would be the goal
    for x0, x1, y0, y1 in _STANDING:
        free &= (x < x0 - _AHEAD) | (x > x1 + _AROUND) | (y < y0 - _AROUND) | (y > y1 + _AROUND)
    return np.asarray(middle[free], np.float64)
