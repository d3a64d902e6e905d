"""Times of given points: grown until the parabolas between them are within limits.

Method: that of MoveIt's iterative parabolic time parameterization, reimplemented: each interval is as
long as velocities need, and grows where the change of velocity from one to the next is too great.
"""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats

_ROUNDS = 1000
_GROWTH = 1.02
_SMALL = 1e-4


def iterative_parabolic(points: Floats, velocity: Floats, acceleration: Floats) -> Floats:
    """Return times of points.

    Args:
        points: Each another one than the last, shape (m, n), m at least 2.
        velocity: Limits [m/s or rad/s], shape (n,).
        acceleration: Limits [m/s² or rad/s²], shape (n,).

    Returns:
        Since the start [s], shape (m,). Accelerations may exceed limits a little where they had no
        time to settle; the caller sees to that.
    """
    steps = np.diff(points, axis=0)
    spans = np.maximum((np.abs(steps) / velocity).max(axis=1), _SMALL)
    for _ in range(_ROUNDS):
        # It stands still before the first point and after the last one.
        rates = np.pad(steps / spans[:, None], ((1, 1), (0, 0)))
        wide = np.pad(spans, 1, mode="edge")
        wide[0] = wide[-1] = 0.0
        push = 2.0 * np.abs(np.diff(rates, axis=0)) / (wide[1:] + wide[:-1])[:, None]
        over = (push > acceleration * (1.0 + 1e-6)).any(axis=1)
        if not over.any():
            break
        spans = np.where(over[1:] | over[:-1], spans * _GROWTH, spans)
    return np.concatenate(([0.0], np.cumsum(spans)))
