"""Sensors of one kind of many robots, measured at once."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.sensors.model import SensorSystem
from gazelle.simulation.clock import Schedule
from gazelle.simulation.grouping import of_one_kind, with_replacements


class GroupedUnit(Protocol):
    """A sensor of a robot that may be measured with others; see ``SensorUnit``."""

    schedule: Schedule

    @property
    def model(self) -> Any:
        """Measures it."""

    @property
    def has_subscribers(self) -> bool:
        """True if there are subscribers."""

    @property
    def period(self) -> float:
        """Time between two measurements in turn [s]."""

    def system(self) -> Hashable | None:
        """Return a key that is equal for sensors of one system; None for a single one."""

    def join(self, group: SensorGroup, part: int) -> None:
        """Join a group that measures together."""

    def leave(self) -> None:
        """Leave the group and measure alone again."""

    def notify(self) -> None:
        """Call all subscribers."""


U = TypeVar("U", bound=GroupedUnit)


class SensorGroup:
    """Sensors with readings as rows of one table, measured at once.

    Without subscribers, a kernel measures them within the engine's steps, if their models
    have one; else Python measures them when they are due, and calls the subscribers. It takes the
    place of its sensors among those that ``update_sensors`` measures.

    Args:
        units: Active units, due at one time and of one ``SensorUnit.system``.
        native: Whether the engine may update a kernel.

    Attributes:
        units: The sensors.
        schedule: Of all of them.
        count: Measurements so far.
        kernel: System that the engine updates in its steps; None where Python measures.
    """

    awake = True

    def __init__(self, units: Sequence[GroupedUnit], *, native: bool) -> None:
        self.units, self.count = units, 0
        self.schedule: Schedule = units[0].schedule.copy()
        for part, unit in enumerate(units):
            unit.join(self, part)
        models = [unit.model for unit in units]
        self._measured: SensorSystem = models[0].system().make(models)
        self._subscribed = [unit for unit in units if unit.has_subscribers]
        self._interval = units[0].period
        self._values: NDArray[Any] = np.zeros(0)
        self._stamp = 0
        self.kernel = self._measured.kernel if native and not self._subscribed else None
        if self.kernel is not None:
            self.kernel.late, self.kernel.rate = True, self.schedule.rate
            self.kernel.due = self.schedule.due_ns

    def update(self, now_ns: int) -> None:
        """Measure, and call all subscribers."""
        self._values, self._stamp = self._measured.measure_all(self._interval), now_ns
        self.count += 1
        self.schedule.done(now_ns)
        for unit in self._subscribed:
            unit.notify()

    def follow(self) -> None:
        """Check whether the kernel has measured."""
        due = 0 if self.kernel is None else self.kernel.due
        if due != self.schedule.due_ns or self.schedule.rate <= 0.0:
            self.schedule.follow(due)
            self.count += 1

    def reading(self, part: int) -> tuple[NDArray[Any], int]:
        """Return the last measurement of a sensor, shape (nworld, channels), and when [ns]."""
        if self.kernel is None:
            return np.ascontiguousarray(self._values[:, part]), self._stamp
        values, stamp = self._measured.latest
        return values[:, part].copy(), int(stamp[0, part])

    def release(self) -> None:
        """Return all sensors to measuring alone."""
        for unit in self.units:
            unit.leave()


def group_sensors(
    units: Sequence[U], *, native: bool
) -> tuple[list[U | SensorGroup], list[SensorGroup]]:
    """Return what Python measures when it is due, in order, and what kernels measure.

    Args:
        units: All that are awake.
        native: Whether kernels may measure those without subscribers.
    """
    kernels = list[SensorGroup]()
    places: list[tuple[list[U], SensorGroup | None]] = []
    for some in of_one_kind(units, _measured_with):
        if len(some) == 1 and not some[0].model.by_system:
            continue  # a single one is measured faster by itself
        group = SensorGroup(some, native=native)
        if group.kernel is not None:
            kernels.append(group)
        places.append((some, None if group.kernel is not None else group))
    return with_replacements(units, places), kernels


def _measured_with(unit: GroupedUnit) -> Hashable | None:
    """Return a key that is equal for sensors measured together; None for a single one."""
    system = unit.system()
    return None if system is None else (system, unit.has_subscribers and bool(unit.model.by_system))
