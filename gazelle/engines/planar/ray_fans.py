"""Rays of sensors as fans of beams in the plane."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.engines.planar.fans import Fan, Mount, Scanner
from gazelle.engines.planar.fleet import Fleet
from gazelle.errors import EngineError

_LEVEL = 1e-6
_EQUAL = 1e-7
_MARGIN = 1e-6  # of how far rays go: rounding leaves nothing out


@dataclass(frozen=True, slots=True)
class Caster:
    """Rays on a body, and where they begin.

    Attributes:
        scanner: Casts them.
        begin: Distance of where they begin from where the scanner measures [m].
        order: Beam of each ray, shape (rays,).
        signed: Casts them too; what is missing is infinite, and minus infinite from inside.
    """

    scanner: Scanner
    begin: float
    order: NDArray[np.intp]
    signed: Scanner

    def ranges(self, worlds: Worlds | None) -> Floats:
        """Return distances from the scanner's origin [m], shape (n, rays); see ``signed``."""
        found = self.signed.scan(worlds)
        return found.reshape(len(found), math.prod(found.shape[1:]))

    def cast(self, worlds: Worlds | None) -> tuple[Floats, NDArray[np.bool_]]:
        """Return the distance of each ray's hit [m] and whether it is inside.

        Infinite for none.
        """
        ranges = self.scanner.scan(worlds)
        count = len(ranges)
        width = math.prod(ranges.shape[1:])
        flat = ranges.reshape(count, width)[:, self.order]
        names = self.scanner.names[: count * ranges.shape[1]].reshape(count, width)[:, self.order]
        return np.where(names == 0.0, np.inf, flat - self.begin), names < 0.0


@dataclass(frozen=True, slots=True)
class CachedCaster:
    """A caster as long as nothing turns what its rays hang on.

    Attributes:
        caster: Ray caster.
        columns: Of the joints between its model and its link.
        angles: Of those joints when it was made, shape (nworld, n).
        of: Origins of its rays; kept, as it is known by where they are in memory.
        along: Their directions, likewise.
    """

    caster: Caster
    columns: NDArray[np.intp]
    angles: Floats
    of: Floats
    along: Floats

    def holds(self, angles: Floats) -> bool:
        """Return whether the joints have not moved."""
        return not len(self.columns) or np.array_equal(self.angles, angles[:, self.columns])


@dataclass(frozen=True, slots=True)
class RayFan:
    """Rays that move with a body, as beams of one fan on one or more places.

    Attributes:
        fan: The beams.
        mounts: Mounts of the sensors.
        begin: Distance of where rays begin from where the fan does [m].
    """

    fan: Fan
    mounts: tuple[Mount, ...]
    begin: float


def check_level(origins: Floats, directions: Floats) -> None:
    """Check that rays lie in one level plane, shapes (rays, 3).

    Raises:
        EngineError: They do not.
    """
    if np.abs(directions[:, 2]).max(initial=0.0) > _LEVEL or np.ptp(origins[:, 2]) > _LEVEL:
        raise EngineError(
            "the planar engine casts rays in one level plane only",
            hint="use the engine mujoco for scanners with several rows, or ones that lean",
        )


def fan_of(body: int, origins: Floats, directions: Floats, reach: float) -> RayFan:
    """Return the fan of rays.

    Args:
        body: Its index.
        origins: In the body's frame [m], shape (rays, 3).
        directions: Unit vectors in the body's frame, shape (rays, 3).
        reach: Range [m].
    """
    z = float(origins[0, 2])
    angles = np.arctan2(directions[:, 1], directions[:, 0])
    centre, begin = _centre_of(origins[:, :2], directions[:, :2])
    steps = np.diff(angles) % (2.0 * math.pi)
    even = len(angles) > 1 and np.ptp(steps) < _EQUAL and 0.0 < steps.sum() < 2.0 * math.pi + 1e-3
    if centre is not None and begin is not None and even:
        whole = (begin + reach) * (1.0 + _MARGIN)
        fan = Fan(float(angles[0]), float(steps.mean()), len(angles), whole, begin)
        return RayFan(fan, (Mount(body, float(centre[0]), float(centre[1]), 0.0, z),), begin)
    mounts = [
        Mount(body, float(x), float(y), float(angle), z)
        for (x, y), angle in zip(origins[:, :2], angles, strict=True)
    ]
    return RayFan(Fan(0.0, 1.0, 1, reach * (1.0 + _MARGIN)), tuple(mounts), 0.0)


def caster_of(fleet: Fleet, rays: RayFan) -> Caster:
    """Return a caster of rays that move with a body, among the bodies of a fleet."""
    named = Scanner(fleet, rays.fan, rays.mounts, named=True)
    signed = Scanner(fleet, rays.fan, rays.mounts, missing=math.inf, signed=True)
    count = rays.fan.count * len(rays.mounts)
    return Caster(named, rays.begin, np.arange(count), signed)


def _centre_of(origins: Floats, directions: Floats) -> tuple[Floats | None, float | None]:
    """Return the point that all rays start at one distance from, and the distance."""
    away, turned = origins - origins[0], directions - directions[0]
    spread = float((turned * turned).sum())
    begin = float((away * turned).sum()) / spread if spread > 0.0 else 0.0
    centre = origins[0] - begin * directions[0]
    if begin < -_EQUAL or np.abs(centre + begin * directions - origins).max() > _EQUAL:
        return None, None
    return centre, max(begin, 0.0)
