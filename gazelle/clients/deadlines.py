"""Ends of waits, by the clock of the wall."""

from __future__ import annotations

import math
import time


def deadline_after(seconds: float) -> float:
    """Return the ``time.monotonic()`` [s] at which a wait ends: the past for NaN, which ends it at once."""
    return -math.inf if math.isnan(seconds) else time.monotonic() + seconds
