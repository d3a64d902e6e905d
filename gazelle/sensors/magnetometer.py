"""Magnetometers: the world's magnetic field in the frame of the sensor."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Noise, Parameters, Pose
from gazelle.engines import Engine
from gazelle.errors import SimulationError
from gazelle.formats.sdf.noise import read_noise
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.sensors.model import NoisySensor
from gazelle.sensors.noise import NO_NOISE


@dataclass(frozen=True, slots=True)
class Magnetometer:
    """Settings of a magnetometer: noise along x, y, z [T]."""

    noises: tuple[Noise, Noise, Noise] = (NO_NOISE, NO_NOISE, NO_NOISE)

    @classmethod
    def read(cls, settings: Parameters) -> Magnetometer:
        """Read the ``settings`` of a sensor, which hold ``<magnetometer>``."""
        x, y, z = (read_noise(settings.find(f"magnetometer/{axis}/noise")) for axis in "xyz")
        return cls((x, y, z))


@dataclass(frozen=True, slots=True)
class MagneticReading:
    """One measurement of a magnetometer.

    Attributes:
        stamp: Simulated time [ns].
        field: Magnetic flux density in the sensor frame [T], shape (..., 3).
    """

    stamp: int
    field: Floats


@checked(SimulationError, after=True)
class MagnetometerModel(NoisySensor):
    """Measures the magnetic field in every world; it is the same everywhere in a world.

    Args:
        settings: Settings of the file.
        engine: Knows the field and the orientation.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.
    """

    def __init__(
        self, settings: Magnetometer, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        super().__init__(dict(zip("xyz", settings.noises, strict=True)), seed, name, engine.nworld)
        self._engine = engine
        self._link = link
        self._turn = np.asarray(pose.quaternion)

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return the field now [T], shape (n, 3).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        orientation = self._engine.links[self._link].placement(worlds).quaternion
        to_sensor = conjugate(multiply(orientation, self._turn))
        field = rotate(to_sensor, np.asarray(self._engine.world.magnetic_field, np.float64))
        return self.noisy(field, interval, worlds)

    def reading(self, values: Floats, stamp: int) -> MagneticReading:
        """Return a measurement by name."""
        return MagneticReading(stamp, values)
