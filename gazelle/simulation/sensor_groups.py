"""Sensors of one kind of many robots, measured together."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Hashable, Sequence
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.native.system import System
from gazelle.sensors.lidar_group import LidarGroup
from gazelle.sensors.model import MeasuredTogether
from gazelle.simulation.clock import Schedule
from gazelle.simulation.grouping import of_one_kind, with_replacements


class GroupedUnit(Protocol):
    """A sensor of a robot that may be measured with others; see ``SensorUnit``."""

    schedule: Schedule

    @property
    def model(self) -> Any:
        """Measures it."""

    @property
    def heard(self) -> bool:
        """Whether anybody subscribed."""

    @property
    def period(self) -> float:
        """Time between two measurements in turn [s]."""

    def kind(self) -> Hashable | None:
        """Equal for those that are measured together now; None for none."""

    def join(self, group: SensorGroup, part: int) -> None:
        """Be measured by a group."""

    def leave(self) -> None:
        """Be measured by itself again."""

    def tell(self) -> None:
        """Call all who subscribed."""


U = TypeVar("U", bound=GroupedUnit)


class SensorGroup(ABC):
    """Sensors whose readings are rows of one table.

    Args:
        units: They are awake, due at one time and of one ``SensorUnit.kind``.

    Attributes:
        units: The sensors.
        schedule: Of all of them.
        count: Measurements so far.
    """

    def __init__(self, units: Sequence[GroupedUnit]) -> None:
        self.units, self.count = units, 0
        self.schedule: Schedule = units[0].schedule.copy()
        for part, unit in enumerate(units):
            unit.join(self, part)

    @abstractmethod
    def reading(self, part: int) -> tuple[NDArray[Any], int]:
        """The last measurement of a sensor, shape (nworld, channels), and when [ns]."""

    def release(self) -> None:
        """Let each be measured by itself again."""
        for unit in self.units:
            unit.leave()


class NativeGroup(SensorGroup):
    """Sensors that nobody listens to in Python: a system measures them between steps.

    Args:
        units: As above.
    """

    def __init__(self, units: Sequence[GroupedUnit]) -> None:
        super().__init__(units)
        self._measured: LidarGroup = _together(units)
        system = self._measured.system
        system.late, system.rate, system.due = True, self.schedule.rate, self.schedule.due_ns

    @property
    def system(self) -> System:
        """What measures."""
        return self._measured.system

    def follow(self) -> None:
        """See whether the system has measured."""
        due = self.system.due
        if due != self.schedule.due_ns or self.schedule.rate <= 0.0:
            self.schedule.follow(due)
            self.count += 1

    def reading(self, part: int) -> tuple[NDArray[Any], int]:
        """The last measurement of a sensor, a copy of shape (nworld, channels), and when [ns]."""
        values, stamp = self._measured.latest
        return np.ascontiguousarray(values[:, part]), int(stamp[0, part])


class PythonGroup(SensorGroup):
    """Sensors that Python measures at once when they are due, and tells then who listens.

    It takes the place of its sensors among those that ``update_sensors`` asks.

    Args:
        units: As above.
    """

    awake = True

    def __init__(self, units: Sequence[GroupedUnit]) -> None:
        super().__init__(units)
        self._measured: MeasuredTogether = _together(units)
        self._heard = [unit for unit in units if unit.heard]
        self._interval = units[0].period
        self._values: NDArray[Any] = np.zeros(0)
        self._stamp = 0

    def update(self, now_ns: int) -> None:
        """Measure, and tell who listens."""
        self._values, self._stamp = self._measured.measure_all(self._interval), now_ns
        self.count += 1
        self.schedule.done(now_ns)
        for unit in self._heard:
            unit.tell()

    def reading(self, part: int) -> tuple[NDArray[Any], int]:
        """The last measurement of a sensor, shape (nworld, channels), and when [ns]."""
        return np.ascontiguousarray(self._values[:, part]), self._stamp


def group_sensors(
    units: Sequence[U], *, native: bool
) -> tuple[list[U | PythonGroup], list[NativeGroup]]:
    """What Python measures when it is due, in order, and what systems measure.

    Args:
        units: All that are awake.
        native: Whether systems may measure those that nobody listens to.
    """
    systems = list[NativeGroup]()
    places: list[tuple[list[U], PythonGroup | None]] = []
    for some in of_one_kind(units, _measured_with):
        if _by_system(some[0]):
            if native and not some[0].heard:
                systems.append(NativeGroup(some))
                places.append((some, None))
        elif len(some) > 1:
            places.append((some, PythonGroup(some)))
    return with_replacements(units, places), systems


def _measured_with(unit: GroupedUnit) -> Hashable | None:
    """Equal for sensors that are measured together; None for one that is measured alone."""
    kind = unit.kind()
    return None if kind is None else (kind, unit.heard and _by_system(unit))


def _together(units: Sequence[GroupedUnit]) -> Any:
    """What measures sensors of one kind together."""
    models = [unit.model for unit in units]
    return type(models[0]).together(models)


def _by_system(unit: GroupedUnit) -> bool:
    return bool(unit.model.by_system)
