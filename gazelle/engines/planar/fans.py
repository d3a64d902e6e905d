"""Fans of beams on bodies: lidars, sonars and whatever looks along rays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.native import Call, Function
from gazelle.engines.planar import columns as c
from gazelle.engines.planar import kernels_noise
from gazelle.engines.planar.fleet import Fleet
from gazelle.engines.planar.kernels_front import MANY, scan_crowded
from gazelle.engines.planar.kernels_march import LANES, SIDE_BY_SIDE
from gazelle.engines.planar.kernels_scan import scan
from gazelle.engines.planar.kernels_walk import FEW_BEAMS, scan_singly
from gazelle.errors import EngineError

_ANGLES = 5e-5  # how wrong the kernels' angles may be [rad]
_BLOCK = 64  # primitives that are prepared at once; more than make a grid worth it
_CROWD = 128  # bodies that are sorted at once
_SHARE = 4000  # beams that are worth a thread


@dataclass(frozen=True, slots=True)
class Fan:
    """Beams from one point, at equal angles.

    Attributes:
        start: Angle of the first beam from the sensor's x axis [rad].
        step: Angle between two beams, counter-clockwise [rad].
        count: Number of beams.
        reach: How far they go [m].
        begin: What is nearer is not met [m].

    Raises:
        EngineError: A number is not finite.
    """

    start: float
    step: float
    count: int
    reach: float
    begin: float = 0.0

    def __post_init__(self) -> None:
        numbers = (self.start, self.step, self.reach, self.begin)
        if not all(map(math.isfinite, numbers)):
            raise EngineError(f"the angles and distances of a fan must be finite: {self}")

    @classmethod
    def spread(cls, fov: float, count: int, reach: float, begin: float = 0.0) -> Fan:
        """Beams over a field of view [rad] about the x axis, from edge to edge."""
        step = fov / (count - 1) if count > 1 else 1.0
        return cls(-fov / 2.0 if count > 1 else 0.0, step, count, reach, begin)

    @property
    def angles(self) -> Floats:
        """From the sensor's x axis [rad], shape (count,)."""
        angles: Floats = self.start + self.step * np.arange(self.count, dtype=np.float64)
        return angles


@dataclass(frozen=True, slots=True)
class Mount:
    """Where a sensor is on a body.

    Attributes:
        body: Index of the body.
        x: In the body's frame [m].
        y: In the body's frame [m].
        yaw: Of its x axis in the body's frame [rad].
        z: Height above the body's frame [m].
    """

    body: int
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    z: float = 0.0

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, (self.x, self.y, self.yaw, self.z))):
            raise EngineError(f"the place of a sensor must be finite: {self}")


@dataclass(frozen=True, slots=True)
class RangeNoise:
    """Normal noise on ranges: of standard deviation ``constant`` [m] plus ``share`` of them."""

    constant: float = 0.0
    share: float = 0.0

    def __post_init__(self) -> None:
        if not (0.0 <= self.constant < math.inf and 0.0 <= self.share < math.inf):
            raise EngineError(f"noise on ranges must be finite and not negative: {self}")


@dataclass(frozen=True, slots=True)
class _Scratch:
    """What a thread writes on while it scans."""

    beams: Floats
    view: Floats
    stamp: NDArray[np.int64]
    begins: Floats
    walls: Floats = field(default_factory=lambda: np.zeros((9, _BLOCK)))
    others: Floats = field(default_factory=lambda: np.zeros((18, _CROWD)))
    going: Floats = field(default_factory=lambda: np.zeros(LANES))


