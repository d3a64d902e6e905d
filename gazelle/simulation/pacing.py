"""Keep simulated time to wall time."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

from gazelle.errors import SimulationError
from gazelle.simulation.inputs import number

# Simulated time between two looks at the wall clock [s].
_SLICE = 0.02


def run_paced(advance: Callable[[float], None], seconds: float, rate: float | None) -> None:
    """Advance by simulated seconds, at ``rate`` simulated seconds a wall second at most.

    Args:
        advance: Steps by simulated seconds.
        seconds: How long in all [s].
        rate: Real-time factor to keep to; None means as fast as possible.

    Raises:
        SimulationError: No such pace can be kept to.
    """
    if rate is None:
        advance(seconds)
        return
    if not 0.0 < number("a real-time factor", rate) < math.inf:
        raise SimulationError(
            f"a real-time factor must be positive and finite, not {rate!r}",
            hint="leave it out to run as fast as possible",
        )
    start = time.monotonic()
    done = 0.0
    while done < seconds - 1e-12:
        piece = min(_SLICE, seconds - done)
        advance(piece)
        done += piece
        ahead = done / rate - (time.monotonic() - start)
        if ahead > 0.0:
            time.sleep(ahead)
