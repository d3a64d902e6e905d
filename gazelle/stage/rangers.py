"""All rangers of a running Stage world, each measured once a step at most."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.planar import Fan, Fleet, Mount
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.sensors.lidar_ranges import infinite_from
from gazelle.stage.scans import RangerScanner, StageRangeNoise
from gazelle.streams import Stream


class Rangers:
    """The scanners of a world: groups of sensors with the same beams, made when first used.

    Args:
        fleet: Fleet.
        fans: Beams of each scanner.
        mounts: Mounts of its sensors.
        noises: Of its sensors: standard deviation [m], largest share of the distance, and
            standard deviation of angles [rad].
        seed: The run's seed.

    Attributes:
        fans: Beams of each scanner.
        mounts: Mounts of its sensors.
        noise: Of its sensors.
    """

    def __init__(
        self,
        fleet: Fleet,
        fans: list[Fan],
        mounts: list[list[Mount]],
        noises: list[list[tuple[float, float, float]]],
        seed: int,
    ) -> None:
        self.fans, self.mounts = fans, mounts
        self.noise = [
            StageRangeNoise(*np.array(each, np.float64).reshape(-1, 3).T.copy()) for each in noises
        ]
        self._fleet, self._seed = fleet, seed
        self._streams = [
            Stream(seed, f"ranger/{scanner}", fleet.nworld) for scanner in range(len(self.fans))
        ]
        self._made: dict[int, RangerScanner] = {}
        self._seen: dict[int, Floats] = {}
        self._changes = -1

    def scan(self, scanner: int) -> Floats:
        """Return the present ranges of all sensors of a scanner [m], shape (nworld, sensors, samples).

        Raises:
            SimulationError: There is no such scanner.
        """
        if self._changes != self._fleet.changes:  # something moved
            self._changes = self._fleet.changes
            self._seen.clear()
        if scanner not in self._seen:
            self._seen[scanner] = self._scanner(scanner).scan()
        return self._seen[scanner]

    def readings(self, scanner: int, places: int | slice | Sequence[int]) -> Floats:
        """Return ranges of some sensors as of ``LaserScan``: a new array, infinite for a miss.

        Args:
            scanner: Scanner.
            places: Its sensors; of one the axis of sensors is left out.

        Raises:
            SimulationError: There is no such scanner.
        """
        return infinite_from(self.fans[scanner].reach, self.scan(scanner)[:, places])

    def system(self, scanner: int) -> tuple[System, Floats] | None:
        """Return the native scan system and its output, a row a sensor; None if Python takes part.

        Raises:
            SimulationError: There is no such scanner.
        """
        made = self._scanner(scanner)
        system = made.system()
        return None if system is None else (system, made.flat_ranges)

    def returns(self, scanner: int, place: int, world: int) -> Floats:
        """Return ``ranger_return`` of what each beam of a sensor meets now; 0 for nothing.

        Raises:
            SimulationError: There is no such scanner.
        """
        self.scan(scanner)
        return self._scanner(scanner).returns(place, world)

    def rewind(self) -> None:
        """Restart the random numbers."""
        self._seen.clear()
        for stream in self._streams:
            stream.rewind()
        for made in self._made.values():
            made.tick = 0

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers."""
        if worlds is None:
            self._seed = seed
            self._made.clear()
        self._seen.clear()
        for stream in self._streams:
            stream.reseed(seed, worlds)

    def copy_from(self, other: Rangers) -> None:
        """Copy the random numbers' state of others."""
        for own, old in zip(self._streams, other._streams, strict=False):
            own.keys[:], own.counters[:] = old.keys, old.counters
        for number, made in other._made.items():
            if number < len(self.fans):
                self._scanner(number).tick = made.tick

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        ticks = [self._made[k].tick if k in self._made else 0 for k in range(len(self.fans))]
        streams = self._streams
        return {
            "keys": np.array([each.keys for each in streams], np.uint64),
            "counters": np.array([each.counters for each in streams], np.uint64),
            "ticks": np.array(ticks, np.int64),
        }

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._seen.clear()
        parts = (self._streams, state["keys"], state["counters"], state["ticks"])
        for number, (stream, keys, counters, tick) in enumerate(zip(*parts, strict=True)):
            stream.keys[:], stream.counters[:] = keys, counters
            if int(tick) or number in self._made:
                self._scanner(number).tick = int(tick)

    def _scanner(self, number: int) -> RangerScanner:
        if not 0 <= number < len(self.fans):
            raise SimulationError(f"there is no scanner {number}; there are {len(self.fans)}")
        if number not in self._made:
            self._made[number] = RangerScanner(
                self._fleet,
                self.fans[number],
                self.mounts[number],
                self.noise[number],
                self._streams[number],
                seed=self._seed,
            )
        return self._made[number]
