# cython: infer_types=True, annotation_typing=False
"""What a lidar reports of true ranges: noise, rounding and limits in one go, in native code."""

# ruff: noqa: FURB136  # loops that become vectors

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.native.white_noise import fill_normal
from cython.cimports.libc.math import rint

from gazelle.array_types import Floats, UInts64

INF = cython.declare(cython.double, float("inf"))


class RangeLaw:
    """How a lidar reports ranges.

    Args:
        samples: Rays of a measurement.
        low: Least range that it reports [m].
        high: What is not nearer is reported as infinite [m].
        quantum: What ranges are rounded to [m]; 0 for not.
        mean: Of the noise [m].
        precision: What noisy ranges are rounded to [m]; 0 for not.
    """

    def __init__(
        self, samples: int, low: float, high: float, quantum: float, mean: float, precision: float
    ) -> None:
        self.low, self.high, self.quantum = low, high, quantum
        self.mean, self.precision = mean, precision
        self.row, self.room = np.zeros(samples + 1), np.zeros(samples // 2 + 1)

    def measure_one(
        self, w: int, ranges: Floats, offset: float, deviation: Floats, bias: Floats,
        keys: UInts64, counters: UInts64, measured: Floats,
    ) -> None:  # fmt: skip
        """A measurement in the w-th of some worlds; see ``measure``."""
        count = ranges.shape[1]
        spread = deviation[w, 0]
        noisy = spread != 0.0
        if noisy:
            fill_normal(keys[w], counters[w], count, self.row, self.room)
            counters[w] += 2 * ((count + 1) // 2)
        for k in range(count):
            v = ranges[w, k] + offset
            v = v + self.mean
            if bias.shape[0] > 0:
                v = v + bias[w, k]
            if noisy:
                v = v + spread * self.row[k]
            measured[w, k] = v
        if self.precision > 0.0:
            for k in range(count):
                measured[w, k] = rint(measured[w, k] / self.precision) * self.precision
        if self.quantum > 0.0:
            for k in range(count):
                measured[w, k] = rint(measured[w, k] / self.quantum) * self.quantum
        low, high = self.low, self.high
        for k in range(count):
            true, v = ranges[w, k] + offset, measured[w, k]
            v = v if v > low else low
            v = v if v < high else high
            far = INF if true >= high else v
            measured[w, k] = true if true == -INF else far

    def measure(
        self, ranges: Floats, offset: float, deviation: Floats, bias: Floats, keys: UInts64,
        counters: UInts64, measured: Floats,
    ) -> None:  # fmt: skip
        """Measurements in some worlds.

        Args:
            ranges: True distances [m]; infinite for nothing, minus infinite from inside of
                something; shape (n, samples).
            offset: Added to them [m].
            deviation: Standard deviation of the white noise in each world [m], shape (n, 1).
            bias: Of each sample [m], shape (n, samples), or (0, samples) for none.
            keys: Of the noise's random numbers, shape (n,).
            counters: How many were drawn; they go on. Shape (n,).
            measured: Comes out [m], shape (n, samples).
        """
        with cython.nogil:
            for w in range(ranges.shape[0]):
                self.measure_one(w, ranges, offset, deviation, bias, keys, counters, measured)
