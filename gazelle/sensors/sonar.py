"""Sonars: the nearest thing in a cone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Noise, Parameters, Pose
from gazelle.description.nan_refusal import refuses_nan
from gazelle.engines import Engine
from gazelle.errors import FormatError, SimulationError
from gazelle.formats.sdf.noise import read_noise
from gazelle.sensors.model import NoisySensor
from gazelle.sensors.noise import NO_NOISE

# Rays that stand for the cone: an odd number of rings about the middle one.
_RINGS, _RAYS_A_RING = 6, 6
_SPHERE_RAYS = 400


@refuses_nan
@dataclass(frozen=True, slots=True)
class Sonar:
    """Settings of a sonar.

    Attributes:
        geometry: ``cone`` or ``sphere``.
        range_min: Nearest distance measured [m].
        range_max: Farthest distance measured [m].
        radius: Of the cone at its far end [m].
        noise: On the distance [m].
    """

    geometry: str = "cone"
    range_min: float = 0.0
    range_max: float = 1.0
    radius: float = 0.5
    noise: Noise = NO_NOISE

    @property
    def field_of_view(self) -> float:
        """Opening of the cone, from side to side [rad]."""
        if self.geometry == "sphere":
            return 2.0 * math.pi
        return 2.0 * math.atan2(self.radius, self.range_max - self.range_min)

    @classmethod
    def read(cls, settings: Parameters) -> Sonar:
        """Read the ``settings`` of a sensor, which hold ``<sonar>``.

        Raises:
            FormatError: The range does not grow, or the radius is negative.
        """
        inner = settings.find("sonar")
        if inner is None:
            return cls()
        sonar = cls(
            inner.get("geometry", "cone"),
            inner.get("min", 0.0),
            inner.get("max", 1.0),
            inner.get("radius", 0.5),
            read_noise(inner.find("noise")),
        )
        if not 0.0 <= sonar.range_min < sonar.range_max:
            raise FormatError(
                f"the range of a sonar must grow from 0, found {sonar.range_min:g} to "
                f"{sonar.range_max:g}",
                source=inner.source,
            )
        if sonar.radius < 0.0:
            raise FormatError(
                f"the radius of a sonar must not be negative, found {sonar.radius:g}",
                source=inner.source,
            )
        return sonar


@dataclass(frozen=True, slots=True)
class SonarReading:
    """One measurement of a sonar.

    Attributes:
        stamp: Simulated time [ns].
        range: To the nearest thing [m], shape (...); ``range_max`` for nothing.
        range_min: [m].
        range_max: [m].
        field_of_view: Opening of the cone, from side to side [rad].
    """

    stamp: int
    range: Floats
    range_min: float
    range_max: float
    field_of_view: float


@checked(SimulationError, after=True)
class SonarModel(NoisySensor):
    """Measures one sonar in every world.

    As in Gazebo, the cone has its tip at the sensor, opens along the sensor's -z axis, and
    does not see the link that it is on.
    It is followed by a bundle of rays that start at ``range_min``, so things thinner than
    the space between two rays can be missed; the bundle is closest near the middle.

    Args:
        settings: Settings of the file.
        engine: Casts the rays.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random stream.
    """

    def __init__(
        self, settings: Sonar, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        super().__init__({"range": settings.noise}, seed, name, engine.nworld)
        self.settings = settings
        self._engine = engine
        self._link = link
        turn = pose.matrix()[:3, :3]
        self._directions = np.ascontiguousarray(_bundle(settings) @ turn.T)
        self._origins = np.asarray(pose.position) + settings.range_min * self._directions

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return the distance to the nearest thing now [m], shape (n, 1).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        hits = self._engine.links[self._link].cast_rays(
            self._origins, self._directions, worlds, ignore_own=True
        )
        low, high = self.settings.range_min, self.settings.range_max
        nearest = np.where(hits.from_inside, 0.0, hits.distance).min(axis=1, keepdims=True) + low
        return np.clip(self.noisy(np.minimum(nearest, high), interval, worlds), low, high)

    def reading(self, values: Floats, stamp: int) -> SonarReading:
        """Return a measurement by name."""
        own = self.settings
        return SonarReading(stamp, values[..., 0], own.range_min, own.range_max, own.field_of_view)


def _bundle(sonar: Sonar) -> Floats:
    """Return unit vectors that fill the cone about -z, or all directions, shape (rays, 3)."""
    if sonar.geometry == "sphere":
        # A spiral from pole to pole with equal areas (Fibonacci lattice).
        index = np.arange(_SPHERE_RAYS) + 0.5
        height = 1.0 - 2.0 * index / _SPHERE_RAYS
        around = math.pi * (1.0 + math.sqrt(5.0)) * index
        out = np.sqrt(1.0 - height * height)
        return np.stack((out * np.cos(around), out * np.sin(around), height), axis=-1)
    half = sonar.field_of_view / 2.0
    rays = [(0.0, 0.0, -1.0)]
    for ring in range(1, _RINGS + 1):
        tilt = half * ring / _RINGS
        for step in range(ring * _RAYS_A_RING):
            turn = 2.0 * math.pi * step / (ring * _RAYS_A_RING)
            wide = math.sin(tilt)
            rays.append((wide * math.cos(turn), wide * math.sin(turn), -math.cos(tilt)))
    return np.asarray(rays)
