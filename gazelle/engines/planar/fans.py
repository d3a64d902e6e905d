"""Fans of beams on bodies: lidars, sonars and whatever looks along rays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked, indices, world_indices
from gazelle.array_types import Floats, Worlds
from gazelle.engines.limits import MAX_RAYS, MAX_VALUES
from gazelle.engines.planar import columns as c
from gazelle.engines.planar.beams import Beams
from gazelle.engines.planar.clear_space import ClearSpace
from gazelle.engines.planar.fan_scanner import FanScanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.lanes import Lanes
from gazelle.engines.planar.scan_columns import ALL, CROWDED, SINGLY
from gazelle.engines.planar.small_scene import front_faces_of
from gazelle.engines.planar.viewpoint import Viewpoint
from gazelle.errors import EngineError
from gazelle.native.system import System
from gazelle.streams import seed_of

_ANGLES = 5e-5  # how wrong the kernels' angles may be [rad]
_SIDE_BY_SIDE = 32  # beams of a bundle
_FEW_BEAMS = 8  # of a fan with beams cast one by one
_MANY = 256  # statics in view from which it pays to find out which ones are hidden
_SHARE = 4000  # beams that are worth a thread


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class Fan:
    """Beams from one point, at equal angles.

    Attributes:
        start: Angle of the first beam from the sensor's x axis [rad].
        step: Angle between two beams, counter-clockwise [rad].
        count: Number of beams.
        reach: Range [m].
        begin: Nearest range [m].

    Raises:
        EngineError: A number is invalid.
    """

    start: float
    step: float
    count: int
    reach: float
    begin: float = 0.0

    @classmethod
    def spread(cls, fov: float, count: int, reach: float, begin: float = 0.0) -> Fan:
        """Return beams over a field of view [rad] about the x axis, from edge to edge."""
        step = fov / (count - 1) if count > 1 else 1.0
        return cls(-fov / 2.0 if count > 1 else 0.0, step, count, reach, begin)

    @property
    def angles(self) -> Floats:
        """Angles from the sensor's x axis [rad], shape (count,)."""
        angles: Floats = self.start + self.step * np.arange(self.count, dtype=np.float64)
        return angles


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class Mount:
    """Mount of a sensor on a body.

    Attributes:
        body: Index of the body.
        x: In the body's frame [m].
        y: In the body's frame [m].
        yaw: Of its x axis in the body's frame [rad].
        z: Height above the body's frame [m].

    Raises:
        EngineError: A number is invalid.
    """

    body: int
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    z: float = 0.0


@checked(EngineError)
@dataclass(frozen=True, slots=True)
class RangeNoise:
    """Normal noise on ranges: of standard deviation ``constant`` [m] plus ``share`` of them.

    Raises:
        EngineError: A number is negative, or is invalid.
    """

    constant: float = 0.0
    share: float = 0.0

    def __post_init__(self) -> None:
        if min(self.constant, self.share) < 0.0:
            raise EngineError(f"noise on ranges must not be negative: {self}")


