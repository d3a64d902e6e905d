"""Measurements of rangers: distances with noise, and intensities."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.engines.planar import AngleNoiseScanner, Fan, Fleet, Mount, Scanner
from gazelle.native.system import System
from gazelle.streams import Stream


@dataclass(slots=True)
class StageRangeNoise:
    """Noise of the sensors of one scanner: that of Stage 4.3, but for the angles.

    Attributes:
        constant: Standard deviation [m], shape (sensors,).
        share: Of the distance, by which it is off at most, all being equally likely, shape
            (sensors,).
        angle: Standard deviation of the angle of each beam [rad], shape (sensors,).
    """

    constant: Floats
    share: Floats
    angle: Floats


class RangerScanner:
    """All rangers with one fan, in all worlds.

    Args:
        fleet: Fleet.
        fan: The beams.
        mounts: Mounts of the sensors.
        noise: Of each.
        stream: Of random numbers.
        seed: The run's seed.
    """

    def __init__(
        self,
        fleet: Fleet,
        fan: Fan,
        mounts: list[Mount],
        noise: StageRangeNoise,
        stream: Stream,
        *,
        seed: int,
    ) -> None:
        self.fan = fan
        self._fleet, self._mounts, self._noise = fleet, mounts, noise
        self._noisy = [bool(each.any()) for each in (noise.constant, noise.share)]
        self._seed = seed
        self._scanner = self._make(named=False)
        self._named = False
        self._shape = (fleet.nworld, len(mounts), fan.count)
        self._stream = stream

    def scan(self) -> Floats:
        """Return distances [m], shape (nworld, sensors, samples); the array is used again."""
        ranges = self._scanner.scan()
        if not any(self._noisy):
            return ranges
        count, noise, off = self._shape[1] * self._shape[2], self._noise, np.zeros(self._shape)
        if self._noisy[0]:
            off += noise.constant[:, None] * self._stream.normal(count).reshape(self._shape)
        if self._noisy[1]:
            drawn = 2.0 * self._stream.uniform(count).reshape(self._shape) - 1.0
            off += noise.share[:, None] * ranges * drawn
        measured: Floats = np.where(ranges < self.fan.reach, ranges + off, ranges)
        return np.clip(measured, 0.0, self.fan.reach, out=measured)

    def system(self) -> System | None:
        """Return the system that scans in native code; None if Python takes part."""
        noisy = any(self._noisy) or bool(self._noise.angle.any())
        return None if noisy else self._scanner.system

    @property
    def flat_ranges(self) -> Floats:
        """Array it writes to, a row a sensor."""
        return self._scanner.flat_ranges

    def returns(self, sensor: int, world: int = 0) -> Floats:
        """Return ``ranger_return`` of what each beam of a sensor meets now; 0 for nothing.

        From the first call on each scan also remembers what it met.

        Args:
            sensor: Its place in the scanner.
            world: World.
        """
        if not self._named:
            tick = self._scanner.tick
            self._scanner = self._make(named=True)
            self._scanner.tick = tick - 1  # the scan that was made already once more
            self._scanner.scan()
            self._named = True
        return self._scanner.glows(world * self._shape[1] + sensor)

    @property
    def tick(self) -> int:
        """Number of scans so far; settable."""
        return self._scanner.tick

    @tick.setter
    def tick(self, count: int) -> None:
        self._scanner.tick = count

    def _make(self, *, named: bool) -> Scanner:
        fleet, fan, mounts, angle = self._fleet, self.fan, self._mounts, self._noise.angle
        if angle.any():
            return AngleNoiseScanner(fleet, fan, mounts, angle, named=named, seed=self._seed)
        return Scanner(fleet, fan, mounts, named=named)
