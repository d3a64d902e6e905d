"""Lidars of one kind, of many robots in all worlds, measured together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats
from gazelle.engines import Engine, RangeRays
from gazelle.native.system import System
from gazelle.sensors.lidar_ranges import LidarNoise, LidarSystem, RangeLaw, measure

_SHARE = 4000  # ranges that are worth a thread


class LidarGroup:
    """Lidars with the same beams and the same law; one lidar is a group of one.

    Args:
        engine: Casts their rays.
        rays: Rays of each lidar.
        law: Law of the reported ranges.
        begin: Distance of the rays' origins from where ranges are measured [m].
        noise: A row for each world and lidar, those of a world together; used in place.

    Attributes:
        table: Casts the rays.
    """

    def __init__(
        self,
        engine: Engine,
        rays: Sequence[RangeRays],
        law: RangeLaw,
        begin: float,
        noise: LidarNoise,
    ) -> None:
        self._engine, self._law, self._begin, self._noise = engine, law, begin, noise
        self._count, self.table = len(rays), engine.range_table(rays)
        self._system: LidarSystem | None = None
        if self.table.system is not None:
            cast, ranges = self.table.system, self.table.ranges
            offset = begin - self.table.begin
            self._system = LidarSystem(len(rays), cast, ranges, offset, law, noise)
            self._system.least = max(1, _SHARE // ranges.shape[1])

    def measure_all(self, interval: float) -> Floats:  # noqa: ARG002  there are no drifts
        """Measure now on all threads, shape (nworld, n, samples); a new array each time."""
        rows = self.measure_rows()
        return rows.reshape(-1, self._count, rows.shape[1])

    def measure_rows(self) -> Floats:
        """Measure now on all threads, shape (nworld * n, samples); a new array each time."""
        if self._system is not None:
            measured = self._system.renew()
            self._engine.update(self._system)
            return measured
        cast = self.table.cast()
        ranges = np.ascontiguousarray(cast).reshape(-1, cast.shape[2])
        samples = ranges.shape[1]
        whole = np.empty((len(ranges), samples + samples % 2))
        measure(self._law, self._noise, ranges, self._begin - self.table.begin, whole)
        return whole[:, :samples]

    @property
    def kernel(self) -> System | None:
        """System that measures in the step loop; its last measurement is ``latest``."""
        return self._system

    @property
    def latest(self) -> tuple[Floats, NDArray[np.int64]]:
        """The last measurement in turn, shape (nworld, n, samples), and when, (nworld, n) [ns]."""
        if self._system is None:
            raise TypeError("these lidars have no kernel")
        measured, stamp = self._system.latest()
        shape = (-1, self._count, measured.shape[1])
        return measured.reshape(shape), stamp.reshape(shape[:2])
