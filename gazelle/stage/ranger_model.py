"""One sensor of a ranger: rows of what all sensors with its beams measure."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.sensors import LaserScan
from gazelle.stage.description import StageSensor


class RangerModel:
    """Measures with one sensor of a ranger of Stage, in every world.

    Noise is that of the scanner, which measures for all of its sensors once a step.

    Args:
        sensor: Settings of the file.
        ranges: Returns current ranges, infinite for a miss, shape (nworld, samples).
    """

    def __init__(self, sensor: StageSensor, ranges: Callable[[], Floats]) -> None:
        self._sensor, self._ranges = sensor, ranges

    @property
    def samples(self) -> int:
        """Rays a measurement has."""
        return self._sensor.samples

    @property
    def rows(self) -> int:
        """Fans of rays above each other: one."""
        return 1

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:  # noqa: ARG002  Stage's noise does not drift
        """Return ranges now [m], shape (n, samples), with the meaning of ``LaserScan.ranges``."""
        ranges = self._ranges()
        return ranges.copy() if worlds is None else ranges[worlds]

    def reading(self, values: Floats, stamp: int) -> LaserScan:
        """Return a measurement as a ``LaserScan``."""
        sensor, half = self._sensor, self._sensor.fov / 2.0
        increment = sensor.fov / max(sensor.samples - 1, 1)
        return LaserScan(stamp, values, -half, half, increment, *sensor.range)

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Do nothing: the fleet's scanners have the random numbers."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Do nothing: the fleet's scanners have the random numbers."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return an empty state: the fleet's scanners have the random numbers."""
        return {}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Do nothing: the fleet's scanners have the random numbers."""
