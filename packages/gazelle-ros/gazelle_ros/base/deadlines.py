"""Ends of waits, by the clock of the wall."""

from __future__ import annotations

import time

LONGEST_WAIT = 1e9
"""Three decades [s]: threads and sockets cannot wait for centuries."""


def wait_of(seconds: float) -> float:
    """Return how long a wait is [s], from 0 to ``LONGEST_WAIT``: 0 for NaN."""
    return max(0.0, min(seconds, LONGEST_WAIT))


def deadline_after(seconds: float) -> float:
    """Return the ``time.monotonic()`` [s] at which a wait ends: now for NaN, which ends it at once."""
    return time.monotonic() + wait_of(seconds)
