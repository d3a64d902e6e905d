"""Default number of threads of engines."""

from __future__ import annotations

import os

VARIABLE = "GAZELLE_NUM_THREADS"


def processors() -> int:
    """Return the number of processors this process may use; ``GAZELLE_NUM_THREADS`` limits it."""
    available = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    choice = os.environ.get(VARIABLE, "")
    return min(available or 1, int(choice)) if choice.isdigit() and int(choice) else available or 1
