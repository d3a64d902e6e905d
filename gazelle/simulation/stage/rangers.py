"""All rangers of a running Stage world, each measured once a step at most."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.planar.fleet import Fleet
from gazelle.errors import SimulationError
from gazelle.native.system import System
from gazelle.simulation.stage.layout import Layout
from gazelle.simulation.stage.scans import Eyes, RangeNoise


class Rangers:
    """The scanners of a world: groups of sensors with the same beams, made when first used.

    Args:
        fleet: What they see.
        layout: What scanners there are.
        seed: The run's seed.

    Attributes:
        fans: Beams of each scanner.
        mounts: Where its sensors are.
        noise: Of its sensors.
    """

    def __init__(self, fleet: Fleet, layout: Layout, seed: int) -> None:
        self.fans, self.mounts = layout.fans, layout.mounts
        self.noise = [
            RangeNoise(*np.array(each, np.float64).reshape(-1, 3).T.copy())
            for each in layout.noises
        ]
        self._fleet, self._seed = fleet, seed
        self._eyes: dict[int, Eyes] = {}
        self._seen: dict[int, Floats] = {}

    def scan(self, scanner: int) -> Floats:
        """What all sensors of a scanner measure now [m], shape (nworld, sensors, samples).

        Raises:
            SimulationError: There is no such scanner.
        """
        if scanner not in self._seen:
            self._seen[scanner] = self._eye(scanner).scan()
        return self._seen[scanner]

    def system(self, scanner: int) -> tuple[System, Floats] | None:
        """What scans in native code, and where it writes, a row a sensor; None if that is not all.

        Raises:
            SimulationError: There is no such scanner.
        """
        eye = self._eye(scanner)
        system = eye.system()
        return None if system is None else (system, eye.flat_ranges)

    def returns(self, scanner: int, place: int, world: int) -> Floats:
        """``ranger_return`` of what each beam of a sensor meets now; 0 for nothing.

        Raises:
            SimulationError: There is no such scanner.
        """
        self.scan(scanner)
        return self._eye(scanner).returns(place, world)

    def forget(self) -> None:
        """Something moved: what was seen is seen no longer."""
        self._seen.clear()

    def rewind(self) -> None:
        """Draw the same random numbers again."""
        for eye in self._eyes.values():
            eye.rewind()

    def _eye(self, scanner: int) -> Eyes:
        if not 0 <= scanner < len(self.fans):
            raise SimulationError(f"there is no scanner {scanner}; there are {len(self.fans)}")
        if scanner not in self._eyes:
            self._eyes[scanner] = Eyes(
                self._fleet,
                self.fans[scanner],
                self.mounts[scanner],
                self.noise[scanner],
                seed=self._seed,
                name=f"ranger/{scanner}",
            )
        return self._eyes[scanner]
