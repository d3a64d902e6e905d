"""Map and place by scans that constrain one another: what ``slam_karto`` does.

Scans are matched to those before; where the robot comes back to what it has seen, the loop is closed and
all poses are moved so that they fit (``pose_graph``). The map is drawn of all scans at their poses.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description import Pose
from gazelle.description.occupancy import FREE, OCCUPIED, UNKNOWN, OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2
from gazelle.navigation.mapping.pose_graph import PoseEdge, optimized
from gazelle.navigation.mapping.scan_matching import ScanMatcher
from gazelle.navigation.mapping.tiled_maps import SIDE, TiledMaps
from gazelle.navigation.planners.planar import between, composed, inverse
from gazelle_ros.base.parameter_values import Values, fields_of

_SIGMA, _TURN, _HALVINGS = 0.05, 0.05, 5
_LEAST_VISITS, _LEAST_SHARE = 2, 0.1
"""A cell is occupied if at least this number of beams crossed it and this share of them ended there, as in the original."""
_MATCHED = (400.0, 400.0, 2500.0)
"""Inverse variances of poses by matching [1/m²], [1/rad²]: 5 cm and 0.02 rad."""


@checked(Error)
@dataclass(frozen=True, slots=True)
class KartoSettings:
    """Parameters; names are those of ``slam_karto``, defaults those of its library."""

    resolution: float = 0.05
    use_scan_matching: bool = True
    minimum_travel_distance: float = 0.2
    minimum_travel_heading: float = math.radians(10.0)
    scan_buffer_size: int = 70
    scan_buffer_maximum_scan_distance: float = 20.0
    do_loop_closing: bool = True
    loop_search_maximum_distance: float = 4.0
    loop_match_minimum_chain_size: int = 10
    loop_match_minimum_response_fine: float = 0.7

    @classmethod
    def read(cls, values: Values) -> KartoSettings:
        """Read the parameters; ``delta`` is taken for ``resolution``, as in the original.

        Raises:
            Error: One is of the wrong kind, or the map would be none.
        """
        if "delta" in values and "resolution" not in values:
            values = {**values, "resolution": values["delta"]}
        return cls(**fields_of(cls, values))

    def __post_init__(self) -> None:
        if not self.resolution > 0.0:
            raise Error("a map needs a positive 'resolution'")


@dataclass(frozen=True, slots=True)
class _Keyframe:
    """A scan that is kept: ends of beams in the laser's frame, shape (n, 2) [m]."""

    beams: Floats
    laser: Pose2


