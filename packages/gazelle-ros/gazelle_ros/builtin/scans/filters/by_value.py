"""Filters of scans by ranges and intensities."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.scans.filters.beams import BeamScan

_GREAT = 100000.0
_SHORT = 0.01
"""Ranges without a valid one before are taken for the greatest, less this [m]."""


@dataclass(frozen=True, slots=True)
class LaserScanRangeFilter:
    """Filter that replaces ranges at thresholds and beyond."""

    lower_threshold: float = tunable(0.0, 0.0, _GREAT, "Range values lower than this are filtered")
    upper_threshold: float = tunable(_GREAT, 0.0, _GREAT, "Range values greater are filtered")
    use_message_range_limits: bool = tunable(
        False, description="Use range_min and range_max of the message as thresholds"
    )
    lower_replacement_value: float = tunable(0.0, 0.0, _GREAT, "Of ranges below")
    upper_replacement_value: float = tunable(_GREAT, 0.0, _GREAT, "Of ranges above")

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan with other ranges instead of those too small or too great."""
        lower, upper = self.lower_threshold, self.upper_threshold
        if self.use_message_range_limits:
            lower, upper = scan.range_min, scan.range_max
        low, high = scan.ranges <= lower, scan.ranges >= upper
        found = scan.with_ranges(high, self.upper_replacement_value)
        return found.with_ranges(low, self.lower_replacement_value)


@dataclass(frozen=True, slots=True)
class LaserScanIntensityFilter:
    """Filter that removes beams by their intensity."""

    lower_threshold: float = tunable(8000.0, 0.0, _GREAT, "Intensities lower are filtered")
    upper_threshold: float = tunable(_GREAT, 0.0, _GREAT, "Intensities greater are filtered")
    invert: bool = tunable(False, description="A Boolean to invert the filter")
    filter_override_range: bool = tunable(True, description="Set filtered ranges to NaN")
    filter_override_intensity: bool = tunable(
        False, description="Set intensities to 0 where filtered, else to 1"
    )

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without beams outside the thresholds; those without intensity stay."""
        count = min(len(scan.ranges), len(scan.intensities))
        lit = scan.intensities[:count]
        filtered = (lit <= self.lower_threshold) | (lit >= self.upper_threshold)
        filtered ^= self.invert
        ranges, intensities = scan.ranges.copy(), scan.intensities.copy()
        if self.filter_override_range:
            ranges[:count][filtered] = np.nan
        if self.filter_override_intensity:
            intensities[:count] = np.where(filtered, 0.0, 1.0)
        return replace(scan, ranges=ranges, intensities=intensities)


@dataclass(frozen=True, slots=True)
class InterpolationFilter:
    """Filter that replaces invalid ranges by the mean of the valid ones around them."""

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan with ranges in each gap."""
        ranges = scan.ranges.copy()
        invalid = (ranges <= scan.range_min) | (ranges >= scan.range_max)
        edges = np.flatnonzero(np.diff(invalid, prepend=False, append=False))
        after = scan.range_max - _SHORT
        for first, end in edges.reshape(-1, 2).tolist():
            before = ranges[first - 1] if first else scan.range_max - _SHORT
            # Behind the last valid range there is none: the last one found stands for it.
            after = ranges[end] if end < len(ranges) else after
            ranges[first:end] = (before + after) / 2.0
        return replace(scan, ranges=ranges)
