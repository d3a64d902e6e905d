"""Where a robot is on a map, by its odometry and its laser: what ``amcl`` does."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.description.occupancy import FREE, OCCUPIED, OccupancyMap
from gazelle.errors import Error, did_you_mean
from gazelle.navigation.costmap.distances import squared_distances
from gazelle.navigation.costmap.parameters import Values, fields_of
from gazelle.navigation.following import Pose2, wrapped
from gazelle.navigation.localization.odometry_models import check_model, move_particles
from gazelle.navigation.localization.particle_filter import ParticleFilter, PoseEstimate
from gazelle.navigation.localization.scan_likelihood import BeamModel, LikelihoodField
from gazelle.navigation.planners.planar import composed, inverse

LASER_MODELS = ("likelihood_field", "beam", "likelihood_field_prob")


@dataclass(frozen=True, slots=True)
class AmclSettings:
    """Parameters; names and defaults are those of ``amcl``."""

    min_particles: int = 100
    max_particles: int = 5000
    kld_err: float = 0.01
    kld_z: float = 0.99
    update_min_d: float = 0.2
    update_min_a: float = math.pi / 6.0
    resample_interval: int = 2
    recovery_alpha_slow: float = 0.001
    recovery_alpha_fast: float = 0.1
    selective_resampling: bool = False
    laser_min_range: float = -1.0
    laser_max_range: float = -1.0
    laser_max_beams: int = 30
    laser_z_hit: float = 0.95
    laser_z_short: float = 0.1
    laser_z_max: float = 0.05
    laser_z_rand: float = 0.05
    laser_sigma_hit: float = 0.2
    laser_lambda_short: float = 0.1
    laser_likelihood_max_dist: float = 2.0
    laser_model_type: str = "likelihood_field"
    odom_model_type: str = "diff"
    odom_alpha1: float = 0.2
    odom_alpha2: float = 0.2
    odom_alpha3: float = 0.2
    odom_alpha4: float = 0.2
    odom_alpha5: float = 0.2

    @classmethod
    def read(cls, values: Values) -> AmclSettings:
        """From parameters.

        Raises:
            Error: One is of the wrong kind, or a model is unknown.
        """
        found = fields_of(cls, values)
        check_model(found["odom_model_type"])
        laser = found["laser_model_type"]
        if laser not in LASER_MODELS:
            raise Error(
                f"the laser model '{laser}' is unknown", hint=did_you_mean(laser, LASER_MODELS)
            )
        return cls(**found)


@dataclass(frozen=True, slots=True)
class PlanarScan:
    """What a laser saw.

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


