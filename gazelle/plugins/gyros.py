"""IMUs that drives of many robots ask at every update, measured at once where that can be."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from gazelle.array_types import Floats, Indices
from gazelle.sensors import ImuModel
from gazelle.sensors.imu import ImuGroup
from gazelle.simulation import SensorUnit
from gazelle.simulation.grouping import of_one_kind


class Gyros:
    """IMUs of some robots of one simulation.

    Those that sleep are measured now, others are as they were measured last.

    Args:
        units: A sensor of each robot, with an ``ImuModel``.
        nworld: Number of worlds.

    Attributes:
        values: What they measured, shape (nworld, n, 10); used in place. See ``ImuModel.measure``.
    """

    def __init__(self, units: Sequence[SensorUnit], nworld: int) -> None:
        self._units, self._requests = units, units[0].robot.simulation.requests
        self.values: Floats = np.zeros((nworld, len(units), 10))
        self._groups: list[tuple[Indices, float, ImuGroup]] = []
        self._alone: list[tuple[int, SensorUnit]] = []
        self._sorted = -1

    def measure(self) -> None:
        """Measure."""
        if self._sorted != self._requests.changes:
            self._sort()
        for columns, period, group in self._groups:
            self.values[:, columns] = group.measure_all(period)
        for column, unit in self._alone:
            self.values[:, column] = unit.current()

    def _sort(self) -> None:
        """See who sleeps."""
        self._sorted, units = self._requests.changes, self._units
        self._groups, together = [], set[int]()
        for columns in of_one_kind(range(len(units)), lambda i: _kind(units[i])):
            if len(columns) == 1:
                continue  # a single one is measured faster by itself
            models = [units[i].model for i in columns]
            group = ImuModel.together([each for each in models if isinstance(each, ImuModel)])
            self._groups.append((np.array(columns, np.intp), units[columns[0]].period, group))
            together.update(columns)
        self._alone = [(i, unit) for i, unit in enumerate(units) if i not in together]


def _kind(unit: SensorUnit) -> Hashable | None:
    """Equal for those that are measured together now; None for one that is asked by itself."""
    kind = unit.model.kind() if isinstance(unit.model, ImuModel) and not unit.awake else None
    return None if kind is None else (kind, unit.period)
