"""Filters of scans by the direction of a beam."""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.scans.filters.beams import BeamScan
from gazelle_ros.clock import SECOND

_LOG = logging.getLogger("gazelle.ros.scans")
_TURN = 2.0 * math.pi


@dataclass(frozen=True, slots=True)
class LaserScanAngularBoundsFilter:
    """Filter that shortens a scan to the beams between two angles [rad]."""

    required: ClassVar = ("lower_angle", "upper_angle")

    lower_angle: float = 0.0
    upper_angle: float = 0.0

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan from its first beam within the bounds to its last."""
        angles = scan.angles
        if scan.angle_increment > 0:
            before, after = angles < self.lower_angle, angles > self.upper_angle
        else:
            before, after = angles > self.upper_angle, angles < self.lower_angle
        first = int(np.argmin(before)) if not before.all() else len(angles)
        beyond = np.flatnonzero(after[first + 1 :])  # one beam is kept at least
        end = first + 1 + int(beyond[0]) if len(beyond) else len(angles)
        kept = angles[first:end]
        if not len(kept):
            return replace(scan, ranges=kept, intensities=kept)
        return replace(
            scan,
            ranges=scan.ranges[first:end],
            intensities=scan.intensities[first:end],
            angle_min=float(kept[0]),
            angle_max=float(kept[-1]),
            stamp=scan.stamp + round(first * scan.time_increment * SECOND),
        )


@dataclass(frozen=True, slots=True)
class LaserScanAngularBoundsFilterInPlace:
    """Filter that clears the beams between two angles [rad]."""

    required: ClassVar = ("lower_angle", "upper_angle")

    lower_angle: float = 0.0
    upper_angle: float = 0.0

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan with ranges beyond its greatest between the bounds."""
        angles = scan.angles
        return scan.cleared((angles > self.lower_angle) & (angles < self.upper_angle))


@dataclass(frozen=True, slots=True)
class LaserScanSectorFilter:
    """Filter that clears a sector of a ring, or all but it."""

    angle_min: float = tunable(0.0, -math.pi, math.pi, "Min angle of the circle sector (radians)")
    angle_max: float = tunable(0.0, -math.pi, math.pi, "Max angle of the circle sector (radians)")
    range_min: float = tunable(0.0, 0.0, 1e5, "Min radius of the circle sector (meter)")
    range_max: float = tunable(1e5, 0.0, 1e5, "Max radius of the circle sector (meter)")
    clear_inside: bool = tunable(True, description="True to clear inside of the circle sector")
    invert: bool = tunable(False, description="A Boolean to invert the filter")

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan with ranges beyond its greatest in the sector, or outside."""
        width, turned = self.angle_max - self.angle_min, scan.angles - self.angle_min
        if width < 0.0:  # the sector is across the back
            width += _TURN
            turned = np.where(turned < 0.0, turned + _TURN, turned)
        inside = (turned > 0.0) & (turned < width)
        inside &= (scan.ranges > self.range_min) & (scan.ranges < self.range_max)
        return scan.cleared(inside if self.clear_inside and not self.invert else ~inside)


@dataclass(frozen=True, slots=True)
class LaserScanMaskFilter:
    """Filter that removes the beams listed in a mask of the laser's frame."""

    required: ClassVar = ("masks",)

    masks: dict[str, Any] = field(default_factory=dict)
    warned: set[str] = field(default_factory=set, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for frame, mask in self.masks.items():
            if not isinstance(mask, list) or any(type(each) is not int for each in mask):
                raise RosError(
                    f"the mask of '{frame}' must be a list of numbers of beams, not {mask!r:.60}"
                )

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without a number as the range of masked beams."""
        mask = self.masks.get(scan.frame)
        if mask is None:
            if scan.frame not in self.warned:
                self.warned.add(scan.frame)
                _LOG.warning("LaserScanMaskFilter has no mask for the frame '%s'", scan.frame)
            return scan
        chosen = np.zeros(len(scan.ranges), bool)
        chosen[[each for each in mask if 0 <= each < len(chosen)]] = True
        return scan.with_ranges(chosen, np.nan)
