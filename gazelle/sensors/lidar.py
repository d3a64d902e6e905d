"""Laser range finders: all rays of all worlds cast in native code."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, UInts64, Worlds
from gazelle.description import Lidar, Pose, Scan
from gazelle.engines import Engine, RangeRays
from gazelle.errors import SimulationError
from gazelle.sensors.laser_scan import LaserScan
from gazelle.sensors.lidar_group import LidarGroup
from gazelle.sensors.lidar_ranges import LidarNoise, RangeLaw, measure
from gazelle.sensors.limits import check_interval, check_rays, check_worlds
from gazelle.sensors.model import SystemMaker
from gazelle.sensors.noise import NoiseModel

_NEAR = 1e-3  # rays are no shorter [m]


@checked(SimulationError, after=True)
class LidarModel:
    """Measures one lidar in every world.

    Rays start at ``range_min``, as Gazebo's do, so the scanner's own housing is not seen. Ranges
    are not rounded to the file's ``<resolution>``, as they are not in Gazebo classic, unless the
    description is ``quantized``.

    Args:
        lidar: Settings of the file.
        engine: Casts the rays.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random stream.
    """

    def __init__(
        self, lidar: Lidar, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        check_rays(lidar, name, engine.nworld)
        self.lidar = lidar
        self.engine = engine
        self.link = link
        self.angles = angles_of(lidar.horizontal)
        self.vertical_angles = angles_of(lidar.vertical)
        local = directions_of(self.angles, self.vertical_angles)
        rotation = pose.matrix()[:3, :3]
        self.directions = local @ rotation.T
        self.origins = np.asarray(pose.position) + lidar.range_min * self.directions
        self._noise = NoiseModel(lidar.noise, seed, name, engine.nworld, len(self.directions))
        reach = max(lidar.range_max - lidar.range_min, _NEAR)  # what is farther is not reported
        self.rays = RangeRays(link, self.origins, self.directions, reach)
        self.law = RangeLaw(lidar.range_min, lidar.range_max, lidar.quantum, *self._noise.rounding)
        self._alone: LidarGroup | None = None
        self._revision = -1  # of the engine that it was made for

    @property
    def samples(self) -> int:
        """Rays a measurement has, all rows together."""
        return len(self.directions)

    @property
    def rows(self) -> int:
        """Fans of rays above each other."""
        return len(self.vertical_angles)

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return ranges now [m], shape (n, samples), with the meaning of ``LaserScan.ranges``.

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        check_worlds(worlds, self.engine.nworld)
        check_interval(interval)
        noise = self._noise
        if worlds is None and not noise.drifts:
            return np.ascontiguousarray(self._own().measure_rows())
        table = self._own().table
        ranges = np.ascontiguousarray(table.cast(worlds)[:, 0])
        offset = self.lidar.range_min - table.begin
        if worlds is None or noise.drifts:
            return self._drifting(ranges + offset, interval, worlds)
        samples = ranges.shape[1]
        measured = np.empty((len(ranges), samples + samples % 2))
        stddev, keys, counters, bias = noise.tables(worlds)
        measure(self.law, LidarNoise(stddev, keys, counters, bias), ranges, offset, measured)
        noise.follow(worlds, counters)
        return measured[:, :samples]

    @property
    def by_system(self) -> bool:
        """True where a system of the engine measures it; else Python does."""
        return self._own().kernel is not None

    def system(self) -> SystemMaker | None:
        """Return what measures it with others of the same rays and law; None where none can."""
        if self._noise.drifts:
            return None
        rays, law = self.engine.range_kind(self.rays), self.law
        reported = law.low, law.high, law.quantum, law.mean, law.precision
        return (
            None if rays is None else SystemMaker(_group_of, (rays, reported, self._noise.biased))
        )

    def _own(self) -> LidarGroup:
        """Return the group of this lidar alone."""
        if self._alone is None or self._revision != self.engine.revision:
            noise = LidarNoise(*self._noise.tables())
            rays, begin = [self.rays], self.lidar.range_min
            self._alone = LidarGroup(self.engine, rays, self.law, begin, noise)
            self._revision = self.engine.revision  # which making the table may change
        return self._alone

    def move_noise(self, stddev: Floats, keys: UInts64, counters: UInts64, bias: Floats) -> None:
        """Store the noise's state in other arrays from now on; see ``NoiseModel.move``."""
        self._noise.move(stddev, keys, counters, bias)
        self._alone, self._revision = None, -1

    def _drifting(self, true: Floats, interval: float, worlds: Worlds | None) -> Floats:
        """Return a measurement of true ranges with noise of changing bias."""
        lidar, measured = self.lidar, self._noise.apply(true, interval, worlds)
        if lidar.quantum > 0.0:
            measured = np.rint(measured / lidar.quantum) * lidar.quantum
        measured = np.clip(measured, lidar.range_min, lidar.range_max)
        measured[true >= lidar.range_max] = np.inf
        measured[true == -np.inf] = -np.inf
        return measured

    def scan(self, ranges: Floats, stamp: int) -> LaserScan:
        """Return a measurement as a ``LaserScan``."""
        count = len(self.angles)
        first, last = float(self.angles[0]), float(self.angles[-1])
        increment = (last - first) / (count - 1) if count > 1 else 0.0
        return LaserScan(
            stamp, ranges, first, last, increment, self.lidar.range_min, self.lidar.range_max
        )

    def reading(self, values: Floats, stamp: int) -> LaserScan:
        """Return the same as ``scan``, under the name that all sensors have it."""
        return self.scan(values, stamp)

    @property
    def noise(self) -> NoiseModel:
        """The noise on the ranges."""
        return self._noise

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Set the seed of the random numbers and start them again."""
        self._noise.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Discard drifts of noise."""
        self._noise.reset(worlds)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return self._noise.state()

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._noise.restore(state)


