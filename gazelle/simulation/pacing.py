"""Keep simulated time to wall time."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from gazelle.errors import SimulationError
from gazelle.simulation.inputs import number

# Simulated time between two looks at the wall clock [s].
_SLICE = 0.02

SLOWEST = 1e-6
"""Least real-time factor: a step of a millisecond takes a quarter of an hour."""


def run_paced(advance: Callable[[int], None], count: int, step: float, rate: float) -> None:
    """Advance by steps, at ``rate`` simulated seconds a wall second at most.

    Args:
        advance: Makes steps.
        count: Total number.
        step: Of simulated time [s].
        rate: Real-time factor to keep to.

    Raises:
        SimulationError: No such pace can be kept to.
    """
    if not SLOWEST <= number("a real-time factor", rate) < math.inf:
        raise SimulationError(
            f"a real-time factor must be finite and at least {SLOWEST:g}, not {rate!r}",
            hint="leave it out to run as fast as possible",
        )
    start, done, most = time.monotonic(), 0, max(1, int(_SLICE / step))
    while done < count:
        piece = min(most, count - done)
        advance(piece)
        done += piece
        ahead = done * step / rate - (time.monotonic() - start)
        if ahead > 0.0:
            time.sleep(ahead)
