"""Likelihood of a laser scan at many poses on a map: the three models of ``amcl``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.description.occupancy import FREE, OCCUPIED, OccupancyMap
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.following import Pose2
from gazelle.navigation.localization.scan_likelihood import BeamModel, LikelihoodField
from gazelle.navigation.localization.settings import AmclSettings


@dataclass(frozen=True, slots=True)
class PlanarScan:
    """Planar laser scan.

    As drivers deliver it, so nothing is refused: with NaN in it a scan favours no pose.

    Attributes:
        ranges: [m], shape (n,); infinite or NaN for nothing.
        angles: Of its beams in its frame [rad], shape (n,).
        range_max: Greatest range [m].
        range_min: Least range [m].
        laser: Pose of the laser in the robot's frame.
    """

    ranges: Floats
    angles: Floats
    range_max: float
    range_min: float
    laser: Pose2


class ScanModel:
    """Scores poses by scans.

    Args:
        settings: As of ``amcl``.
        grid: The map.
    """

    def __init__(self, settings: AmclSettings, grid: OccupancyMap) -> None:
        self.settings, self._map = settings, grid
        self._field: tuple[float, LikelihoodField] | None = None

    def scores(self, poses: Floats, scan: PlanarScan, *, converged: bool = False) -> Floats:
        """Return the factors of the weights, up to a common factor, shape (n,).

        Args:
            poses: x, y [m] and heading [rad] of the robot, shape (n, 3).
            scan: Laser scan.
            converged: Whether poses are close together, so that beams may be skipped which most of them
                do not expect (``do_beamskip``, with ``likelihood_field_prob``).
        """
        s = self.settings
        most = min(scan.range_max, s.laser_max_range) if s.laser_max_range > 0 else scan.range_max
        least = max(scan.range_min, s.laser_min_range) if s.laser_min_range > 0 else scan.range_min
        step = self._step(len(scan.ranges))
        ranges, angles = scan.ranges[::step], scan.angles[::step]
        # The original takes what is too near for the greatest range.
        ranges = np.where(ranges <= least, most, ranges)
        ranges = np.where(np.isnan(ranges), np.inf, ranges)
        if s.laser_model_type == "beam":
            return self._by_beams(poses, np.minimum(ranges, most), angles, most, scan.laser)
        seen = ranges < most
        points = _ends(ranges[seen], angles[seen], scan.laser)
        field = self._field_for(most)
        if s.laser_model_type == "likelihood_field":
            return field.scores(poses, points, 1.0)
        if s.do_beamskip and converged:
            points = points[self._expected(field, poses, points, most)]
        logs = field.scores(poses, points, 0.0)
        # A common factor changes no weights, and keeps them from vanishing.
        weights: Floats = np.exp(logs - logs.max())
        return weights

    def _step(self, count: int) -> int:
        """Return the stride between used beams."""
        beams = max(self.settings.laser_max_beams, 1)
        if self.settings.laser_model_type == "likelihood_field_prob":
            return max(-(-count // beams), 1)
        return max((count - 1) // max(beams - 1, 1), 1)

    def _expected(
        self, field: LikelihoodField, poses: Floats, points: Floats, most: float
    ) -> Bools:
        """Return a mask of the beams to use, shape (m,): near an obstacle at enough poses."""
        s = self.settings
        near = field.count_above(poses, points, float(self._term(s.beam_skip_distance, most)))
        used: Bools = near / len(poses) > s.beam_skip_threshold
        beams = max(s.laser_max_beams, 1)
        if beams - int(used.sum()) >= beams * s.beam_skip_error_threshold:
            # The poses may all be wrong: then all beams must show it.
            used = np.ones(len(points), np.bool_)
        return used

    def _term(self, distance: Any, most: float) -> Any:
        """Return the term of a beam's end at this distance [m] from an obstacle."""
        s = self.settings
        p = s.laser_z_hit * np.exp(-(distance**2) / (2.0 * s.laser_sigma_hit**2))
        p = p + s.laser_z_rand / most
        return np.log(p) if s.laser_model_type == "likelihood_field_prob" else p**3

    def _field_for(self, most: float) -> LikelihoodField:
        """Return the field of terms for a greatest range, made once."""
        if self._field is None or self._field[0] != most:
            marked = self._map.data == OCCUPIED
            if self.settings.laser_surfaces_only:
                marked = _surfaces(marked)
            squares = squared_distances(marked.view(np.uint8))
            far = self.settings.laser_likelihood_max_dist
            away = np.minimum(np.sqrt(squares) * self._map.resolution, far)
            origin = self._map.origin.x, self._map.origin.y
            terms = self._term(away, most).astype(np.float32)
            outside = float(self._term(far, most))
            field = LikelihoodField(terms, origin, self._map.resolution, outside)
            self._field = most, field
        return self._field[1]

    def _by_beams(
        self, poses: Floats, ranges: Floats, angles: Floats, most: float, laser: Pose2
    ) -> Floats:
        s = self.settings
        model = BeamModel(
            (self._map.data != FREE).view(np.uint8),
            (self._map.origin.x, self._map.origin.y),
            self._map.resolution,
            np.array([s.laser_z_hit, s.laser_z_short, s.laser_z_max, s.laser_z_rand]),
            s.laser_sigma_hit,
            s.laser_lambda_short,
        )
        cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
        lasers = np.stack(
            (
                poses[:, 0] + cos * laser[0] - sin * laser[1],
                poses[:, 1] + sin * laser[0] + cos * laser[1],
                poses[:, 2] + laser[2],
            ),
            axis=1,
        )
        beams = np.ascontiguousarray(np.stack((ranges, angles), axis=1))
        return model.scores(lasers, beams, most)


def _surfaces(occupied: Bools) -> Bools:
    """Return the occupied cells with a free cell beside them.

    Those off the map count as occupied.
    """
    ring = np.pad(occupied, 1, constant_values=True)
    inside = ring[:-2, 1:-1] & ring[2:, 1:-1] & ring[1:-1, :-2] & ring[1:-1, 2:]
    surfaces: Bools = occupied & ~inside
    return surfaces


def _ends(ranges: Floats, angles: Floats, laser: Pose2) -> Floats:
    """Return the ends of beams in the robot's frame, shape (n, 2) [m]."""
    turned = angles + laser[2]
    x, y = laser[0] + ranges * np.cos(turned), laser[1] + ranges * np.sin(turned)
    ends: Floats = np.stack((x, y), axis=1)
    return ends
