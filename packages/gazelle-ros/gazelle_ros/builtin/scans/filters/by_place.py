"""Filters of scans by the place of a point in another frame."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from gazelle_ros.base.array_types import Bools, Floats
from gazelle_ros.base.errors import RosError
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.scans.filters.beams import BeamScan

_ROBOT = "base_link"


@dataclass(frozen=True, slots=True)
class LaserScanBoxFilter:
    """Filter that removes points in a box of a frame [m], or all outside."""

    box_frame: str = tunable(_ROBOT, description="The frame in which the box is created")
    min_x: float = tunable(-1.0, -100.0, 100.0, "Box starting point in x-axis")
    max_x: float = tunable(1.0, -100.0, 100.0, "Box ending point in x-axis")
    min_y: float = tunable(-1.0, -100.0, 100.0, "Box starting point in y-axis")
    max_y: float = tunable(1.0, -100.0, 100.0, "Box ending point in y-axis")
    min_z: float = tunable(-1.0, -100.0, 100.0, "Box starting point in z-axis")
    max_z: float = tunable(1.0, -100.0, 100.0, "Box ending point in z-axis")
    invert: bool = tunable(False, description="A Boolean to invert the filter")

    @property
    def frame(self) -> str:
        """Frame that the points are needed in."""
        return self.box_frame

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without a number as the range of points in the box, or outside."""
        points = scan.points_in(self.frame)
        least = np.array([self.min_x, self.min_y, self.min_z])
        most = np.array([self.max_x, self.max_y, self.max_z])
        inside: Bools = np.all((points > least) & (points < most), axis=1)
        return _without(scan, points, inside, invert=self.invert)


@dataclass(frozen=True, slots=True)
class LaserScanFootprintFilter:
    """Filter that removes points in a square around ``base_link`` of twice ``inscribed_radius`` [m]."""

    required: ClassVar = ("inscribed_radius",)

    inscribed_radius: float = 0.0

    @property
    def frame(self) -> str:
        """Frame that the points are needed in."""
        return _ROBOT

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without a number as the range of points in the footprint."""
        points = scan.points_in(self.frame)
        inside: Bools = np.all(np.abs(points[:, :2]) <= self.inscribed_radius, axis=1)
        return _without(scan, points, inside, invert=False)


@dataclass(frozen=True, slots=True)
class LaserScanPolygonFilter:
    """Filter that removes points in a polygon of a frame [m], or all outside."""

    required: ClassVar = ("polygon", "polygon_frame")

    polygon: list[Any] = field(default_factory=list)
    polygon_frame: str = ""
    transform_timeout: float = 5.0  # not needed: a scan waits until its transforms are known
    polygon_padding: float = tunable(0.0, 0.0, 100.0, "Polygon padding in meters")
    invert: bool = tunable(False, description="A Boolean to invert the filter")

    def __post_init__(self) -> None:
        pairs = all(isinstance(each, list) and len(each) == 2 for each in self.polygon)
        numbers = pairs and all(
            isinstance(n, int | float) and math.isfinite(n) for each in self.polygon for n in each
        )
        if not numbers or len(self.polygon) in {1, 2}:
            raise RosError(
                f"the polygon must be a list of three or more pairs of numbers, not {self.polygon!r:.60}"
            )

    @property
    def frame(self) -> str:
        """Frame that the points are needed in."""
        return self.polygon_frame

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan without a number as the range of points in the polygon, or outside."""
        points = scan.points_in(self.frame)
        corners = np.array(self.polygon, np.float64).reshape(-1, 2)
        corners += np.sign(corners) * self.polygon_padding
        return _without(scan, points, _in_polygon(corners, points), invert=self.invert)


def _in_polygon(corners: Floats, points: Floats) -> Bools:
    """Return the points whose ray along x crosses an odd number of edges."""
    x, y = points[:, 0], points[:, 1]
    inside = np.zeros(len(points), bool)
    for (x0, y0), (x1, y1) in zip(corners, np.roll(corners, 1, axis=0), strict=True):
        if y0 != y1:
            across = (y0 > y) != (y1 > y)
            inside ^= across & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return inside


def _without(scan: BeamScan, points: Floats, inside: Bools, *, invert: bool) -> BeamScan:
    """Return a scan without the points inside, or without those outside."""
    removed = ~inside & ~np.isnan(points[:, 0]) if invert else inside
    return scan.with_ranges(removed, np.nan)
