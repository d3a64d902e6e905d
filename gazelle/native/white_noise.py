# cython: infer_types=True, annotation_typing=False
"""The random numbers of ``gazelle.streams``, drawn in native code.

All is arithmetic that is rounded as IEEE 754 says, with no function of a C library, so that any
processor and any build gives the same bits.
"""

# loops that become vectors

from __future__ import annotations

import math
import struct

import cython
from cython.cimports.libc.math import fabs, floor, sqrt

from gazelle.array_types import Floats, UInts64

GOLDEN = cython.declare(cython.ulonglong, 0x9E3779B97F4A7C15)
MIX_1 = cython.declare(cython.ulonglong, 0xBF58476D1CE4E5B9)
MIX_2 = cython.declare(cython.ulonglong, 0x94D049BB133111EB)
LOW_27 = cython.declare(cython.ulonglong, (1 << 27) - 1)
MANTISSA = cython.declare(cython.ulonglong, (1 << 52) - 1)
ONE = cython.declare(cython.ulonglong, 0x3FF0000000000000)  # 1.0
BIG = cython.declare(cython.ulonglong, 0x4330000000000000)  # 2^52, whose last bit is worth 1
TWO_52 = cython.declare(cython.double, 2.0**52)
LN2 = cython.declare(cython.double, math.log(2.0))
SQRT2 = cython.declare(cython.double, math.sqrt(2.0))
HALF_PI = cython.declare(cython.double, 0.5 * math.pi)
LAST_26 = cython.declare(cython.double, 2.0**-26)
LAST_53 = cython.declare(cython.double, 2.0**-53)
WRAP = 0xFFFFFFFFFFFFFFFF  # Python's integers, where it runs this file, do not wrap around

if not cython.compiled:

    def gazelle_bits(value: float) -> int:
        """Return the bits of a double."""
        return int(struct.unpack("<Q", struct.pack("<d", value))[0])

    def gazelle_double(bits: int) -> float:
        """Return the double that has these bits."""
        return float(struct.unpack("<d", struct.pack("<Q", bits))[0])


def uniform_of(key: int, place: int) -> float:
    """Return the number at a place of a world's stream, in [0, 1)."""
    z = key + (place + 1) * GOLDEN
    if not cython.compiled:
        z = int(z) & WRAP
    z = (z ^ (z >> 30)) * MIX_1
    if not cython.compiled:
        z = z & WRAP
    z = (z ^ (z >> 27)) * MIX_2
    if not cython.compiled:
        z = z & WRAP
    z ^= z >> 31
    # 53 bits in two parts, each put into the last bits of 2^52: processors without AVX-512 turn
    # no 64 bits into a double side by side.
    high = gazelle_double((z >> 38) | BIG) - TWO_52
    low = gazelle_double(((z >> 11) & LOW_27) | BIG) - TWO_52
    drawn: float = high * LAST_26 + low * LAST_53
    return drawn


def fill_normal(key: int, start: int, size: int, drawn: Floats) -> None:
    """Compute the next normal numbers of a world, by Box and Muller's transform.

    The logarithm is by the series of the inverse hyperbolic tangent, to 1e-14: Abramowitz and
    Stegun, 4.1.27. Sines and cosines are by their series about the nearest quarter turn, to 1e-13.
    All is written out, and nothing branches, so that compilers make vectors of the loops.

    Args:
        key: Of the world.
        start: Number of earlier draws.
        size: Number of draws.
        drawn: Comes out, in the first ``size``; room for one more if that is odd.
    """
    pairs = (size + 1) // 2
    for k in range(pairs):
        drawn[k] = uniform_of(key, start + k)
        drawn[pairs + k] = uniform_of(key, start + (pairs + k))
    for k in range(pairs):
        raw = gazelle_bits(1.0 - drawn[k])
        power = gazelle_double((raw >> 52) | BIG) - (TWO_52 + 1023.0)
        m = gazelle_double((raw & MANTISSA) | ONE)
        large = m > SQRT2
        m = 0.5 * m if large else m
        power = power + 1.0 if large else power
        f = (m - 1.0) / (m + 1.0)
        q = f * f
        series = 1.0 / 9.0 + q * (1.0 / 11.0 + q * (1.0 / 13.0 + q * (1.0 / 15.0)))
        series = 1.0 + q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * series)))
        square = -2.0 * (power * LN2 + 2.0 * f * series)
        drawn[k] = sqrt(0.5 * (square + fabs(square)))  # not below 0
    for k in range(pairs):
        radius = drawn[k]
        t = 4.0 * drawn[pairs + k]
        quarter = floor(t + 0.5)
        r = (t - quarter) * HALF_PI
        q = r * r
        sine = 1.0 / 362880.0 + q * (-1.0 / 39916800.0 + q * (1.0 / 6227020800.0))
        sine = -1.0 / 6.0 + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * sine))
        sine = r + r * q * sine
        cosine = -1.0 / 3628800.0 + q * (1.0 / 479001600.0 + q * (-1.0 / 87178291200.0))
        cosine = 1.0 / 24.0 + q * (-1.0 / 720.0 + q * (1.0 / 40320.0 + q * cosine))
        cosine = 1.0 + q * (-0.5 + q * cosine)
        half = floor(0.5 * quarter)  # 0, 1, or 2 for a whole turn
        odd = quarter - 2.0 * half  # 1 where a quarter turn is left
        sign = 1.0 - 2.0 * (half - 2.0 * floor(0.5 * half))
        a = cosine if odd == 0.0 else -sine
        b = sine if odd == 0.0 else cosine
        drawn[k], drawn[pairs + k] = radius * (sign * a), radius * (sign * b)


def draw_uniform(keys: UInts64, counters: UInts64, drawn: Floats) -> None:
    """Draw the next numbers in [0, 1) of some worlds; counters advance.

    Args:
        keys: Of the worlds, shape (n,).
        counters: Number of each one's draws, shape (n,).
        drawn: Comes out, shape (n, size).
    """
    with cython.nogil:
        for w in range(drawn.shape[0]):
            key, start = keys[w], counters[w]
            for k in range(drawn.shape[1]):
                drawn[w, k] = uniform_of(key, start + k)
            counters[w] = start + drawn.shape[1]


def draw_normal(keys: UInts64, counters: UInts64, size: int, drawn: Floats) -> None:
    """Draw the next standard normal numbers of some worlds; counters advance.

    Args:
        keys: Of the worlds, shape (n,).
        counters: Number of each one's draws, shape (n,).
        size: Number of draws of each world.
        drawn: Comes out, shape (n, size), or (n, size + 1) if that is odd.
    """
    with cython.nogil:
        for w in range(drawn.shape[0]):
            fill_normal(keys[w], counters[w], size, drawn[w])
            counters[w] += 2 * ((size + 1) // 2)
