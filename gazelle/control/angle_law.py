"""Distances between two angles, as ``angles`` has them of arrays.

Compiled modules take what ``angle_law.pxd`` says; this is the same for Python that runs sources.
"""

from __future__ import annotations

import math
from typing import Final

_TURN: Final = 2.0 * math.pi


def shorter(turn: float) -> float:
    """Return the shorter way round of a turn of less than a revolution [rad]; pi stays pi."""
    if turn < 0.0:
        turn += _TURN
    return turn - _TURN if turn > math.pi else turn


def shortest(start: float, end: float) -> float:
    """Return the turn from one angle to another, the shorter way round [rad]; pi stays pi."""
    turn = end - start
    if not -_TURN < turn < _TURN:
        turn = math.fmod(turn, _TURN) if math.isfinite(turn) else math.nan
    return shorter(turn)


def within(start: float, short: float, lower: float, upper: float) -> float:
    """Return a turn within limits, or the one the other way round if only that is within them."""
    if lower <= start + short <= upper:
        return short
    other = short - _TURN if short > 0.0 else short + _TURN
    return other if lower <= start + other <= upper else short


def distance(start: float, end: float, continuous: bool, lower: float, upper: float) -> float:  # noqa: FBT001  as in C
    """Return a joint's turn: the shorter way round, unless only the other is within limits."""
    short = shortest(start, end)
    return short if continuous else within(start, short, lower, upper)
