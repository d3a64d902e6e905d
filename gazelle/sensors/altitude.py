"""Sensors of height: altimeters and barometers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Atmosphere, Noise, Parameters, Pose
from gazelle.description.nan_refusal import refuses_nan
from gazelle.engines import Engine
from gazelle.errors import SimulationError
from gazelle.formats.sdf.noise import read_noise
from gazelle.sensors.link_points import LinkPoint
from gazelle.sensors.model import NoisySensor
from gazelle.sensors.noise import NO_NOISE

# U.S. Standard Atmosphere, 1976: gravity, molar mass of air, gas constant (SI units).
_GRAVITY, _MOLAR_MASS, _GAS_CONSTANT = 9.80665, 0.0289644, 8.31432


@checked(SimulationError, after=True)
def air_pressure(atmosphere: Atmosphere, altitude: Floats) -> Floats:
    """Return the pressure of still air [Pa] at altitudes [m], by the barometric formula.

    With a temperature T that changes by a gradient L with height it is
    p0 (T / T0)^(-g M / (R L)), and p0 exp(-g M h / (R T0)) where it does not change (U.S.
    Standard Atmosphere, 1976, equations 33a and 33b).
    """
    weight = _GRAVITY * _MOLAR_MASS / _GAS_CONSTANT
    ground, gradient = atmosphere.temperature, atmosphere.temperature_gradient
    if gradient == 0.0:
        return np.asarray(atmosphere.pressure * np.exp(-weight * altitude / ground))
    warmth = np.maximum(1.0 + gradient * altitude / ground, 0.0)
    return np.asarray(atmosphere.pressure * warmth ** (-weight / gradient))


@dataclass(frozen=True, slots=True)
class Altimeter:
    """Settings of an altimeter: noise on height [m] and vertical velocity [m/s]."""

    position: Noise = NO_NOISE
    velocity: Noise = NO_NOISE

    @classmethod
    def read(cls, settings: Parameters) -> Altimeter:
        """Read the ``settings`` of a sensor, which hold ``<altimeter>``."""
        parts = ("vertical_position", "vertical_velocity")
        return cls(*(read_noise(settings.find(f"altimeter/{part}/noise")) for part in parts))


@dataclass(frozen=True, slots=True)
class AltimeterReading:
    """One measurement of an altimeter.

    Attributes:
        stamp: Simulated time [ns].
        height: Above where the sensor was when it was loaded [m], shape (...).
        velocity: Upwards [m/s], shape (...).
        reference: Height of that place in the world [m], shape (...).
    """

    stamp: int
    height: Floats
    velocity: Floats
    reference: Floats


@checked(SimulationError, after=True)
class AltimeterModel(NoisySensor):
    """Measures height and its change in every world, as Gazebo's altimeter does.

    Args:
        settings: Settings of the file.
        engine: Knows the motion.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.
    """

    def __init__(
        self, settings: Altimeter, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        noises = {"position": settings.position, "velocity": settings.velocity}
        super().__init__(noises, seed, name, engine.nworld)
        self._point = LinkPoint(engine, link, np.asarray(pose.position))
        self._reference = self._point.position()[:, 2]

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return height, velocity upwards and reference now, shape (n, 3).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        position, velocity = self._point.position_and_velocity(worlds)
        reference = self._reference[slice(None) if worlds is None else worlds]
        height = position[:, 2] - reference
        measured = self.noisy(np.column_stack((height, velocity[:, 2])), interval, worlds)
        return np.column_stack((measured, reference))

    def reading(self, values: Floats, stamp: int) -> AltimeterReading:
        """Return a measurement by name."""
        return AltimeterReading(stamp, values[..., 0], values[..., 1], values[..., 2])

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Return the noise and the reference of heights."""
        return {**super().state(), "reference": self._reference.copy()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        super().restore(state)
        self._reference[:] = state["reference"]


@refuses_nan
@dataclass(frozen=True, slots=True)
class AirPressure:
    """Settings of a barometer.

    Attributes:
        reference_altitude: Altitude of the world's origin [m].
        noise: On the pressure [Pa].
    """

    reference_altitude: float = 0.0
    noise: Noise = NO_NOISE

    @classmethod
    def read(cls, settings: Parameters) -> AirPressure:
        """Read the ``settings`` of a sensor, which hold ``<air_pressure>``."""
        inner = settings.find("air_pressure")
        if inner is None:
            return cls()
        return cls(inner.get("reference_altitude", 0.0), read_noise(inner.find("pressure/noise")))


@dataclass(frozen=True, slots=True)
class PressureReading:
    """One measurement of a barometer.

    Attributes:
        stamp: Simulated time [ns].
        pressure: [Pa], shape (...).
        variance: Of its noise [Pa²].
    """

    stamp: int
    pressure: Floats
    variance: float


@checked(SimulationError, after=True)
class AirPressureModel(NoisySensor):
    """Measures the pressure of the world's atmosphere in every world.

    Args:
        settings: Settings of the file.
        engine: Knows the atmosphere and the height.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random stream.
    """

    def __init__(
        self, settings: AirPressure, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        super().__init__({"pressure": settings.noise}, seed, name, engine.nworld)
        self.settings = settings
        self._engine = engine
        self._point = LinkPoint(engine, link, np.asarray(pose.position))

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return the pressure now [Pa], shape (n, 1).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        altitude = self.settings.reference_altitude + self._point.position(worlds)[:, 2:]
        pressure = air_pressure(self._engine.world.atmosphere, altitude)
        return self.noisy(pressure, interval, worlds)

    def reading(self, values: Floats, stamp: int) -> PressureReading:
        """Return a measurement by name."""
        return PressureReading(stamp, values[..., 0], float(self.noises[0].stddev[0]) ** 2)
