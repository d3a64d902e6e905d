"""Satellite receivers: latitude, longitude, altitude and velocity."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Noise, Parameters, Pose, SphericalCoordinates
from gazelle.engines import Engine
from gazelle.errors import SimulationError
from gazelle.formats.sdf.noise import read_noise
from gazelle.sensors.geodesy import TangentPlane
from gazelle.sensors.link_points import LinkPoint
from gazelle.sensors.model import NoisySensor
from gazelle.sensors.noise import NO_NOISE


@dataclass(frozen=True, slots=True)
class Gps:
    """Settings of a satellite receiver.

    Attributes:
        horizontal: Noise along x and y of the world [m].
        vertical: Noise along z [m].
        horizontal_velocity: Noise on the velocities east and north [m/s].
        vertical_velocity: Noise on the velocity upwards [m/s].
    """

    horizontal: Noise = NO_NOISE
    vertical: Noise = NO_NOISE
    horizontal_velocity: Noise = NO_NOISE
    vertical_velocity: Noise = NO_NOISE

    @classmethod
    def read(cls, settings: Parameters) -> Gps:
        """Read the ``settings`` of a sensor, which hold ``<gps>`` or ``<navsat>``."""
        inner = settings.find("gps") or settings.find("navsat")
        if inner is None:
            return cls()
        position, velocity = "position_sensing", "velocity_sensing"
        return cls(
            read_noise(inner.find(f"{position}/horizontal/noise")),
            read_noise(inner.find(f"{position}/vertical/noise")),
            read_noise(inner.find(f"{velocity}/horizontal/noise")),
            read_noise(inner.find(f"{velocity}/vertical/noise")),
        )


@dataclass(frozen=True, slots=True)
class GpsReading:
    """One fix.

    Attributes:
        stamp: Simulated time [ns].
        latitude: Geodetic, WGS 84 [deg], shape (...).
        longitude: [deg], shape (...).
        altitude: Above the ellipsoid [m], shape (...).
        velocity: East, north, up [m/s], shape (..., 3).
    """

    stamp: int
    latitude: Floats
    longitude: Floats
    altitude: Floats
    velocity: Floats


@checked(SimulationError, after=True)
class GpsModel(NoisySensor):
    """Measures where one receiver is on Earth, in every world.

    As in Gazebo classic, noise is in metres and added before the conversion to degrees. The
    world's ``spherical_coordinates`` say where its origin is; without them it is 0 N 0 E.

    Args:
        settings: Settings of the file.
        engine: Knows the motion.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.
    """

    def __init__(
        self, settings: Gps, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        noises = {
            "x": settings.horizontal,
            "y": settings.horizontal,
            "z": settings.vertical,
            "east": settings.horizontal_velocity,
            "north": settings.horizontal_velocity,
            "up": settings.vertical_velocity,
        }
        super().__init__(noises, seed, name, engine.nworld)
        self._engine = engine
        self._point = LinkPoint(engine, link, np.asarray(pose.position))
        self._origin: SphericalCoordinates | None = None
        self._plane = TangentPlane(SphericalCoordinates())

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return latitude, longitude [deg], altitude [m], velocity [m/s] now, shape (n, 6).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        position, velocity = self._point.position_and_velocity(worlds)
        plane = self._current_plane()
        true = np.concatenate((position, plane.east_north_up(velocity)), axis=1)
        measured = self.noisy(true, interval, worlds)
        return np.column_stack((*plane.geodetic(measured[:, :3]), measured[:, 3:]))

    def _current_plane(self) -> TangentPlane:
        """Return the tangent plane of the world now: its place on Earth may change in a run."""
        origin = self._engine.world.spherical_coordinates
        if origin is not self._origin:
            self._plane = TangentPlane(origin or SphericalCoordinates())
            self._origin = origin
        return self._plane

    def reading(self, values: Floats, stamp: int) -> GpsReading:
        """Return a measurement by name."""
        return GpsReading(stamp, values[..., 0], values[..., 1], values[..., 2], values[..., 3:])
