"""Limits of what a bag can hold."""

from __future__ import annotations

import math

from gazelle_ros.bags.compression import KINDS
from gazelle_ros.clock import SECOND

END_OF_TIME = 2**32 * SECOND
"""Seconds of a time are unsigned ints of 32 bits [ns]."""


def check_time(stamp: int) -> None:
    """Check that a bag can hold a time [ns].

    Raises:
        ValueError: It is negative, or does not fit into 32 bits of seconds.
    """
    if not 0 <= stamp < END_OF_TIME:
        raise ValueError("t is invalid: its seconds are negative, or do not fit into 32 bits")


def check_compression(kind: str) -> None:
    """Check that there is a compression of this name.

    Raises:
        ValueError: There is none.
    """
    if kind not in KINDS:
        raise ValueError(f"compression must be one of: {', '.join(KINDS)}")


def chunk_bytes_of(threshold: float) -> int:
    """Return the size of chunks as an int.

    Raises:
        ValueError: It is less than zero, or no finite number.
    """
    if not 0 <= threshold < math.inf:
        raise ValueError("chunk_threshold must be greater than or equal to zero")
    return int(threshold)