def angles_of(scan: Scan) -> Floats:
    """Return angles of a fan's rays [rad], both ends included.

    The shape is (round(samples * resolution),).

    Gazebo casts ``samples`` rays and interpolates to ``samples * resolution`` points; here
    every reported point has a ray of its own.
    """
    count = max(1, round(scan.samples * scan.resolution))
    if count == 1:
        return np.array([scan.min_angle])
    return np.linspace(scan.min_angle, scan.max_angle, count)


def directions_of(horizontal: Floats, vertical: Floats) -> Floats:
    """Return unit vectors in the sensor frame, row by row, shape (rows * samples, 3)."""
    yaw, pitch = np.meshgrid(horizontal, vertical)
    directions = np.stack(
        (np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)), axis=-1
    )
    return directions.reshape(-1, 3)


def _group_of(models: Sequence[LidarModel]) -> LidarGroup:
    """Return what measures lidars at once; their noise is in its tables from then on."""
    first, rays = models[0], [each.rays for each in models]
    noise = LidarNoise(*_joined_noise(models))
    return LidarGroup(first.engine, rays, first.law, first.lidar.range_min, noise)


def _joined_noise(models: Sequence[LidarModel]) -> tuple[Floats, UInts64, UInts64, Floats]:
    """Return what native code draws the noise of lidars with, a row for each world and lidar."""
    first = models[0]
    biased = first.noise.biased
    shape = first.engine.nworld, len(models)
    stddev, bias = np.zeros(shape), np.zeros((*shape, first.samples if biased else 0))
    keys, counters = np.zeros(shape, np.uint64), np.zeros(shape, np.uint64)
    for i, each in enumerate(models):
        each.move_noise(stddev[:, i : i + 1], keys[:, i], counters[:, i], bias[:, i])
    biases = bias.reshape(stddev.size, -1) if biased else np.zeros((0, 0))
    return stddev.reshape(-1), keys.reshape(-1), counters.reshape(-1), biases
