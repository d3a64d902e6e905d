"""Distances between angles (http://wiki.ros.org/angles)."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Bools, Floats

_TURN = 2.0 * math.pi


def normalized(angle: Floats) -> Floats:
    """Return the same angle in -pi to pi [rad]; pi stays pi."""
    positive = np.mod(angle, _TURN)
    return np.where(positive > math.pi, positive - _TURN, positive)


def shortest(start: Floats, end: Floats) -> Floats:
    """Return the turn from one angle to another, the shorter way round [rad]."""
    return normalized(end - start)


def distance(start: Floats, end: Floats, continuous: Bools, lower: Floats, upper: Floats) -> Floats:
    """Return the turns of joints: the shorter way round, if it stays within their limits.

    If it does not the other way round is taken, and the shorter one again if neither does; limits may be
    of more than a turn.

    Args:
        start: Start positions [rad], shape (..., n).
        end: End positions [rad], likewise.
        continuous: Mask of joints without limits, shape (n,).
        lower: Limits [rad], shape (n,).
        upper: Limits [rad], shape (n,).
    """
    short = shortest(start, end)
    other = np.where(short > 0.0, short - _TURN, short + _TURN)
    inside = (start + short >= lower) & (start + short <= upper)
    other_inside = (start + other >= lower) & (start + other <= upper)
    return np.where(continuous | inside | ~other_inside, short, other)
