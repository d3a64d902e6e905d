"""One sensor of a ranger: rows of what all sensors with its beams measure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.sensors import LaserScan

if TYPE_CHECKING:
    from gazelle.simulation.stage.fleet import StageFleet


class RangerModel:
    """Measures with one sensor of a ranger of Stage, in every world.

    Noise is that of the scanner, which measures for all of its sensors once a step.

    Args:
        fleet: All robots.
        robot: Name of the one that carries it.
        ranger: Number of the ranger on that.
        sensor: Number of the sensor on that.
    """

    def __init__(self, fleet: StageFleet, robot: str, ranger: int, sensor: int) -> None:
        self._fleet, self._robot, self._ranger, self._number = fleet, robot, ranger, sensor
        self._sensor = fleet.robot(robot).rangers[ranger].sensors[sensor]

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:  # noqa: ARG002  Stage's noise does not drift
        """Ranges now [m], shape (n, samples), in the meaning of ``LaserScan.ranges``."""
        scanner, place = self._fleet.robot(self._robot).rangers[self._ranger].places[self._number]
        ranges = self._fleet.scan(scanner)[:, place]
        rows = slice(None) if worlds is None else worlds
        found: Floats = np.where(ranges[rows] < self._sensor.range[1], ranges[rows], np.inf)
        return found

    def reading(self, values: Floats, stamp: int) -> LaserScan:
        """A measurement with what is needed to read it."""
        sensor, half = self._sensor, self._sensor.fov / 2.0
        increment = sensor.fov / max(sensor.samples - 1, 1)
        return LaserScan(stamp, values, -half, half, increment, *sensor.range)

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Nothing: the fleet's scanners have the random numbers."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Nothing: likewise."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Nothing: likewise."""
        return {}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Nothing: likewise."""
