"""Fans of beams on bodies: lidars, sonars and whatever looks along rays."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.engines.planar import columns as c
from gazelle.engines.planar import kernels_scan
from gazelle.engines.planar.fleet import Fleet
from gazelle.errors import EngineError

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]

_ANGLES = 5e-5  # how wrong the kernels' angles may be [rad]
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
    """

    start: float
    step: float
    count: int
    reach: float
    begin: float = 0.0

    @classmethod
    def spread(cls, fov: float, count: int, reach: float, begin: float = 0.0) -> Fan:
        """Beams over a field of view [rad] about the x axis, from edge to edge."""
        step = fov / (count - 1) if count > 1 else 1.0
        return cls(-fov / 2.0 if count > 1 else 0.0, step, count, reach, begin)

    @property
    def angles(self) -> Floats:
        """From the sensor's x axis [rad], shape (count,)."""
        return self.start + self.step * np.arange(self.count)


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


class Scanner:
    """The same fan on some bodies of a fleet.

    Args:
        fleet: What it looks at.
        fan: The beams.
        mounts: Where they start, the same in all worlds.
        named: Whether to remember what each beam met.

    Raises:
        EngineError: The fan cannot be, or there is no such body.
    """

    def __init__(
        self, fleet: Fleet, fan: Fan, mounts: Sequence[Mount], *, named: bool = False
    ) -> None:
        _check(fan, fleet, mounts)
        self.fleet, self.fan = fleet, fan
        self._mounts = np.array(
            [[m.x, m.y, math.cos(m.yaw), math.sin(m.yaw), m.z] for m in mounts]
        ).reshape(-1, c.SENSOR)
        self._carriers = np.array([mount.body for mount in mounts], np.int64)
        begin = 1.0 / fan.begin if fan.begin > 0.0 else math.inf
        self._fan = np.array([fan.start, 1.0 / fan.step, fan.reach, begin, _ANGLES])
        beams = np.zeros((4, fan.count))
        beams[0], beams[1] = np.cos(fan.angles), np.sin(fan.angles)
        self._outline = _outline(fan)
        statics = len(fleet.scene.table.rows)
        self._scratch = [
            (beams.copy(), np.zeros_like(self._outline), np.zeros(statics + 1, np.int64))
            for _ in range(fleet.crew.size)
        ]
        total = fleet.nworld * len(mounts)
        self._sensors = np.zeros((total, c.SENSOR))
        self.ranges = np.zeros((fleet.nworld, len(mounts), fan.count))
        self.names = np.zeros((total if named else 0, fan.count))

    def scan(self, worlds: Worlds | None = None) -> Floats:
        """Distances now [m], shape (n, mounts, count); the fan's reach where nothing is met.

        The array is used again by the next scan.

        Args:
            worlds: Which worlds; all if None.
        """
        which = np.arange(self.fleet.nworld) if worlds is None else worlds
        owners = (which[:, None] * self.fleet.nbody + self._carriers).ravel()
        ranges = self.ranges.reshape(-1, self.fan.count)
        self.fleet.crew.share(
            lambda a, b, part: self._scan(a, b, owners, ranges, part),
            len(owners),
            max(1, _SHARE // self.fan.count),
        )
        return self.ranges[: len(which)]

    def _scan(self, first: int, last: int, owners: Worlds, ranges: Floats, part: int) -> None:
        fleet, scene = self.fleet, self.fleet.scene
        kernels_scan.aim(first, last, owners, self._mounts, fleet.rows, self._sensors)
        beams, view, stamp = self._scratch[part]
        kernels_scan.scan(
            first, last, self._sensors, owners, self._fan, self._outline, fleet.widest,
            scene.grid, scene.table.rows, scene.start, scene.items, fleet.kinds, fleet.looks,
            fleet.rows, fleet.head, fleet.follow, beams, view, stamp, ranges, self.names,
        )  # fmt: skip


def _check(fan: Fan, fleet: Fleet, mounts: Sequence[Mount]) -> None:
    if fan.count < 1 or not fan.step > 0.0 or fan.step * (fan.count - 1) > 2.0 * math.pi + 1e-3:
        raise EngineError("a fan needs beams at growing angles, once around at most")
    if not (0.0 <= fan.begin < fan.reach < math.inf):
        raise EngineError("a fan needs a finite reach beyond where its beams begin")
    for mount in mounts:
        if not 0 <= mount.body < fleet.nbody:
            raise EngineError(f"there is no body {mount.body}; there are {fleet.nbody}")


def _outline(fan: Fan) -> Floats:
    """Corners of a convex polygon around all that a fan can see, in the sensor's frame."""
    span = fan.step * (fan.count - 1)
    if span >= math.pi:
        angles = np.arange(8) * (math.pi / 4.0)
        far = fan.reach / math.cos(math.pi / 8.0)
        return np.stack((far * np.cos(angles), far * np.sin(angles)), axis=1)
    pieces = max(1, math.ceil(span / (math.pi / 3.0)))
    angles = fan.start + np.linspace(0.0, span, pieces + 1)
    far = fan.reach / math.cos(span / pieces / 2.0)
    arc = np.stack((far * np.cos(angles), far * np.sin(angles)), axis=1)
    return np.vstack((np.zeros((1, 2)), arc))
