"""Filters of scans that compare a beam with those beside it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gazelle_ros.base.array_types import Bools, Floats
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.scans.filters.beams import BeamScan

_DISTANCE = 0


@dataclass(frozen=True, slots=True)
class ScanShadowsFilter:
    """Filter that removes points at edges, where a beam meets two surfaces at once.

    The line through two points of a scan and the beam to the first have an angle; where it is
    outside the limits [degrees], the second is in the shadow of the first or conversely.
    """

    required: ClassVar = ("min_angle", "max_angle", "window")

    min_angle: float = tunable(10.0, 0.0, 360.0, "Minimum perpendicular angle")
    max_angle: float = tunable(170.0, 0.0, 360.0, "Maximum perpendicular angle")
    window: int = tunable(1, 0, 100, "Consecutive measurements to consider angles inside of")
    neighbors: int = tunable(0, 0, 100, "Number of further-away neighbors to remove")
    remove_shadow_start_point: bool = tunable(
        False, description="Whether to remove the shadow start point"
    )

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without the farther neighbours of points at an edge."""
        ranges = scan.ranges
        shadow = self._edges(ranges, scan.angle_increment)
        removed = np.zeros(len(ranges), bool)
        for place in np.flatnonzero(shadow).tolist():
            around = slice(max(place - self.neighbors, 0), place + self.neighbors + 1)
            removed[around] |= ranges[place] < ranges[around]
        if self.remove_shadow_start_point:
            removed |= shadow
        return scan.with_ranges(removed, np.nan)

    def _edges(self, ranges: Floats, increment: float) -> Bools:
        """Return the points that make an angle outside the limits with one in the window."""
        least = abs(math.tan(math.radians(min(max(self.min_angle, 0.0), 90.0))))
        most = -abs(math.tan(math.radians(min(max(self.max_angle, 90.0), 180.0))))
        found = np.zeros(len(ranges), bool)
        with np.errstate(divide="ignore", invalid="ignore"):
            for step in range(1, min(self.window, len(ranges) - 1) + 1):
                sine, cosine = abs(math.sin(step * increment)), math.cos(step * increment)
                for own, other in ((slice(None, -step), slice(step, None)),
                                   (slice(step, None), slice(None, -step))):  # fmt: skip
                    slope = np.abs(ranges[other] * sine) / (ranges[own] - ranges[other] * cosine)
                    found[own] |= np.where(slope > 0.0, slope < least, slope > most)
        return found


@dataclass(frozen=True, slots=True)
class LaserScanSpeckleFilter:
    """Filter that removes beams whose ranges differ from those around."""

    filter_type: int = tunable(
        0, 0, 1, "0: by distance between ranges, 1: by distance between points"
    )
    max_range: float = tunable(2.0, 0.0, 100.0, "Only smaller ranges are taken into account")
    max_range_difference: float = tunable(0.4, 0.0, 100.0, "Greatest distance of neighbors")
    filter_window: int = tunable(4, 0, 100, "Minimum number of neighbors")

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without beams that have too few neighbours.

        Raises:
            ValueError: It has no more beams than the window.
        """
        count, window = len(scan.ranges), self.filter_window
        if count <= window + 1:
            raise ValueError(f"{count} beams are too few for a filter_window of {window}")
        inside = self._near if self.filter_type == _DISTANCE else self._crowded
        begins = inside(scan)[: count - window + 1]
        good = scan.ranges > self.max_range
        for step in range(window):
            good[step : step + len(begins)] |= begins[: count - step]
        return scan.with_ranges(~good, np.nan)

    def _near(self, scan: BeamScan) -> Bools:
        """Return the beams whose followers in the window have about the same range."""
        ranges, window = scan.ranges, self.filter_window
        count = len(ranges) - window + 1
        found = ~np.isnan(ranges[:count])
        with np.errstate(invalid="ignore"):
            for step in range(1, window):
                other = ranges[step : step + count]
                far = np.abs(other - ranges[:count]) > self.max_range_difference
                found &= ~np.isnan(other) & ~far
        return found

    def _crowded(self, scan: BeamScan) -> Bools:
        """Return the beams with enough points around theirs."""
        ranges = scan.ranges
        neighbours = np.zeros(len(ranges), int)
        with np.errstate(invalid="ignore"):
            for step in range(1, self.filter_window + 1):
                one, two = ranges[:-step], ranges[step:]
                cosine = math.cos(step * scan.angle_increment)
                squares = one**2 + two**2 - 2.0 * one * two * cosine
                close = np.sqrt(np.maximum(squares, 0.0)) <= self.max_range_difference
                neighbours[:-step] += close
                neighbours[step:] += close
        return neighbours >= self.filter_window
