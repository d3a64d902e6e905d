"""A map that is made while driving, and the robot's place on it, in process."""

from __future__ import annotations

import math

from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle.navigation.localization import PlanarScan
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle_ros.base.parameter_values import Values, value_of

_USUAL = {
    "linearUpdate": 0.3, "angularUpdate": 0.2, "temporalUpdate": 0.5, "minimumScore": 50.0, "particles": 8,
    "xmin": -10.0, "ymin": -10.0, "xmax": 10.0, "ymax": 10.0,
}  # fmt: skip
"""As turtlebot3_slam has them, but for fewer particles."""


class LiveMap:
    """Makes a map as ``slam_gmapping`` does.

    Args:
        values: Parameters of ``slam_gmapping``; what is not there is as turtlebot3_slam has it.
        seed: Of all that is drawn.

    Attributes:
        grid: The last map; None before the first scan.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, values: Values, seed: int) -> None:
        self._slam = GridSlam(GmappingSettings.read({**_USUAL, **values}), seed)
        self._interval = value_of(values, "map_update_interval", 2.0)
        self._due = -math.inf
        self.grid: OccupancyMap | None = None

    @property
    def map_to_odom(self) -> Pose2 | None:
        """Pose of the odometry frame on the map; None before the first scan."""
        return self._slam.map_to_odom

    def update(self, time: float, odom: Pose2, scan: PlanarScan) -> OccupancyMap | None:
        """Process a scan; returns a new map if one is due.

        Args:
            time: Of the scan [s].
            odom: Pose of the robot by odometry then.
            scan: Laser scan.
        """
        ranges = scan.ranges.copy()
        # What is too near is as good as nothing.
        most = max(0.0, scan.range_max)  # of NaN 0
        ranges[ranges < scan.range_min] = most
        changed = self._slam.update(time, odom, ranges, scan.angles, most, scan.laser)
        if not changed or time < self._due - 1e-6:
            return None
        self._due = time + self._interval
        self.grid = self._slam.map()
        return self.grid
