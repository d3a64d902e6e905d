# cython: infer_types=True, annotation_typing=False
"""Random numbers that depend on what they are for, not on how many were drawn before.

Each is a hash of a seed, a body, a time and a place, so it is the same at any number of
threads and for any other bodies. The hash is that of SplitMix64: Steele, Lea and Flood,
"Fast splittable pseudorandom number generators", OOPSLA 2014.
"""

from __future__ import annotations

import cython
from cython.cimports.gazelle.native.elementary import cos, log
from cython.cimports.libc.math import sqrt

PI = cython.declare(cython.double, 3.141592653589793)
GOLDEN = cython.declare(cython.ulonglong, 0x9E3779B97F4A7C15)
MIX_1 = cython.declare(cython.ulonglong, 0xBF58476D1CE4E5B9)
MIX_2 = cython.declare(cython.ulonglong, 0x94D049BB133111EB)
LAST_53 = cython.declare(cython.double, 2.0**-53)


def mixed(value: int) -> int:
    """Return 64 bits, each of which depends on all of a 64 bit value."""
    value += GOLDEN
    value = (value ^ (value >> 30)) * MIX_1
    value = (value ^ (value >> 27)) * MIX_2
    return value ^ (value >> 31)


def stream(seed: int, body: int, tick: int) -> int:
    """Return the start of the random numbers of a body at a time."""
    start = mixed(cython.cast(cython.ulonglong, seed))
    start = mixed(start ^ cython.cast(cython.ulonglong, body))
    return mixed(start ^ cython.cast(cython.ulonglong, tick))


def uniform(start: int, place: int) -> float:
    """Return a number in (0, 1]."""
    drawn: float = cython.cast(cython.double, (mixed(start ^ place) >> 11) + 1) * LAST_53
    return drawn


def normal(start: int, place: int) -> float:
    """Return a standard normal number, by Box and Muller's transform; it takes two places."""
    radius = sqrt(-2.0 * log(uniform(start, place)))
    wave: float = radius * cos(2.0 * PI * uniform(start, place + 1))
    return wave
