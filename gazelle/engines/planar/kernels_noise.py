"""Random numbers that depend on what they are for, not on how many were drawn before.

Each is a hash of a seed, a body, a time and a place, so it is the same at any number of
threads and for any other bodies. The hash is that of SplitMix64: Steele, Lea and Flood,
"Fast splittable pseudorandom number generators", OOPSLA 2014.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.engines.native import kernel, part
from gazelle.engines.planar.columns import REACH
from gazelle.engines.planar.tables import Floats, Indices


@part
def mixed(value: Any) -> Any:
    """64 bits, each of which depends on all of a 64 bit value."""
    value += np.uint64(0x9E3779B97F4A7C15)
    value = (value ^ (value >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    value = (value ^ (value >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return value ^ (value >> np.uint64(31))


@part
def stream(seed: int, body: int, tick: int) -> Any:
    """The beginning of the random numbers of a body at a time."""
    return mixed(mixed(mixed(np.uint64(seed)) ^ np.uint64(body)) ^ np.uint64(tick))


@part
def uniform(start: np.uint64, place: int) -> float:
    """A number in (0, 1]."""
    return float(((mixed(start ^ np.uint64(place)) >> np.uint64(11)) + np.uint64(1)) * 2.0**-53)


@kernel
def blur(
    first: int, last: int, owners: Indices, ranges: Floats, fan: Floats, constant: float,
    share: float, seed: int, tick: int,
) -> None:  # fmt: skip
    """Add noise to the ranges of sensors first to last, but to those that met nothing.

    Normal, of standard deviation ``constant`` [m] plus ``share`` of the range, by Box and
    Muller's transform. What is left stays within 0 and the reach.
    """
    for m in range(first, last):
        start = stream(seed, owners[m], tick)
        for k in range(ranges.shape[1]):
            true = ranges[m, k]
            if true >= fan[REACH]:
                continue
            radius = math.sqrt(-2.0 * math.log(uniform(start, 2 * k)))
            wave = radius * math.cos(2.0 * math.pi * uniform(start, 2 * k + 1))
            noisy = true + (constant + share * true) * wave
            ranges[m, k] = min(max(noisy, 0.0), fan[REACH])