class Localizer:
    """Keeps particles of where a robot may be on a map.

    Args:
        settings: As of ``amcl``.
        grid: The map.
        seed: Of all that is drawn.

    Attributes:
        filter: The particles.
        estimate: What they agreed on last.
        map_to_odom: Where the frame of the odometry is on the map.
    """

    def __init__(self, settings: AmclSettings, grid: OccupancyMap, seed: int = 0) -> None:
        self._random = np.random.default_rng(seed)
        self._odom: Pose2 | None = None
        self._forced = False
        self._updates = 0
        self.estimate: PoseEstimate | None = None
        self.map_to_odom: Pose2 | None = None
        self.set_map(grid)
        self.configure(settings)
        self.begin((0.0, 0.0, 0.0), np.diag([0.25, 0.25, (math.pi / 12.0) ** 2]))

    def configure(self, settings: AmclSettings) -> None:
        """Take settings; a filter of another size begins anew around what it knew."""
        self.settings = settings
        s = settings
        self.filter = ParticleFilter(
            s.min_particles,
            s.max_particles,
            s.kld_err,
            s.kld_z,
            s.recovery_alpha_slow,
            s.recovery_alpha_fast,
            self._random,
        )
        self._field: tuple[float, LikelihoodField] | None = None
        self._alphas = np.array([getattr(s, f"odom_alpha{i}") for i in range(1, 6)])
        if self.estimate is not None:
            self.begin(_as_pose(self.estimate.pose), self.estimate.covariance)

    def set_map(self, grid: OccupancyMap) -> None:
        """Take another map."""
        self._map = grid
        self._field = None
        self._free = np.argwhere(grid.data == FREE)

    # Beginning ----------------------------------------------------------------------------

    def begin(self, pose: Pose2, covariance: Floats) -> None:
        """Begin around a pose, covariance shape (3, 3)."""
        self.filter.spread(np.array(pose), covariance)
        self._odom = None

    def begin_anywhere(self) -> None:
        """Begin with particles all over the free cells of the map."""
        self.filter.begin(self.anywhere(self.settings.max_particles))
        self._odom = None

    def anywhere(self, count: int) -> Floats:
        """Poses on free cells, shape (count, 3)."""
        poses = np.zeros((count, 3))
        if len(self._free):
            chosen = self._free[self._random.integers(len(self._free), size=count)]
            corner = np.array([self._map.origin.x, self._map.origin.y])
            poses[:, :2] = corner + (chosen[:, ::-1] + 0.5) * self._map.resolution
        poses[:, 2] = self._random.uniform(-math.pi, math.pi, count)
        return poses

    def force_update(self) -> None:
        """Take the next scan even if the robot has not moved."""
        self._forced = True

    # Updating -----------------------------------------------------------------------------

    def update(self, odom: Pose2, scan: PlanarScan) -> PoseEstimate | None:
        """Take a scan, if the robot has moved since the last one.

        Args:
            odom: Pose of the robot by odometry, when the scan was taken.
            scan: What the laser saw.

        Returns:
            The estimate if there is a new one.
        """
        first = self._odom is None
        if self._odom is not None:
            if not self._forced and not self._has_moved(odom):
                return None
            model = check_model(self.settings.odom_model_type)
            move_particles(self.filter.poses, self._odom, odom, model, self._alphas, self._random)
        self._odom = odom
        self._weigh(scan)
        self._updates = 0 if first else self._updates + 1
        resampled = self._updates % max(self.settings.resample_interval, 1) == 0
        if resampled and not first:
            self._resample()
        if not (resampled or first or self._forced):
            return None
        self._forced = False
        self.estimate = self.filter.estimate()
        self.map_to_odom = composed(_as_pose(self.estimate.pose), inverse(odom))
        return self.estimate

    def _has_moved(self, odom: Pose2) -> bool:
        before = self._odom or odom
        s = self.settings
        return (
            abs(odom[0] - before[0]) > s.update_min_d
            or abs(odom[1] - before[1]) > s.update_min_d
            or abs(wrapped(odom[2] - before[2])) > s.update_min_a
        )

    def _resample(self) -> None:
        enough = 0.5 * len(self.filter.poses)
        if not self.settings.selective_resampling or self.filter.effective() < enough:
            self.filter.resample(self.anywhere)

    def _weigh(self, scan: PlanarScan) -> None:
        """Weigh the particles by a scan."""
        s = self.settings
        most = min(scan.range_max, s.laser_max_range) if s.laser_max_range > 0 else scan.range_max
        least = max(scan.range_min, s.laser_min_range) if s.laser_min_range > 0 else scan.range_min
        step = max((len(scan.ranges) - 1) // max(s.laser_max_beams - 1, 1), 1)
        ranges, angles = scan.ranges[::step], scan.angles[::step]
        # The original takes what is too near for the greatest range.
        ranges = np.where(ranges <= least, most, ranges)
        ranges = np.where(np.isnan(ranges), np.inf, ranges)
        if s.laser_model_type == "beam":
            self._weigh_by_beams(np.minimum(ranges, most), angles, most, scan.laser)
        else:
            self._weigh_by_field(ranges, angles, most, scan.laser)

    def _weigh_by_field(self, ranges: Floats, angles: Floats, most: float, laser: Pose2) -> None:
        seen = ranges < most
        turned = angles[seen] + laser[2]
        points = np.stack(
            (
                laser[0] + ranges[seen] * np.cos(turned),
                laser[1] + ranges[seen] * np.sin(turned),
            ),
            axis=1,
        )
        field = self._field_for(most)
        if self.settings.laser_model_type == "likelihood_field_prob":
            logs = field.scores(self.filter.poses, points, 0.0)
            # A common factor changes no weights, and keeps them from vanishing.
            self.filter.weigh(np.exp(logs - logs.max()))
        else:
            self.filter.weigh(field.scores(self.filter.poses, points, 1.0))

    def _field_for(self, most: float) -> LikelihoodField:
        """The field of terms for a greatest range, made once."""
        if self._field is None or self._field[0] != most:
            s = self.settings
            squares = squared_distances((self._map.data == OCCUPIED).view(np.uint8))
            far = s.laser_likelihood_max_dist
            away = np.minimum(np.sqrt(squares) * self._map.resolution, far)

            def term(distance: Any) -> Any:
                p = s.laser_z_hit * np.exp(-(distance**2) / (2.0 * s.laser_sigma_hit**2))
                p = p + s.laser_z_rand / most
                return np.log(p) if s.laser_model_type == "likelihood_field_prob" else p**3

            origin = self._map.origin.x, self._map.origin.y
            field = LikelihoodField(
                term(away).astype(np.float32), origin, self._map.resolution, float(term(far))
            )
            self._field = most, field
        return self._field[1]

    def _weigh_by_beams(self, ranges: Floats, angles: Floats, most: float, laser: Pose2) -> None:
        s = self.settings
        model = BeamModel(
            (self._map.data != FREE).view(np.uint8),
            (self._map.origin.x, self._map.origin.y),
            self._map.resolution,
            np.array([s.laser_z_hit, s.laser_z_short, s.laser_z_max, s.laser_z_rand]),
            s.laser_sigma_hit,
            s.laser_lambda_short,
        )
        poses = self.filter.poses
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
        self.filter.weigh(model.scores(lasers, beams, most))


def _as_pose(values: Floats) -> Pose2:
    x, y, heading = values.tolist()
    return x, y, heading
