"""Lidars of one kind, of many robots in all worlds, measured together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, UInts64
from gazelle.engines import RangeRays, SystemEngine, TableEngine
from gazelle.native.system import System
from gazelle.sensors.lidar_ranges import LidarNoise, LidarSystem, RangeLaw, measure
from gazelle.sensors.model import FromPython

_SHARE = 2000  # ranges that are worth a thread


class LidarGroup:
    """Lidars with the same beams and the same law.

    Args:
        engine: Casts their rays.
        rays: Of each.
        law: How they report ranges.
        begin: Distance of the rays' origins from where ranges are measured [m].
        stddev: Of the white noise [m]; this and what follows is used in place, rows of a world
            together, shape (nworld * n,).
        keys: Of its random numbers.
        counters: How many of them were drawn.
        bias: Of each sample [m], shape (nworld * n, samples), or no rows for none.
    """

    def __init__(
        self,
        engine: SystemEngine,
        rays: Sequence[RangeRays],
        law: RangeLaw,
        begin: float,
        stddev: Floats,
        keys: UInts64,
        counters: UInts64,
        bias: Floats,
    ) -> None:
        self._engine, self._count = engine, len(rays)
        cast = engine.ranges_of(rays)
        noise = LidarNoise(stddev, keys, counters, bias)
        self._system = LidarSystem(
            len(rays), cast.system, cast.ranges, begin - cast.begin, law, noise
        )
        self._system.least = max(1, _SHARE // cast.ranges.shape[1])

    def measure(self) -> Floats:
        """Measure now on all threads, shape (nworld * n, samples); a new array each time."""
        measured = self._system.renew()
        self._engine.update(self._system)
        return measured

    def measure_all(self, interval: float) -> Floats:  # noqa: ARG002  there are no drifts
        """Measure now, shape (nworld, n, samples); a new array each time."""
        measured = self.measure()
        return measured.reshape(-1, self._count, measured.shape[1])

    @property
    def kernel(self) -> System:
        """What measures in turn; its last measurement is ``latest``."""
        return self._system

    @property
    def latest(self) -> tuple[Floats, NDArray[np.int64]]:
        """The last measurement in turn, shape (nworld, n, samples), and when, (nworld, n) [ns]."""
        measured, stamp = self._system.latest()
        shape = (-1, self._count, measured.shape[1])
        return measured.reshape(shape), stamp.reshape(shape[:2])


class CastLidars(FromPython):
    """Lidars with as many beams and the same law, whose rays an engine casts in one call.

    Args:
        engine: Casts them.
        rays: Of each lidar, n in all.
        law: How they report ranges.
        begin: Distance of the rays' origins from where ranges are measured [m].
        noise: A row for each world and lidar, those of a world together.
    """

    def __init__(
        self,
        engine: TableEngine,
        rays: Sequence[RangeRays],
        law: RangeLaw,
        begin: float,
        noise: LidarNoise,
    ) -> None:
        self._engine, self._law, self._begin, self._noise = engine, law, begin, noise
        self._links = tuple(each.link for each in rays)
        self._origins = np.array([each.origins for each in rays])
        self._directions = np.array([each.directions for each in rays])

    def measure_all(self, interval: float) -> Floats:  # noqa: ARG002  there are no drifts
        """Measure now, shape (nworld, n, samples); a new array each time."""
        cast, begin = self._engine.cast_ranges_together(
            self._links, self._origins, self._directions
        )
        samples = cast.shape[2]
        ranges = np.ascontiguousarray(cast).reshape(-1, samples)
        measured = np.empty((len(ranges), samples + samples % 2))
        measure(self._law, self._noise, ranges, self._begin - begin, measured)
        return measured.reshape(*cast.shape[:2], -1)[:, :, :samples]
