"""Map and place at once, by particles with a map each: what ``gmapping`` does."""

# ruff: noqa: N815  # the parameters are called so

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


@checked(Error)
@dataclass(frozen=True, slots=True)
class GmappingSettings:
    """Parameters; names and defaults are those of ``slam_gmapping``."""

    maxUrange: float = 0.0
    maxRange: float = 0.0
    sigma: float = 0.05
    kernelSize: int = 1
    lstep: float = 0.05
    astep: float = 0.05
    iterations: int = 5
    lsigma: float = 0.075
    ogain: float = 3.0
    lskip: int = 0
    minimumScore: float = 0.0
    srr: float = 0.1
    srt: float = 0.2
    str: float = 0.1
    stt: float = 0.2
    linearUpdate: float = 1.0
    angularUpdate: float = 0.5
    temporalUpdate: float = -1.0
    resampleThreshold: float = 0.5
    particles: int = 30
    xmin: float = -100.0
    ymin: float = -100.0
    xmax: float = 100.0
    ymax: float = 100.0
    delta: float = 0.05
    occ_thresh: float = 0.25

    @classmethod
    def read(cls, values: Values) -> GmappingSettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind, or the map would be none.
        """
        return cls(**fields_of(cls, values))

    def __post_init__(self) -> None:
        if not self.delta > 0.0 or self.xmax <= self.xmin or self.ymax <= self.ymin:
            raise Error(
                "a map needs a positive 'delta', and 'xmin' below 'xmax', 'ymin' below 'ymax'"
            )
        if self.particles < 1:
            raise Error("'particles' is 1 or more")
        columns, rows = (self.xmax - self.xmin) / self.delta, (self.ymax - self.ymin) / self.delta
        check_maps(self.particles, columns, rows)


@checked(Error, after=True)
class GridSlam:
    """Particles with a pose and a map each.

    Args:
        settings: As of ``gmapping``.
        seed: Of all that is drawn.

    Attributes:
        poses: Of the robot on each particle's map, shape (n, 3).
        map_to_odom: Pose of the odometry's frame on the best map; None before the first scan.
    """

    def __init__(self, settings: GmappingSettings, seed: int = 0) -> None:
        self.settings = settings
        s = settings
        self._random = np.random.default_rng(seed)
        side = s.delta * SIDE
        columns = math.ceil((s.xmax - s.xmin) / side)
        rows = math.ceil((s.ymax - s.ymin) / side)
        self._maps = TiledMaps(s.particles, rows, columns, (s.xmin, s.ymin), s.delta)
        # As in the original, sigma divides squares of distances.
        self._matcher = ScanMatcher(self._maps, s.sigma, s.lsigma, s.kernelSize)
        self.poses: Floats = np.zeros((s.particles, 3))
        self._scores: Floats = np.zeros(s.particles)
        self._sums: Floats = np.zeros(s.particles)
        self.weights: Floats = np.full(s.particles, 1.0 / s.particles)
        self.map_to_odom: Pose2 | None = None
        self._odom: Pose2 | None = None
        self._distance = self._turn = 0.0
        self._time = -math.inf

    @property
    def best(self) -> int:
        """The particle with the greatest weight over all scans."""
        return int(self._sums.argmax())

    def entropy(self) -> float:
        """Return the entropy of the particles' weights, as ``~entropy`` publishes it."""
        weights = self.weights[self.weights > 0.0]
        return float(-(weights * np.log(weights)).sum())

    def update(
        self,
        time: float,
        odom: Pose2,
        ranges: Floats,
        angles: Floats,
        range_max: float,
        laser: Pose2,
    ) -> bool:
        """Process a scan, if the robot has moved or some time has passed.

        Args:
            time: Of the scan [s].
            odom: Pose of the robot by odometry then.
            ranges: [m], shape (n,).
            angles: Of beams in the laser's frame [rad], shape (n,).
            range_max: Greatest range of the laser [m].
            laser: Its pose in the robot's frame.

        Returns:
            Whether the maps have changed.

        Raises:
            Error: The time is not finite, or the greatest range NaN.
        """
        if not (math.isfinite(time) and range_max >= 0.0):
            raise Error(
                f"a scan is of a time, and sees so far, not {time!r:.60}, {range_max!r:.60}"
            )
        s = self.settings
        first = self._odom is None
        if first:
            # As in the original, the map begins where odometry does.
            self.poses[:] = odom
        before = odom if self._odom is None else self._odom
        self._move(before, odom)
        self._odom = odom
        step = between(before, odom)
        self._distance += math.hypot(step[0], step[1])
        self._turn += abs(step[2])
        late = s.temporalUpdate >= 0.0 and time - self._time > s.temporalUpdate
        if not (first or late or self._distance >= s.linearUpdate or self._turn >= s.angularUpdate):
            return False
        self._distance = self._turn = 0.0
        self._time = time
        most = s.maxRange if s.maxRange > 0.0 else range_max
        usable = s.maxUrange if s.maxUrange > 0.0 else most
        good = np.isfinite(ranges) & (ranges > 0.0) & (ranges < most)
        beams = np.stack(
            (ranges[good] * np.cos(angles[good]), ranges[good] * np.sin(angles[good])), axis=1
        )
        if first:
            self._register(beams, usable, laser)
        else:
            self._match(beams[ranges[good] < usable], laser)
            self._weigh()
            self._resample()
            self._register(beams, usable, laser)
        self._place(odom)
        return True

    def _move(self, before: Pose2, after: Pose2) -> None:
        """Move particles as odometry did, with noise (gmapping's motion model)."""
        s = self.settings
        x, y, turn = between(before, after)
        length = math.hypot(x, y)
        sxy = 0.3 * s.srr
        sigmas = (
            s.srr * abs(x) + s.str * abs(turn) + sxy * abs(y),
            s.srr * abs(y) + s.str * abs(turn) + sxy * abs(x),
            s.stt * abs(turn) + s.srt * length,
        )
        noise = self._random.standard_normal((3, len(self.poses)))
        dx, dy = x + sigmas[0] * noise[0], y + sigmas[1] * noise[1]
        cos, sin = np.cos(self.poses[:, 2]), np.sin(self.poses[:, 2])
        self.poses[:, 0] += cos * dx - sin * dy
        self.poses[:, 1] += sin * dx + cos * dy
        self.poses[:, 2] += turn + sigmas[2] * noise[2]

    def _match(self, beams: Floats, laser: Pose2) -> None:
        """Move each particle to where the scan fits its map, and weigh it."""
        s = self.settings
        used = np.ascontiguousarray(beams[:: s.lskip + 1])
        logs = np.zeros(len(self.poses))
        back = inverse(laser)
        for particle, pose in enumerate(self.poses):
            x, y, heading = pose.tolist()
            seen = np.array(composed((x, y, heading), laser))
            found = seen.copy()
            score = self._matcher.match(particle, found, used, s.lstep, s.astep, s.iterations)
            if score <= s.minimumScore:
                # It keeps the pose of odometry.
                found = seen
            logs[particle] = self._matcher.likelihood(particle, found, used)
            x, y, heading = found.tolist()
            self.poses[particle] = composed((x, y, heading), back)
        self._scores, self._sums = self._scores + logs, self._sums + logs

    def _weigh(self) -> None:
        """Compute weights from likelihoods since the last resampling, flattened by ``ogain``."""
        s = self.settings
        gain = 1.0 / (s.ogain * len(self.poses))
        weights = np.exp(gain * (self._scores - self._scores.max()))
        self.weights = weights / weights.sum()

    def _resample(self) -> None:
        """Resample particles when few of them have weight."""
        count = len(self.poses)
        if 1.0 / (self.weights**2).sum() >= self.settings.resampleThreshold * count:
            return
        start = self._random.random() / count
        places = np.searchsorted(np.cumsum(self.weights), start + np.arange(count) / count)
        chosen = np.minimum(places, count - 1)
        self.poses, self._scores = self.poses[chosen].copy(), np.zeros(count)
        self._sums = self._sums[chosen]
        self._maps.copy_particles(chosen)
        self.weights = np.full(count, 1.0 / count)

    def _register(self, beams: Floats, usable: float, laser: Pose2) -> None:
        for particle, pose in enumerate(self.poses):
            x, y, heading = pose.tolist()
            seen = np.array(composed((x, y, heading), laser))
            self._maps.register(particle, seen, beams, usable)

    def _place(self, odom: Pose2) -> None:
        x, y, heading = self.poses[self.best].tolist()
        self.map_to_odom = composed((x, y, wrapped(heading)), inverse(odom))

    def map(self) -> OccupancyMap:
        """Return the best particle's map, of all that it may hold."""
        s = self.settings
        _, _, hits, visits = self._maps.cells(self.best)
        data = np.full(hits.shape, UNKNOWN, np.int8)
        seen = visits > 0
        share = hits[seen] / visits[seen]
        data[seen] = np.where(share > s.occ_thresh, OCCUPIED, FREE)
        return OccupancyMap(data, s.delta, Pose(s.xmin, s.ymin))
