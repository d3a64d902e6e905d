"""Localization on a map by odometry and laser, as in ``amcl``."""

from __future__ import annotations

import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats
from gazelle.description.occupancy import FREE, OccupancyMap
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped
from gazelle.navigation.following import Pose2
from gazelle.navigation.localization.odometry_models import check_model, move_particles
from gazelle.navigation.localization.particle_filter import ParticleFilter, PoseEstimate
from gazelle.navigation.localization.scan_model import PlanarScan, ScanModel
from gazelle.navigation.localization.search import count_for, draw_fitting
from gazelle.navigation.localization.settings import AmclSettings
from gazelle.navigation.planners.planar import composed, inverse


@checked(Error, after=True)
class Localizer:
    """Keeps particles of where a robot may be on a map.

    Args:
        settings: As of ``amcl``.
        grid: The map.
        seed: Of all that is drawn.

    Attributes:
        filter: The particles.
        estimate: Last common estimate.
        map_to_odom: Pose of the odometry's frame on the map.
    """

    def __init__(self, settings: AmclSettings, grid: OccupancyMap, seed: int = 0) -> None:
        self._random = np.random.default_rng(seed)
        self._odom: Pose2 | None = None
        self._forced = False
        self._searching = False
        self._updates = 0
        self.settings = settings
        self.estimate: PoseEstimate | None = None
        self.map_to_odom: Pose2 | None = None
        self.set_map(grid)
        self.configure(settings)
        self.begin((0.0, 0.0, 0.0), np.diag([0.25, 0.25, (math.pi / 12.0) ** 2]))

    def configure(self, settings: AmclSettings) -> None:
        """Set the parameters; a filter of another size restarts around its estimate."""
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
        self._model = ScanModel(s, self._map)
        self._alphas = np.array([getattr(s, f"odom_alpha{i}") for i in range(1, 6)])
        if self.estimate is not None:
            self.begin(_as_pose(self.estimate.pose), self.estimate.covariance)

    def set_map(self, grid: OccupancyMap) -> None:
        """Set another map."""
        self._map = grid
        self._model = ScanModel(self.settings, grid)
        self._free = np.argwhere(grid.data == FREE)

    # Beginning ----------------------------------------------------------------------------

    def begin(self, pose: Pose2, covariance: Floats) -> None:
        """Initialise around a pose, covariance shape (3, 3)."""
        self.filter.spread(np.array(pose), covariance)
        self._odom = None
        self._searching = False

    def begin_anywhere(self) -> None:
        """Initialise with particles all over the free cells of the map.

        The first scan then decides where they are: see `draw_fitting`.
        """
        self.filter.begin(self.anywhere(self.settings.max_particles))
        self._odom = None
        self._searching = True

    def anywhere(self, count: int) -> Floats:
        """Return random poses on free cells, shape (count, 3)."""
        poses = np.zeros((count, 3))
        if len(self._free):
            chosen = self._free[self._random.integers(len(self._free), size=count)]
            corner = np.array([self._map.origin.x, self._map.origin.y])
            poses[:, :2] = corner + (chosen[:, ::-1] + 0.5) * self._map.resolution
        poses[:, 2] = self._random.uniform(-math.pi, math.pi, count)
        return poses

    def force_update(self) -> None:
        """Process the next scan even if the robot has not moved."""
        self._forced = True

    # Updating -----------------------------------------------------------------------------

    def update(self, odom: Pose2, scan: PlanarScan) -> PoseEstimate | None:
        """Process a scan, if the robot has moved since the last one.

        Args:
            odom: Pose of the robot by odometry, when the scan was taken.
            scan: Laser scan.

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
        if self._searching:
            self._search(scan)
        else:
            converged = self.filter.converged
            self.filter.weigh(self._model.scores(self.filter.poses, scan, converged=converged))
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

    def _search(self, scan: PlanarScan) -> None:
        """Initialise where the scan fits, out of many more poses than particles."""
        self._searching = False
        candidates = self.anywhere(count_for(len(self._free) * self._map.resolution**2))
        self.filter.begin(
            draw_fitting(
                candidates,
                lambda poses: self._model.scores(poses, scan),
                self.settings.max_particles,
                self._random,
            )
        )

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


def _as_pose(values: Floats) -> Pose2:
    x, y, heading = values.tolist()
    return x, y, heading
