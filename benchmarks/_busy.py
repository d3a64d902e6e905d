"""Duration of a measurement, and the load of other programs meanwhile.

A wall time says something only beside what else ran: two trainings on one processor take twice as
long each. So the time of all processors is read where the system tells it, and what is not this
process's own is of others.
"""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field
from pathlib import Path

_STAT = Path("/proc/stat")
_IDLE = (3, 4)  # idle, and waiting for disks
_GUEST = 8  # from here on, what is counted among the first ones already


def busy_seconds() -> float | None:
    """Return the time that all processors worked since start [s]; None where it is unknown."""
    if not _STAT.exists():
        return None
    numbers = [int(word) for word in _STAT.read_text().splitlines()[0].split()[1:]][:_GUEST]
    ticks = sum(number for place, number in enumerate(numbers) if place not in _IDLE)
    return ticks / os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True, slots=True)
class Spent:
    """What something took."""

    wall: float
    """Time that passed [s]."""
    processor: float
    """Time of processors of this process [s]."""
    processors: int
    """How many this process may run on."""
    others: float | None
    """How many of the machine's other programs kept busy; None where the system does not tell."""

    def __str__(self) -> str:
        """Return ``12 s on 2 processors (others kept 0.4 busy), 11 s of processors``."""
        busy = "" if self.others is None else f" (others kept {self.others:.1f} busy)"
        plural = "" if self.processors == 1 else "s"
        where = f"{self.processors} processor{plural}{busy}"
        return f"{self.wall:.0f} s on {where}, {self.processor:.0f} s of processors"


@dataclass(frozen=True, slots=True)
class StopWatch:
    """Runs from when it is made."""

    wall: float = field(default_factory=time.perf_counter)
    own: float = field(default_factory=time.process_time)
    machine: float | None = field(default_factory=busy_seconds)

    def read(self) -> Spent:
        """Return the time spent since the start."""
        wall, own = time.perf_counter() - self.wall, time.process_time() - self.own
        now, others = busy_seconds(), None
        if now is not None and self.machine is not None:
            others = max(0.0, now - self.machine - own) / wall
        return Spent(wall, own, len(os.sched_getaffinity(0)), others)
