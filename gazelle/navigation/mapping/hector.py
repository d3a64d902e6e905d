"""Map and place from scans alone, without odometry: what ``hector_mapping`` does.

S. Kohlbrecher, O. von Stryk, J. Meyer and U. Klingauf, "A flexible and scalable SLAM system with full
3D motion estimation", 2011.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.description.occupancy import FREE, OCCUPIED, UNKNOWN, OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2
from gazelle.navigation.limits import check_maps
from gazelle.navigation.mapping.scan_matching import ScanMatcher
from gazelle.navigation.mapping.tiled_maps import SIDE, TiledMaps
from gazelle.navigation.planners.planar import between, composed, inverse
from gazelle_ros.base.parameter_values import Values, fields_of

_SIGMA, _TURN, _HALVINGS = 0.05, 0.1, 6
"""Of the climb: spread of ends [m²], first turn [rad], and how often steps are halved."""


@checked(Error)
@dataclass(frozen=True, slots=True)
class HectorSettings:
    """Parameters; names and defaults are those of ``hector_mapping``."""

    map_resolution: float = 0.025
    map_size: int = 1024
    map_start_x: float = 0.5
    map_start_y: float = 0.5
    map_multi_res_levels: int = 3
    update_factor_free: float = 0.4
    update_factor_occupied: float = 0.9
    map_update_distance_thresh: float = 0.4
    map_update_angle_thresh: float = 0.9
    laser_min_dist: float = 0.4
    laser_max_dist: float = 30.0
    map_with_known_poses: bool = False

    @classmethod
    def read(cls, values: Values) -> HectorSettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind, or the map would be none.
        """
        return cls(**fields_of(cls, values))

    def __post_init__(self) -> None:
        if not self.map_resolution > 0.0 or self.map_size < 1:
            raise Error("a map needs a positive 'map_resolution' and 'map_size'")
        check_maps(1, self.map_size, self.map_size)
        if not 0.0 < self.update_factor_free < 0.5 < self.update_factor_occupied < 1.0:
            raise Error("'update_factor_free' is below 0.5, 'update_factor_occupied' above it")


@checked(Error, after=True)
class HectorSlam:
    """A map and a pose, moved from scan to scan.

    Args:
        settings: As of ``hector_mapping``.

    Attributes:
        pose: Of the robot on the map.
    """

    def __init__(self, settings: HectorSettings) -> None:
        self.settings = settings
        s = settings
        extent = s.map_resolution * s.map_size
        self._corner = -extent * s.map_start_x, -extent * s.map_start_y
        self.reset()

    def reset(self) -> None:
        """Discard the map, and restart at its origin."""
        s = self.settings
        tiles = -(-s.map_size // SIDE)
        self._maps = TiledMaps(1, tiles, tiles, self._corner, s.map_resolution)
        kernel = max(s.map_multi_res_levels, 1)
        self._matcher = ScanMatcher(self._maps, _SIGMA, _SIGMA, kernel)
        self.pose: Pose2 = (0.0, 0.0, 0.0)
        self._drawn: Pose2 | None = None

    def update(
        self, ranges: Floats, angles: Floats, laser: Pose2, start: Pose2 | None = None
    ) -> bool:
        """Process a scan.

        Args:
            ranges: [m], shape (n,).
            angles: Of beams in the laser's frame [rad], shape (n,).
            laser: Its pose in the robot's frame.
            start: Initial pose of the robot; the last one if None.

        Returns:
            Whether the map has changed.
        """
        s = self.settings
        good = np.isfinite(ranges) & (ranges > s.laser_min_dist) & (ranges < s.laser_max_dist)
        far, turned = ranges[good], angles[good]
        beams = np.ascontiguousarray(np.stack((far * np.cos(turned), far * np.sin(turned)), axis=1))
        self.pose = self.pose if start is None else start
        eye = np.array(composed(self.pose, laser))
        if self._drawn is not None and not s.map_with_known_poses and len(beams):
            step = 2.0 * s.map_resolution
            self._matcher.match(0, eye, beams, step, _TURN, _HALVINGS)
            x, y, heading = eye.tolist()
            self.pose = composed((x, y, wrapped(heading)), inverse(laser))
        if self._drawn is not None and not self._has_moved(self._drawn):
            return False
        self._maps.register(0, eye, beams, s.laser_max_dist)
        self._drawn = self.pose
        return True

    def _has_moved(self, before: Pose2) -> bool:
        x, y, turn = between(before, self.pose)
        s = self.settings
        return (
            math.hypot(x, y) > s.map_update_distance_thresh or abs(turn) > s.map_update_angle_thresh
        )

    def map(self) -> OccupancyMap:
        """Return all of it: cells are what beams that passed or ended there make more likely."""
        s = self.settings
        _, _, hits, visits = self._maps.cells(0)[:, : s.map_size, : s.map_size]
        odds = hits * _logit(s.update_factor_occupied)
        odds += (visits - hits) * _logit(s.update_factor_free)
        data = np.where(odds > 0.0, OCCUPIED, FREE).astype(np.int8)
        data[visits == 0] = UNKNOWN
        return OccupancyMap(data, s.map_resolution, Pose(*self._corner))


def _logit(share: float) -> float:
    return math.log(share / (1.0 - share))
