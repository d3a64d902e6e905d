"""Keep simulated time to wall time."""

from __future__ import annotations

import time
from collections.abc import Callable

# Simulated time between two looks at the wall clock [s].
_SLICE = 0.02


def run_paced(advance: Callable[[float], None], seconds: float, rate: float | None) -> None:
    """Advance by simulated seconds, at ``rate`` simulated seconds a wall second at most.

    Args:
        advance: Steps by simulated seconds.
        seconds: How long in all [s].
        rate: Real-time factor to keep to; None means as fast as possible.
    """
    if rate is None:
        advance(seconds)
        return
    start = time.monotonic()
    done = 0.0
    while done < seconds - 1e-12:
        piece = min(_SLICE, seconds - done)
        advance(piece)
        done += piece
        ahead = done / rate - (time.monotonic() - start)
        if ahead > 0.0:
            time.sleep(ahead)
