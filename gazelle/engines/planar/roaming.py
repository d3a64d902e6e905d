"""Let all robots of a fleet roam about by themselves, at native speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.engines.planar import kernels_roam
from gazelle.engines.planar.fans import Fan, Scanner
from gazelle.engines.planar.fleet import Fleet

_SMALL = 128  # bodies up to which one thread does all


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
        self.fleet, self.scanner, self.seed, self.tick = fleet, scanner, seed, 0
        steps = (manner.keep / fleet.time_step, manner.back / fleet.time_step)
        self._manner = np.array([manner.cruise, manner.turning, manner.shy, *np.round(steps)])
        total = fleet.nworld * fleet.nbody
        self._mood = np.zeros((total, 2), np.int64)
        self._sensor = np.full(total, -1, np.int64)
        self._eye = scanner or Scanner(fleet, Fan(0.0, 1.0, 1, 1.0), [])
        self._sensor[self._eye.owners] = np.arange(len(self._eye.owners))
        if scanner is not None:
            scanner.scan()

    def run(self, count: int) -> None:
        """Make steps, and scan after each."""
        fleet = self.fleet
        alone = fleet.crew.size == 1 or fleet.nworld * fleet.nbody <= _SMALL
        if alone and self._eye.noise is None:
            self._run_small(count)
        else:
            for now in range(count):
                self._choose(self.tick + now)
                fleet.step()
                if self.scanner is not None:
                    self.scanner.scan()
        self.tick += count

    def _choose(self, tick: int) -> None:
        fleet, eye = self.fleet, self._eye
        command, stalled = fleet.command.reshape(-1, 3), fleet.stalled.reshape(-1)
        fleet.crew.share(
            lambda a, b, _: kernels_roam.roam(
                a, b, self._manner, self.seed, tick, self._sensor, eye.flat_ranges, command,
                stalled, self._mood,
            ),
            len(command),
            4096,
        )  # fmt: skip

    def _run_small(self, count: int) -> None:
        head, tail = self.fleet.arguments(), self._eye.arguments(0)
        kernels_roam.rounds(
            count, self._manner, self.seed, self.tick, self._sensor, self._mood, *head,
            self.fleet.looks, *tail, self._eye.flat_ranges, self._eye.names,
        )  # fmt: skip
