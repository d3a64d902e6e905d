"""Angles between -pi and pi."""

from __future__ import annotations

import math

import numpy as np

from gazelle.array_types import Floats


def wrapped(angle: float) -> float:
    """Return the same angle within [-pi, pi] [rad]; one in it stays as it is, to the last bit."""
    return math.remainder(angle, math.tau)


def wrapped_all(angles: Floats) -> Floats:
    """Return the same angles within [-pi, pi] [rad]; those in it stay as they are, to the last bit."""
    return np.asarray(angles - math.tau * np.round(angles / math.tau))
