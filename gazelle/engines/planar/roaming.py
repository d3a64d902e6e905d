"""Let all robots of a fleet roam about by themselves, at native speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.engines.native import Call, Tape
from gazelle.engines.planar import kernels_roam
from gazelle.engines.planar.fans import Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.kernels_clock import tally

_SHARE = 4096  # bodies that are worth a thread


@dataclass(frozen=True, slots=True)
class Manner:
    """How to roam.

    Attributes:
        cruise: Speed ahead [m/s].
        turning: Fastest turn [rad/s].
        shy: Distance at which to turn away from something [m].
        keep: Seconds for which a turn is kept.
        back: Seconds for which to back off from what stopped it.
    """

    cruise: float = 0.4
    turning: float = 1.0
    shy: float = 0.6
    keep: float = 1.0
    back: float = 1.0


class Roaming:
    """A controller for all bodies of a fleet that have a drive.

    Args:
        fleet: What it drives.
        scanner: Ranges that it looks at, one sensor a body at most; None to drive blind.
        manner: How.
        seed: Of its turns.
    """

    def __init__(
        self,
        fleet: Fleet,
        scanner: Scanner | None = None,
        manner: Manner | None = None,
        seed: int = 0,
    ) -> None:
        manner = manner or Manner()
        self.fleet, self.scanner, self.seed = fleet, scanner, seed
        steps = (manner.keep / fleet.time_step, manner.back / fleet.time_step)
        self._manner = np.array([manner.cruise, manner.turning, manner.shy, *np.round(steps)])
        total = fleet.nworld * fleet.nbody
        self._clock = np.zeros(1, np.int64)
        self._mood = np.zeros((total, 2), np.int64)
        self._sensor = np.full(total, -1, np.int64)
        self._ranges = np.zeros((0, 1))
        self._tape = Tape()
        if scanner is not None:
            self._sensor[scanner.owners] = np.arange(len(scanner.owners))
            self._ranges = scanner.flat_ranges
            scanner.scan()

    def run(self, count: int) -> None:
        """Make steps, and scan after each."""
        look = None if self.scanner is None else self.scanner.call()
        if self.fleet.alone and (look is not None or self.scanner is None):
            calls = [*self.calls(), self.fleet.call()]
            self._tape.play(calls if look is None else [*calls, look], count)
            return
        for _ in range(count):
            self.choose()
            self.fleet.step()
            if self.scanner is not None:
                self.scanner.scan()

    def calls(self) -> list[Call]:
        """What ``choose`` does where one thread does all."""
        return [
            (kernels_roam.roam, (0, len(self._mood), *self._choosing())),
            (tally, (self._clock,)),
        ]

    def choose(self) -> None:
        """Choose the commands of all bodies."""
        own = self._choosing()
        self.fleet.crew.share(
            lambda a, b, _: kernels_roam.roam(a, b, *own), len(self._mood), _SHARE
        )
        tally(self._clock)

    def _choosing(self) -> tuple[Any, ...]:
        """What ``roam`` takes after the range of bodies."""
        fleet = self.fleet
        return (
            self._manner, self.seed, self._clock, self._sensor, self._ranges,
            fleet.command.reshape(-1, 3), fleet.stalled.reshape(-1), self._mood,
        )  # fmt: skip
