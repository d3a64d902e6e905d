"""Fleets of robots that roam by themselves, at native speed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.engines.planar.fans import Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.roaming_law import RoamingLaw
from gazelle.native.loop import SystemLoop


@dataclass(frozen=True, slots=True)
class RoamingSettings:
    """Parameters of roaming.

    Attributes:
        cruise: Speed ahead [m/s].
        turning: Fastest turn [rad/s].
        avoid_distance: Distance at which to turn away from something [m].
        keep: Seconds for which a turn is kept.
        back: Seconds for which to back off from what stopped it.
    """

    cruise: float = 0.4
    turning: float = 1.0
    avoid_distance: float = 0.6
    keep: float = 1.0
    back: float = 1.0


class Roaming:
    """A controller for all bodies of a fleet that have a drive.

    Args:
        fleet: Fleet to drive.
        scanner: Ranges that it looks at, one sensor a body at most; None to drive blind.
        settings: Parameters of its motion.
        seed: Of its turns.

    Attributes:
        law: Chooses commands, as a system.
    """

    def __init__(
        self,
        fleet: Fleet,
        scanner: Scanner | None = None,
        settings: RoamingSettings | None = None,
        seed: int = 0,
    ) -> None:
        settings = settings or RoamingSettings()
        self.fleet, self.scanner = fleet, scanner
        total = fleet.nworld * fleet.nbody
        sensor, ranges = np.full(total, -1, np.int64), np.zeros((0, 1))
        if scanner is not None:
            sensor[scanner.owners] = np.arange(len(scanner.owners))
            ranges = scanner.flat_ranges
            scanner.scan()
        self.law = RoamingLaw(
            fleet.bodies,
            ranges,
            sensor,
            np.zeros((total, 2), np.int64),
            seed=seed,
            cruise=settings.cruise,
            turning=settings.turning,
            avoid_distance=settings.avoid_distance,
            keep=round(settings.keep / fleet.time_step),
            back=round(settings.back / fleet.time_step),
        )
        looking = [] if scanner is None or not len(scanner.owners) else [scanner.system]
        self._loop = SystemLoop(
            [self.law, *fleet.systems(), *looking], fleet.nworld, 1, fleet.pool, 1
        )

    def run(self, count: int) -> None:
        """Advance by steps, and scan after each."""
        self._loop.run(self._loop.time + count, self.fleet.threads)