@checked(EngineError, most=math.inf)
class Scanner:
    """The same fan on some bodies of a fleet.

    Args:
        fleet: Fleet of the rays.
        fan: The beams.
        mounts: Mounts of the sensors, the same in all worlds.
        named: Whether to remember what each beam met.
        noise: On the ranges; None for none.
        seed: Of the noise, any int.
        missing: Range of a beam that meets nothing [m]; the fan's reach if None.
        signed: Whether what a beam meets from inside has the range minus infinity.

    Attributes:
        ranges: Of the last scan [m], shape (nworld, mounts, count).
        names: Names that the beams met, as of ``columns.NAMES``, a row a sensor, if ``named``.
        owners: Body of each sensor, counted through all worlds, shape (nworld * mounts,).
        tick: Number of scans requested one by one so far; the noise of a scan depends on it.

    Raises:
        EngineError: The fan is invalid, there is no such body, or a number is invalid.
    """

    def __init__(
        self,
        fleet: Fleet,
        fan: Fan,
        mounts: Sequence[Mount],
        *,
        named: bool = False,
        noise: RangeNoise | None = None,
        seed: int = 0,
        missing: float | None = None,
        signed: bool = False,
    ) -> None:
        _check(fan, fleet, len(mounts))
        self.fleet, self.fan = fleet, fan
        self.noise, self.seed, self.tick = noise, seed_of(seed), 0
        self._mounts = np.array(
            [[m.x, m.y, math.cos(m.yaw), math.sin(m.yaw), m.z] for m in mounts]
        ).reshape(-1, c.SENSOR)
        bodies = [mount.body for mount in mounts]
        self._carriers = indices("bodies", bodies, fleet.nbody, EngineError).astype(np.int64)
        self.owners = self._owners_in(np.arange(fleet.nworld))
        self._outline, self._middles = _outline(fan), _middles_of(fan)
        least = 2 * max(1, _SHARE // fan.count)
        self._alone = fleet.pool.size == 1 or len(self.owners) < least
        total = fleet.nworld * len(mounts)
        self.ranges = np.zeros((fleet.nworld, len(mounts), fan.count))
        self._flat = self.ranges.reshape(-1, fan.count)
        self.names = np.zeros((total if named else 0, fan.count))
        self._share = _SHARE
        self._missing, self._signed = fan.reach if missing is None else missing, signed
        self._native = self._native_of(self._way())

    def _way(self) -> int:
        """Return the fastest way of scanning here."""
        scene = self.fleet.scene
        if scene.cells > 1 and self.fan.count <= _FEW_BEAMS:
            return SINGLY
        return CROWDED if scene.cells > 1 and len(scene.items) > _MANY else ALL

    def _native_of(self, way: int, *, solid: bool = True) -> FanScanner:
        """Return one native scanner for each thread, linked."""
        fleet, fan = self.fleet, self.fan
        there = None
        if way != ALL:
            clear = fleet.scene.clearing(solid=solid and fan.begin == 0.0)
            there = ClearSpace(clear.fine, clear.start, clear.items, clear.clear)
        tables, made = fleet.bodies, None
        for _ in range(fleet.pool.size):
            beams = Beams(fan.angles, fan.step, fan.reach, fan.begin, _ANGLES)
            front = None if way != ALL or len(self.names) else front_faces_of(fleet)
            own = FanScanner(
                beams,
                Viewpoint(tables, beams, self._outline),
                None if there is None else Lanes(there, tables, fan.begin),
                front,
                self._mounts,
                self._middles,
            )
            own.next, own.way, own.step = made, way, fan.step
            own.owners, own.ranges, own.names = self.owners, self._flat, self.names
            own.missing, own.signed, own.seed = self._missing, self._signed, self.seed % 2**63
            if self.noise is not None:
                own.constant, own.share = self.noise.constant, self.noise.share
            made = own
        return own

    @cached_property
    def mounts(self) -> list[Mount]:
        """Mounts of the fans, in one world."""
        mounted = zip(self._carriers.tolist(), self._mounts.tolist(), strict=True)
        return [Mount(body, x, y, math.atan2(sin, cos), z) for body, (x, y, cos, sin, z) in mounted]

    @property
    def flat_ranges(self) -> Floats:
        """``ranges`` with one row a sensor, shape (nworld * mounts, count)."""
        return self._flat

    @checked(EngineError, after=True)
    def scan(self, worlds: Worlds | None = None) -> Floats:
        """Return distances now [m], shape (n, mounts, count).

        The fan's reach where nothing is met.

        The array is used again by the next scan.

        Args:
            worlds: Worlds; all if None.

        Raises:
            EngineError: There is no such world, or they are more than there are.
        """
        owners, count = self.owners, self.fleet.nworld
        if worlds is not None:
            which, most = world_indices(worlds, count, EngineError), count
            owners, count = self._owners_in(which), len(which)
            if count > most:
                raise EngineError(f"a scanner scans in {most} worlds, not in {count}")
        if self._alone and worlds is None:
            self._native.scan(owners, 0, len(owners), self.tick, 0)
        else:
            least, native, tick = max(1, self._share // self.fan.count), self._native, self.tick
            self.fleet.pool.share(
                lambda a, b, part: native.scan(owners, a, b, tick, part), len(owners), least
            )
        self.tick += 1
        return self.ranges if worlds is None else self.ranges[:count]

    @property
    def system(self) -> System:
        """System that scans everywhere; its time counts scans, on which noise depends."""
        return self._native

    # -- what was met ------------------------------------------------------------------

    def bodies(self) -> NDArray[np.int64]:
        """Return the index of the body that each beam met.

        -1 for a static or nothing, shape as ``ranges``.
        """
        met = np.abs(self._named()) // c.NAMES
        return np.where(met > 0.0, (met - 1.0) % max(self.fleet.nbody, 1), -1.0).astype(np.int64)

    def glows(self, sensor: int | None = None) -> Floats:
        """Return the laser return of what each beam met; 0 for nothing.

        Args:
            sensor: Of one, counted through all worlds, shape (count,); of all if None, shape as
                ``ranges``.

        Raises:
            EngineError: There is no such sensor, or it does not remember what beams met.
        """
        table, visuals = self.fleet.scene.table.rows, self.fleet.visuals
        names = self._named()
        if sensor is not None:
            (row,) = indices("sensors", [sensor], len(self.names), EngineError)
            names = self.names[row]
        return np.asarray(_look_up(names, table[:, c.GLOW], visuals[:, c.GLOW]), np.float64)

    def tags(self) -> NDArray[np.int64]:
        """Return the tag of the part that each beam met; 0 for nothing, shape as ``ranges``."""
        found = _look_up(self._named(), self.fleet.scene.table.tags, self.fleet.tags)
        return np.asarray(found, np.int64)

    def _named(self) -> Floats:
        if not len(self.names):
            raise EngineError(
                "the scanner stores no ids of hit bodies", hint="create it with named=True"
            )
        return self.names.reshape(self.ranges.shape)

    def _owners_in(self, worlds: Worlds) -> NDArray[np.int64]:
        rows = worlds[:, None] * self.fleet.nbody + self._carriers
        return np.ascontiguousarray(rows.ravel(), np.int64)


def _look_up(names: Floats, statics: NDArray[Any], visuals: NDArray[Any]) -> NDArray[Any]:
    """Return the values of the primitives that were met; 0 for nothing."""
    names = np.abs(names)
    found = np.zeros(names.shape, statics.dtype)
    static, moving = (names > 0.0) & (names < c.NAMES), names >= c.NAMES
    found[static] = statics[names[static].astype(np.int64) - 1]
    found[moving] = visuals[(names[moving] % c.NAMES).astype(np.int64)]
    return found


def _check(fan: Fan, fleet: Fleet, mounts: int) -> None:
    if fan.count < 1 or not fan.step > 0.0 or fan.step * (fan.count - 1) > 2.0 * math.pi + 1e-3:
        raise EngineError("a fan needs beams at growing angles, once around at most")
    if not (0.0 <= fan.begin < fan.reach < math.inf):
        raise EngineError("a fan needs a finite reach beyond where its beams begin")
    if fan.count > MAX_RAYS or fan.count * mounts * fleet.nworld > MAX_VALUES:
        raise EngineError(
            f"{mounts} fans of {fan.count} beams in {fleet.nworld} worlds are too many",
            hint=f"a fan may have {MAX_RAYS:,} beams, all of them in all worlds {MAX_VALUES:,}",
        )


def _middles_of(fan: Fan) -> Floats:
    """Return the middle directions of bundles of beams, shape (2, n)."""
    first = np.arange(0, fan.count, _SIDE_BY_SIDE)
    angles = fan.start + fan.step * (first + 0.5 * (_SIDE_BY_SIDE - 1))
    return np.stack((np.cos(angles), np.sin(angles)))


def _outline(fan: Fan) -> Floats:
    """Return corners of a convex polygon around all that a fan can see, in the sensor's frame."""
    span = fan.step * (fan.count - 1)
    if span > math.pi + _ANGLES:
        angles = np.arange(8) * (math.pi / 4.0)
        far = fan.reach / math.cos(math.pi / 8.0)
        return np.stack((far * np.cos(angles), far * np.sin(angles)), axis=1)
    pieces = max(1, math.ceil(span / (math.pi / 3.0) - _ANGLES))
    angles = fan.start + np.linspace(0.0, span, pieces + 1)
    far = fan.reach / math.cos(span / pieces / 2.0)
    arc = np.stack((far * np.cos(angles), far * np.sin(angles)), axis=1)
    return np.vstack((np.zeros((1, 2)), arc))
