"""Shorter paths: straight motions between points of a path, where they are valid.

Method: Geraerts and Overmars, "Creating high-quality paths for motion planning", 2007.
"""

from __future__ import annotations

import time

import numpy as np

from gazelle.array_types import Floats
from gazelle.planning.state_validity import StateValidity

_TRIALS = 60
_FRUITLESS = 12


def shorten(
    points: Floats, validity: StateValidity, random: np.random.Generator, until: float
) -> Floats:
    """Return a path between the same ends that is no longer.

    Args:
        points: Positions on a valid path, shape (m, n).
        validity: Check of states and motions.
        random: Draws places.
        until: Deadline, on ``time.monotonic``'s clock [s].
    """
    path = _without_detours(points, validity, until)
    failed = 0
    for _ in range(_TRIALS):
        if len(path) < 3 or failed > _FRUITLESS or time.monotonic() > until:
            break
        shorter = _cut(path, validity, random)
        failed = failed + 1 if shorter is None else 0
        path = path if shorter is None else shorter
    return path


def _without_detours(points: Floats, validity: StateValidity, until: float) -> Floats:
    """Return the path from each point straight to the last one that can be reached so."""
    kept = [0]
    while kept[-1] < len(points) - 1:
        here = kept[-1]
        last = len(points) - 1
        while last > here + 1 and time.monotonic() < until:
            if validity.motion(points[here], points[last]):
                break
            last = here + max(1, (last - here) // 2)
        kept.append(max(here + 1, last))
    return points[kept]


def _cut(path: Floats, validity: StateValidity, random: np.random.Generator) -> Floats | None:
    """Return a path with a random shortcut; None if that is no gain."""
    lengths = np.linalg.norm(np.diff(path, axis=0), axis=1)
    ends = np.concatenate(([0.0], np.cumsum(lengths)))
    first, second = np.sort(random.uniform(0.0, ends[-1], 2))
    i, j = (int(np.searchsorted(ends, place, "right")) - 1 for place in (first, second))
    j = min(j, len(lengths) - 1)
    if i >= j:
        return None
    one = path[i] + (path[i + 1] - path[i]) * ((first - ends[i]) / lengths[i])
    two = path[j] + (path[j + 1] - path[j]) * ((second - ends[j]) / lengths[j])
    if np.linalg.norm(two - one) > (second - first) * 0.99 or not validity.motion(one, two):
        return None
    return np.concatenate((path[: i + 1], one[None], two[None], path[j + 1 :]))
