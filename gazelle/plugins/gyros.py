"""IMUs of many robots, measured at once where their engine can."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import cast

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.sensors import ImuModel
from gazelle.sensors.imu import ImuGroup
from gazelle.simulation import SensorUnit
from gazelle.simulation.grouping import of_one_kind


class ImuArray:
    """Some IMUs of one simulation, a column each; their noise is in tables of all from then on.

    Args:
        models: At least one.
        periods: Of each, the time between two measurements [s].
    """

    def __init__(self, models: Sequence[ImuModel], periods: Sequence[float]) -> None:
        self.models = list(models)
        self._nworld = models[0].engine.nworld
        self._groups: list[tuple[Indices, float, ImuGroup]] = []
        self._alone = list(enumerate(zip(models, periods, strict=True)))

        def system(column: int) -> Hashable:
            return models[column].system(), periods[column]

        for columns in of_one_kind(range(len(models)), system):
            if len(columns) == 1:
                continue  # a single one is measured faster by itself
            group = ImuGroup([models[i] for i in columns])
            self._groups.append((np.array(columns, np.intp), periods[columns[0]], group))
            self._alone = [each for each in self._alone if each[0] not in columns]

    def measure(self) -> Floats:
        """Measure now, shape (nworld, n, 10); see ``ImuModel.measure``."""
        values = np.zeros((self._nworld, len(self.models), 10))
        for columns, period, group in self._groups:
            values[:, columns] = group.measure_all(period)
        for column, (model, period) in self._alone:
            values[:, column] = model.measure(None, period)
        return values


class Gyros:
    """IMU sensors of some robots of one simulation, which their drives read at every update.

    Those that sleep are measured now, others are as they were measured last.

    Args:
        units: A sensor of each robot, with an ``ImuModel``.
        nworld: Number of worlds.

    Attributes:
        values: Measurements, shape (nworld, n, 10); used in place. See ``ImuModel.measure``.
    """

    def __init__(self, units: Sequence[SensorUnit], nworld: int) -> None:
        self._units, self._lock = units, units[0].robot.simulation.lock
        self.values: Floats = np.zeros((nworld, len(units), 10))
        self._asleep: tuple[Indices, ImuArray] | None = None
        self._awake: list[tuple[int, SensorUnit]] = []
        self._sorted = -1

    def measure(self) -> None:
        """Measure."""
        if self._sorted != self._lock.changes:
            self._sort()
        if self._asleep is not None:
            columns, array = self._asleep
            self.values[:, columns] = array.measure()
        for column, unit in self._awake:
            self.values[:, column] = unit.current()

    def _sort(self) -> None:
        """Update which gyros sleep."""
        self._sorted = self._lock.changes
        self._awake = [(i, unit) for i, unit in enumerate(self._units) if unit.awake]
        asleep = [(i, unit) for i, unit in enumerate(self._units) if not unit.awake]
        self._asleep = None
        if asleep:
            models = [cast("ImuModel", unit.model) for _, unit in asleep]
            array = ImuArray(models, [unit.period for _, unit in asleep])
            self._asleep = np.array([i for i, _ in asleep], np.intp), array
