# cython: infer_types=True, annotation_typing=False
# mypy: disable-error-code="misc"
"""Conversion of true ranges to a lidar's readings: noise, rounding and limits, in native code."""

# ruff: noqa: FURB136  # loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.native.system import System
from cython.cimports.gazelle.native.white_noise import fill_normal
from cython.cimports.libc.math import rint
from numpy.typing import NDArray

from gazelle.array_types import Floats, UInts64

INF = cython.declare(cython.double, float("inf"))
AT_ONCE = cython.declare(cython.Py_ssize_t, 1024)  # ranges that are in the processor's cache


class RangeLaw:
    """Range model of a lidar.

    Args:
        low: Least range that it reports [m].
        high: Largest finite range; others are infinite [m].
        quantum: Resolution of ranges [m]; 0 for none.
        mean: Of the noise [m].
        precision: Resolution of noisy ranges [m]; 0 for none.
    """

    def __init__(
        self, low: float, high: float, quantum: float, mean: float, precision: float
    ) -> None:
        self.low, self.high, self.quantum = low, high, quantum
        self.mean, self.precision = mean, precision


class LidarNoise:
    """The noise of some lidars, a row each; arrays are views, and continue in place.

    Args:
        deviation: Standard deviation of the white noise [m], shape (n,).
        keys: Of its random numbers, shape (n,).
        counters: Number of those drawn, shape (n,).
        bias: Of each sample [m], shape (n, samples), or (0, samples) for none.
    """

    def __init__(self, deviation: Floats, keys: UInts64, counters: UInts64, bias: Floats) -> None:
        self.deviation, self.keys, self.counters, self.bias = deviation, keys, counters, bias


def add_noise(
    noise: LidarNoise, m: int, ranges: Floats, count: int, offset: float, mean: float,
    measured: Floats,
) -> None:  # fmt: skip
    """Add noise to ranges of the m-th lidar.

    All arrays but those of noise are rows. All arrays but those of noise are rows.
    """
    spread = noise.deviation[m]
    if spread != 0.0:
        fill_normal(noise.keys[m], noise.counters[m], count, measured)
        noise.counters[m] += 2 * ((count + 1) // 2)
    else:
        for k in range(count):
            measured[k] = 0.0
    if noise.bias.shape[0] > 0:
        for k in range(count):
            v = ranges[k] + offset + mean + noise.bias[m, k]
            measured[k] = v + spread * measured[k]
    else:
        for k in range(count):
            measured[k] = ranges[k] + offset + mean + spread * measured[k]


def measure_row(
    law: RangeLaw, noise: LidarNoise, m: int, ranges: Floats, count: int, offset: float,
    measured: Floats,
) -> None:  # fmt: skip
    """Measure with the m-th lidar; see ``measure``.

    All arrays but those of noise are rows. All arrays but those of noise are rows.
    """
    add_noise(noise, m, ranges, count, offset, law.mean, measured)
    if law.precision > 0.0:
        for k in range(count):
            measured[k] = rint(measured[k] / law.precision) * law.precision
    if law.quantum > 0.0:
        for k in range(count):
            measured[k] = rint(measured[k] / law.quantum) * law.quantum
    low, high = law.low, law.high
    for k in range(count):
        true, v = ranges[k] + offset, measured[k]
        v = v if v > low else low
        v = v if v < high else high
        far = INF if true >= high else v
        measured[k] = true if true == -INF else far


def measure(
    law: RangeLaw, noise: LidarNoise, ranges: Floats, offset: float, measured: Floats
) -> None:
    """Measure with some lidars.

    Args:
        law: Of all of them.
        noise: A row each.
        ranges: True distances [m]; infinite for nothing, minus infinite from inside of something;
            shape (n, samples).
        offset: Added to them [m].
        measured: Comes out [m], shape (n, samples), or (n, samples + 1) if that is odd.
    """
    with cython.nogil:
        for m in range(ranges.shape[0]):
            measure_row(law, noise, m, ranges[m], ranges.shape[1], offset, measured[m])


def infinite_from(reach: float, ranges: Floats) -> Floats:
    """Return new ranges [m], infinite where they are not below a reach [m]."""
    found = np.empty(ranges.shape)
    near, each = np.ascontiguousarray(ranges).reshape(-1), found.reshape(-1)
    for k in range(each.shape[0]):
        each[k] = near[k] if near[k] < reach else INF
    return found


@cython.cclass
class LidarSystem(System):
    """Lidars with the same beams and the same law, a row each.

    Args:
        rows: Of a world.
        cast: Writes true distances, a row each.
        ranges: Ranges that it writes [m], shape (nworld * rows, samples).
        offset: Added to them [m].
        law: Of all of them.
        noise: A row each.

    """

    def __init__(
        self,
        rows: int,
        cast: System,
        ranges: Floats,
        offset: float,
        law: RangeLaw,
        noise: LidarNoise,
    ) -> None:
        System.__init__(self, rows)
        self.cast, self.ranges, self.offset = cast, ranges, offset
        self.law, self.noise = law, noise
        self.stamps = self.stamp = np.zeros(len(ranges), np.int64)
        self.renew()

    def renew(self) -> Floats:
        """Measure into a new array from now on, shape (nworld * rows, samples)."""
        count = self.ranges.shape[1]
        whole = np.empty((self.ranges.shape[0], count + count % 2))
        self.measured, self.values = whole, whole[:, :count] if count % 2 else whole
        return self.values

    def latest(self) -> tuple[Floats, NDArray[np.int64]]:
        """Return the last measurements [m], (nworld * rows, samples), and their times [ns]."""
        return self.values, self.stamps

    def update(self, first: int, last: int, time: int) -> None:
        """Measure with the lidars first to last."""
        count = self.ranges.shape[1]
        some = max(self.rows, AT_ONCE // count)  # of a world, where it is now is computed once
        begin = first
        while begin < last:
            end = min(begin + some, last)
            self.cast.update(begin, end, time)
            for m in range(begin, end):
                measure_row(
                    self.law, self.noise, m, self.ranges[m], count, self.offset, self.measured[m]
                )
                self.stamp[m] = time
            begin = end