class Scanner:
    """The same fan on some bodies of a fleet.

    Args:
        fleet: What it looks at.
        fan: The beams.
        mounts: Where they start, the same in all worlds.
        named: Whether to remember what each beam met.
        noise: On the ranges; None for none.
        seed: Of the noise.

    Attributes:
        ranges: Of the last scan [m], shape (nworld, mounts, count).
        names: What each beam met, as ``columns.NAMES`` says, a row a sensor, if ``named``.
        owners: Body of each sensor, counted through all worlds, shape (nworld * mounts,).
        tick: Number of scans asked for one by one so far; the noise of a scan depends on it.

    Raises:
        EngineError: The fan cannot be, or there is no such body.
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
    ) -> None:
        _check(fan, fleet, mounts)
        self.fleet, self.fan = fleet, fan
        self.noise, self.seed, self.tick = noise, seed, 0
        self._mounts = np.array(
            [[m.x, m.y, math.cos(m.yaw), math.sin(m.yaw), m.z] for m in mounts]
        ).reshape(-1, c.SENSOR)
        self._carriers = np.array([mount.body for mount in mounts], np.int64)
        self.owners = self._owners_in(np.arange(fleet.nworld))
        begin = 1.0 / fan.begin if fan.begin > 0.0 else math.inf
        self._fan = np.array([fan.start, 1.0 / fan.step, fan.reach, begin, _ANGLES])
        beams = np.zeros((4, fan.count))
        beams[0], beams[1] = np.cos(fan.angles), np.sin(fan.angles)
        self._outline = _outline(fan)
        statics = len(fleet.scene.table.rows)
        self._scratch = [
            _Scratch(
                beams.copy(),
                np.zeros_like(self._outline),
                np.zeros(statics + 1, np.int64),
                np.zeros(-(-fan.count // SIDE_BY_SIDE)),
            )
            for _ in range(fleet.crew.size)
        ]
        self._look = _look_of(fan, fleet)
        self._tails: dict[int, tuple[Any, ...]] = {}
        least = 2 * max(1, _SHARE // fan.count)
        self._alone = fleet.crew.size == 1 or len(self.owners) < least
        self._middles = _middles_of(fan)
        if self._look is not scan:
            self._clearing = fleet.scene.clearing(solid=fan.begin == 0.0)
        total = fleet.nworld * len(mounts)
        self._sensors = np.zeros((total, c.SENSOR))
        self.ranges = np.zeros((fleet.nworld, len(mounts), fan.count))
        self._flat = self.ranges.reshape(-1, fan.count)
        self.names = np.zeros((total if named else 0, fan.count))

    @cached_property
    def mounts(self) -> list[Mount]:
        """Where the fans are, in one world."""
        carried = zip(self._carriers.tolist(), self._mounts.tolist(), strict=True)
        return [Mount(body, x, y, math.atan2(sin, cos), z) for body, (x, y, cos, sin, z) in carried]

    @property
    def flat_ranges(self) -> Floats:
        """``ranges`` with one row a sensor, shape (nworld * mounts, count)."""
        return self._flat

    def scan(self, worlds: Worlds | None = None) -> Floats:
        """Distances now [m], shape (n, mounts, count); the fan's reach where nothing is met.

        The array is used again by the next scan.

        Args:
            worlds: Which worlds; all if None.
        """
        owners, count = self.owners, self.fleet.nworld
        if worlds is not None:
            owners, count = self._owners_in(worlds), len(worlds)
        if self._alone and worlds is None:
            self._work(0, len(owners), 0)
        else:
            least = max(1, _SHARE // self.fan.count)
            other = None if worlds is None else owners
            self.fleet.crew.share(
                lambda a, b, part: self._work(a, b, part, other), len(owners), least
            )
        self.tick += 1
        return self.ranges if worlds is None else self.ranges[:count]

    def call(self) -> Call | None:
        """What scans everywhere where one thread does all; None if that is not all there is."""
        if not self._alone or self.noise is not None:
            return None
        return self._look, (0, len(self.owners), *self._tail_of(0))

    def _tail_of(self, part: int) -> tuple[Any, ...]:
        """The tail for the sensors there are, kept."""
        if part not in self._tails:
            self._tails[part] = self._tail(part, self.owners)
        return self._tails[part]

    def _work(
        self, first: int, last: int, part: int, owners: NDArray[np.int64] | None = None
    ) -> None:
        """Scan with the sensors first to last, by one thread; of other ``owners`` than all."""
        tail = self._tail_of(part) if owners is None else self._tail(part, owners)
        self._look(first, last, *tail)
        if self.noise is not None:
            own = self.owners if owners is None else owners
            constant, share = self.noise.constant, self.noise.share
            kernels_noise.blur(
                first, last, own, self._flat, self._fan, constant, share, self.seed, self.tick
            )

    # -- what was met ------------------------------------------------------------------

    def bodies(self) -> NDArray[np.int64]:
        """Index of the body that each beam met; -1 for a static or nothing, shape as ``ranges``."""
        met = np.abs(self._named()) // c.NAMES
        return np.where(met > 0.0, (met - 1.0) % max(self.fleet.nbody, 1), -1.0).astype(np.int64)

    def glows(self) -> Floats:
        """What a laser got back from what each beam met; 0 for nothing, shape as ``ranges``."""
        table, looks = self.fleet.scene.table.rows, self.fleet.looks
        return np.asarray(self._look_up(table[:, c.GLOW], looks[:, c.GLOW]), np.float64)

    def tags(self) -> NDArray[np.int64]:
        """Tag of the part that each beam met; 0 for nothing, shape as ``ranges``."""
        found = self._look_up(self.fleet.scene.table.tags, self.fleet.tags)
        return np.asarray(found, np.int64)

    def _look_up(self, statics: NDArray[Any], looks: NDArray[Any]) -> NDArray[Any]:
        names = np.abs(self._named())
        body, at = names // c.NAMES, (names % c.NAMES).astype(np.int64)
        values = np.concatenate((np.zeros(1), statics, looks))
        return np.asarray(values[np.where(body > 0.0, 1 + len(statics) + at, at)])

    def _named(self) -> Floats:
        if not len(self.names):
            raise EngineError("the scanner does not remember what it met", hint="make it named")
        return self.names.reshape(self.ranges.shape)

    def _owners_in(self, worlds: Worlds) -> NDArray[np.int64]:
        rows = worlds[:, None] * self.fleet.nbody + self._carriers
        return np.ascontiguousarray(rows.ravel(), np.int64)

    def _tail(self, part: int, owners: NDArray[np.int64]) -> tuple[Any, ...]:
        """What the kernel works on for one thread, after the range; the same in all scans."""
        own = self.arguments(part)
        extra = () if self._look is scan else self._ahead(part)
        return (
            own[0], owners, *own[2:5], self.fleet.widest, *self.surroundings(), *own[5:], *extra,
            self._flat, self.names,
        )  # fmt: skip

    def surroundings(self) -> tuple[Any, ...]:
        """What ``kernels_scan.scan`` works on of the fleet, but for the largest radius."""
        fleet, scene = self.fleet, self.fleet.scene
        return (
            scene.grid, scene.table.rows, scene.start, scene.items, scene.lanes, fleet.kinds, fleet.looks,
            fleet.rows, fleet.head, fleet.follow,
        )  # fmt: skip

    def _ahead(self, part: int) -> tuple[Any, ...]:
        """Where statics are, for kernels in which beams go through clear space."""
        there, own = self._clearing, self._scratch[part]
        return (
            there.fine, there.start, there.items, there.clear, own.going, own.begins,
            self._middles,
        )  # fmt: skip

    def arguments(self, part: int) -> tuple[Any, ...]:
        """What ``kernels_scan.scan`` works on for one thread, but for the fleet and results."""
        own = self._scratch[part]
        return (
            self._sensors, self.owners, self._mounts, self._fan, self._outline,
            own.beams, own.view, own.stamp, own.walls, own.others,
        )  # fmt: skip


def _check(fan: Fan, fleet: Fleet, mounts: Sequence[Mount]) -> None:
    if fan.count < 1 or not fan.step > 0.0 or fan.step * (fan.count - 1) > 2.0 * math.pi + 1e-3:
        raise EngineError("a fan needs beams at growing angles, once around at most")
    if not (0.0 <= fan.begin < fan.reach < math.inf):
        raise EngineError("a fan needs a finite reach beyond where its beams begin")
    for mount in mounts:
        if not 0 <= mount.body < fleet.nbody:
            raise EngineError(f"there is no body {mount.body}; there are {fleet.nbody}")


def _look_of(fan: Fan, fleet: Fleet) -> Function:
    """The kernel that scans fastest; others need not be compiled."""
    scene = fleet.scene
    if scene.cells > 1 and fan.count <= FEW_BEAMS:
        return scan_singly
    return scan_crowded if scene.cells > 1 and len(scene.items) > MANY else scan


def _middles_of(fan: Fan) -> Floats:
    """Directions of the middles of bundles of beams, shape (2, n)."""
    first = np.arange(0, fan.count, SIDE_BY_SIDE)
    angles = fan.start + fan.step * (first + 0.5 * (SIDE_BY_SIDE - 1))
    return np.stack((np.cos(angles), np.sin(angles)))


def _outline(fan: Fan) -> Floats:
    """Corners of a convex polygon around all that a fan can see, in the sensor's frame."""
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