@checked(Error, after=True)
class KartoSlam:
    """The pose graph: scans at poses, and constraints between them.

    Args:
        settings: As of ``slam_karto``.

    Attributes:
        poses: Of the robot at each scan that is kept, shape (n, 3).
        map_to_odom: Pose of the odometry's frame on the map; None before the first scan.
        loops: Number of closed loops.
    """

    def __init__(self, settings: KartoSettings) -> None:
        self.settings = settings
        self.poses: Floats = np.zeros((0, 3))
        self.map_to_odom: Pose2 | None = None
        self.loops = 0
        self._frames: list[_Keyframe] = []
        self._edges: list[PoseEdge] = []
        self._odom: Pose2 | None = None
        self._closed_at = 0
        self._most = 0.0

    def update(
        self, odom: Pose2, ranges: Floats, angles: Floats, range_max: float, laser: Pose2
    ) -> bool:
        """Process a scan, if the robot has moved; arguments as of `GridSlam.update`.

        Returns:
            Whether the map has changed.

        Raises:
            Error: The greatest range is NaN.
        """
        if not range_max >= 0.0:
            raise Error(f"a scan sees so far, not {range_max!r:.60}")
        if self._odom is not None and not self._has_moved(between(self._odom, odom)):
            return False
        good = np.isfinite(ranges) & (ranges > 0.0) & (ranges < range_max)
        far, turned = ranges[good], angles[good]
        beams = np.ascontiguousarray(np.stack((far * np.cos(turned), far * np.sin(turned)), axis=1))
        self._most = max(self._most, range_max)
        frame = _Keyframe(beams, laser)
        pose = odom
        if self._odom is not None:
            last = self._pose(len(self._frames) - 1)
            pose = composed(last, between(self._odom, odom))
            if self.settings.use_scan_matching:
                pose, _ = self._match(frame, pose, self._recent())
            edge = PoseEdge(len(self._frames) - 1, len(self._frames), between(last, pose), _MATCHED)
            self._edges.append(edge)
        self._frames.append(frame)
        self.poses = np.vstack((self.poses, pose))
        self._odom = odom
        if self.settings.do_loop_closing:
            self._close_loop()
        x, y, heading = self._pose(len(self._frames) - 1)
        self.map_to_odom = composed((x, y, wrapped(heading)), inverse(odom))
        return True

    def _has_moved(self, step: Pose2) -> bool:
        s = self.settings
        return (
            math.hypot(step[0], step[1]) >= s.minimum_travel_distance
            or abs(step[2]) >= s.minimum_travel_heading
        )

    def _pose(self, number: int) -> Pose2:
        x, y, heading = self.poses[number].tolist()
        return x, y, heading

    def _recent(self) -> list[int]:
        """Return the scans of the buffer: the last ones, as far as they are near."""
        first = max(len(self._frames) - self.settings.scan_buffer_size, 0)
        away = np.hypot(*(self.poses[first:, :2] - self.poses[-1, :2]).T)
        near = away <= self.settings.scan_buffer_maximum_scan_distance
        return (first + np.flatnonzero(near)).tolist()

    def _match(
        self, frame: _Keyframe, pose: Pose2, others: Sequence[int], kernel: int = 1
    ) -> tuple[Pose2, float]:
        """Match a scan to others; return its pose and the share of its beams that fit."""
        if not len(frame.beams) or not others:
            return pose, 0.0
        maps = self._draw(others)
        eye = np.array(composed(pose, frame.laser))
        step = self.settings.resolution * kernel
        matcher = ScanMatcher(maps, _SIGMA, _SIGMA, kernel)
        score = matcher.match(0, eye, frame.beams, step, _TURN * kernel, _HALVINGS)
        x, y, heading = eye.tolist()
        return composed((x, y, heading), inverse(frame.laser)), score / len(frame.beams)

    # Loops --------------------------------------------------------------------------------

    def _close_loop(self) -> None:
        """Match the last scan to old ones that it is near again, and fit all poses."""
        s = self.settings
        last = len(self._frames) - 1
        if last - self._closed_at < s.loop_match_minimum_chain_size:
            return
        old = last - max(s.scan_buffer_size, s.loop_match_minimum_chain_size)
        if old <= 0:
            return
        away = np.hypot(*(self.poses[:old, :2] - self.poses[last, :2]).T)
        near = np.flatnonzero(away <= s.loop_search_maximum_distance)
        if len(near) < s.loop_match_minimum_chain_size:
            return
        pose, response = self._match(self._frames[last], self._pose(last), near.tolist(), 3)
        if response < s.loop_match_minimum_response_fine:
            return
        nearest = int(away.argmin())
        edge = PoseEdge(nearest, last, between(self._pose(nearest), pose), _MATCHED)
        self._edges.append(edge)
        self._closed_at = last
        self.loops += 1
        self.poses = optimized(self.poses, self._edges)

    # Maps ---------------------------------------------------------------------------------

    def _draw(self, numbers: Sequence[int]) -> TiledMaps:
        """Return a map of some scans at their poses."""
        s = self.settings
        places = self.poses[list(numbers), :2]
        side = s.resolution * SIDE
        low = np.floor((places.min(axis=0) - self._most) / side - 1.0) * side
        tiles = np.ceil((places.max(axis=0) + self._most - low) / side).astype(int) + 1
        corner = float(low[0]), float(low[1])
        maps = TiledMaps(1, int(tiles[1]), int(tiles[0]), corner, s.resolution)
        self._corner = corner
        for number in numbers:
            frame = self._frames[number]
            eye = np.array(composed(self._pose(number), frame.laser))
            maps.register(0, eye, frame.beams, self._most)
        return maps

    def map(self) -> OccupancyMap:
        """Return the map of all scans, as far as they reach."""
        s = self.settings
        if not self._frames:
            return OccupancyMap(np.full((1, 1), UNKNOWN, np.int8), s.resolution, Pose())
        _, _, hits, visits = self._draw(range(len(self._frames))).cells(0)
        data = np.full(hits.shape, UNKNOWN, np.int8)
        seen = visits >= _LEAST_VISITS
        data[seen] = np.where(hits[seen] / visits[seen] > _LEAST_SHARE, OCCUPIED, FREE)
        return OccupancyMap(data, s.resolution, Pose(*self._corner))
