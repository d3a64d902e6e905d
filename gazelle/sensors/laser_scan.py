"""Measurements of laser range finders.

They are compiled: Python takes four times as long to make an instance, and a fleet makes many.
"""

from __future__ import annotations

import dataclasses

import cython

from gazelle.array_types import Floats


@dataclasses.dataclass(frozen=True)
@cython.cclass
class LaserScan:
    """One measurement of a lidar.

    Attributes:
        stamp: Simulated time [ns].
        ranges: [m], shape (..., rows * samples), row by row from the lowest, each
            counter-clockwise from ``angle_min``. +inf: nothing within ``range_max``;
            -inf: something nearer than ``range_min`` (as REP 117 says it).
        angle_min: Angle of the first ray about z [rad].
        angle_max: Angle of the last ray [rad].
        angle_increment: Between two rays [rad].
        range_min: [m].
        range_max: [m].
    """

    stamp: int
    ranges: Floats
    angle_min: float
    angle_max: float
    angle_increment: float
    range_min: float
    range_max: float
