"""Global localization: candidate poses of a robot from its scan alone."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gazelle.array_types import Floats

_SIDE, _TURN = 0.1, 0.2
"""Poses are tried about so close to one another [m], [rad]."""
_MOST = 1_000_000
_SHARE = 0.2
"""Of the particles: as many candidates of equal weight count as much as those that are drawn."""


def count_for(area: float) -> int:
    """Return the number of poses to try on this much free ground [m²]."""
    return int(min(area / _SIDE**2 * 2.0 * math.pi / _TURN, _MOST)) + 1


def draw_fitting(
    candidates: Floats,
    scores: Callable[[Floats], Floats],
    count: int,
    random: np.random.Generator,
) -> Floats:
    """Sample poses that a scan fits well from many candidates; shape (count, 3).

    A few thousand particles strewn over a building miss the right place: none is near enough to be
    better than the others. More random poses are tried once, and particles begin where the scan fits
    best; how much better a pose has to be follows from how many are to remain (S. Lenser and M. Veloso,
    "Sensor resetting localization for poorly modelled mobile robots", 2000). Poses are drawn in two
    rounds, the second one close to what the first has found.

    Args:
        candidates: x, y [m] and heading [rad], shape (n, 3).
        scores: Score of the scan at each of some poses, up to a factor.
        count: Number of samples.
        random: Draws.
    """
    found = _drawn(candidates, scores(candidates), count, random)
    near = np.repeat(found, 4, axis=0)
    near += random.uniform(-0.5, 0.5, near.shape) * (_SIDE, _SIDE, _TURN)
    return _drawn(near, scores(near), count, random)


def _drawn(poses: Floats, scores: Floats, count: int, random: np.random.Generator) -> Floats:
    """Sample by a power of scores that leaves enough of them."""
    logs = np.log(np.maximum(scores, 1e-300))
    logs -= logs.max()
    few, many = 0.0, 64.0
    effective = _SHARE * count
    for _ in range(20):
        power = 0.5 * (few + many)
        weights = np.exp(power * logs)
        if weights.sum() ** 2 / (weights**2).sum() > effective:
            few = power
        else:
            many = power
    sums = np.cumsum(np.exp(few * logs))
    even = (np.arange(count) + random.random()) * (sums[-1] / count)
    places = np.minimum(np.searchsorted(sums, even, side="right"), len(poses) - 1)
    drawn: Floats = poses[places]
    return drawn
