"""One sensor of a ranger: rows of what all sensors with its beams measure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.native.rows import first_of_run
from gazelle.sensors import LaserScan
from gazelle.sensors.model import PythonSensors, SystemMaker
from gazelle.stage.fleet import StageFleet


class RangerModel:
    """Measures with one sensor of a ranger of Stage, in every world.

    Noise is that of the scanner, which measures for all of its sensors once a step.

    Args:
        fleet: All robots.
        name: Name of its robot.
        which: Index of the ranger on the robot.
        number: Index of the sensor in the ranger.

    Attributes:
        by_system: No: Python measures many in one call.
    """

    by_system = False

    def __init__(self, fleet: StageFleet, name: str, which: int, number: int) -> None:
        self.fleet = fleet
        self._owner = name, which, number
        sensor = fleet.robot(name).rangers[which].sensors[number]
        self.samples, half = sensor.samples, sensor.fov / 2.0
        increment = sensor.fov / max(sensor.samples - 1, 1)
        self._shape = -half, half, increment, *sensor.range
        self._revision, self._place = -1, (0, 0)

    @property
    def rows(self) -> int:
        """Fans of rays above each other: one."""
        return 1

    @property
    def place(self) -> tuple[int, int]:
        """The index of its scanner, and its row in that."""
        if self._revision != self.fleet.engine.revision:  # other models may have come or gone
            name, which, number = self._owner
            self._place = self.fleet.named[name].rangers[which].places[number]
            self._revision = self.fleet.engine.revision
        return self._place

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:  # noqa: ARG002  Stage's noise does not drift
        """Return ranges now [m], shape (n, samples), with the meaning of ``LaserScan.ranges``."""
        ranges = self.fleet.rangers.readings(*self.place)
        return ranges if worlds is None else ranges[worlds]

    def system(self) -> SystemMaker:
        """Return what measures it with the other sensors of its scanner."""
        return SystemMaker(RangerGroup, self.place[0])

    def reading(self, values: Floats, stamp: int) -> LaserScan:
        """Return a measurement as a ``LaserScan``."""
        return LaserScan(stamp, values, *self._shape)

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Do nothing: the fleet's scanners have the random numbers."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Do nothing: the fleet's scanners have the random numbers."""

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return an empty state: the fleet's scanners have the random numbers."""
        return {}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Do nothing: the fleet's scanners have the random numbers."""


class RangerGroup(PythonSensors):
    """Sensors of one scanner, of many robots.

    Args:
        models: Of the sensors.
    """

    def __init__(self, models: Sequence[RangerModel]) -> None:
        self._fleet, self._scanner = models[0].fleet, models[0].place[0]
        rows = [each.place[1] for each in models]
        first = first_of_run(rows)
        self._rows = rows if first < 0 else slice(first, first + len(rows))  # without a copy

    def measure_all(self, interval: float) -> Floats:  # noqa: ARG002  Stage's noise does not drift
        """Measure now, shape (nworld, n, samples); see ``RangerModel.measure``."""
        return self._fleet.rangers.readings(self._scanner, self._rows)
