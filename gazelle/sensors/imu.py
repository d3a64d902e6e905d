"""Inertial measurement units: turning rate, specific force and orientation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Imu, Pose
from gazelle.engines import Engine, Motion, Placement
from gazelle.errors import SimulationError
from gazelle.rotations import conjugate, cross, multiply, rotate
from gazelle.sensors.model import NoisySensor, PythonSensors, SystemMaker
from gazelle.sensors.noise import JoinedNoise


@dataclass(frozen=True, slots=True)
class ImuReading:
    """One measurement of an IMU, in its own frame.

    Attributes:
        stamp: Simulated time [ns].
        orientation: Of the sensor in the world, quaternion (x, y, z, w), shape (..., 4).
        angular_velocity: [rad/s], shape (..., 3).
        linear_acceleration: Specific force, +g upwards at rest [m/s²],
            shape (..., 3).
        variance: Of every value, for the published covariance.
    """

    stamp: int
    orientation: Floats
    angular_velocity: Floats
    linear_acceleration: Floats
    variance: float = 0.0


@checked(SimulationError, after=True)
class ImuModel(NoisySensor):
    """Measures one IMU in every world.

    Args:
        imu: Settings of the file.
        engine: Knows the motion.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.

    Attributes:
        by_system: No: Python measures many in one call.
    """

    by_system = False

    def __init__(
        self, imu: Imu, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        rates = {f"rate/{n}": noise for n, noise in zip("xyz", imu.angular_velocity, strict=True)}
        forces = {
            f"force/{n}": noise for n, noise in zip("xyz", imu.linear_acceleration, strict=True)
        }
        super().__init__({**rates, **forces}, seed, name, engine.nworld)
        self.imu = imu
        self._engine = engine
        self._link = link
        self._mount = np.asarray(pose.position), np.asarray(pose.quaternion)

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return orientation, turning rate and specific force now, shape (n, 10).

        The acceleration is that of the coming physics step.

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        orientation, specific_force = _specific_force(
            self._mount,
            self._engine.links[self._link].placement(worlds),
            self._engine.links[self._link].motion(worlds),
            self._engine.links[self._link].acceleration(worlds),
            self._engine.parameter("gravity", "", worlds),
        )
        return np.concatenate((orientation, self.noisy(specific_force, interval, worlds)), axis=1)

    def system(self) -> SystemMaker:
        """Return the system that measures it with others of equal noise."""
        return SystemMaker(ImuGroup, tuple(noise.description for noise in self.noises))

    @property
    def engine(self) -> Engine:
        """Engine that reports the motion."""
        return self._engine

    @property
    def link(self) -> str:
        """Scoped name of the link it is on."""
        return self._link

    @property
    def mount(self) -> tuple[Floats, Floats]:
        """Pose in the link frame: position [m] and quaternion (x, y, z, w)."""
        return self._mount

    def reading(self, values: Floats, stamp: int) -> ImuReading:
        """Return a measurement by name."""
        return ImuReading(stamp, values[..., :4], values[..., 4:7], values[..., 7:])


class ImuGroup(PythonSensors):
    """IMUs of many robots, measured at once: the coming step is made once for all.

    Args:
        models: Of one kind.
    """

    def __init__(self, models: Sequence[ImuModel]) -> None:
        self._engine = models[0].engine
        self._models = list(models)
        self._links = tuple(each.link for each in models)
        self._mount = (
            np.array([each.mount[0] for each in models]),
            np.array([each.mount[1] for each in models]),
        )
        noises = zip(*(each.noises for each in models), strict=True)
        self._noises = [JoinedNoise(channel) for channel in noises]

    def is_of(self, models: Sequence[ImuModel]) -> bool:
        """Return whether it measures just these."""
        return self._models == list(models)

    def measure_all(self, interval: float) -> Floats:
        """Measure now, shape (nworld, n, 10); see ``ImuModel.measure``."""
        engine, links = self._engine, self._links
        orientation, specific_force = _specific_force(
            self._mount,
            engine.links[links].placement(),
            engine.links[links].motion(),
            engine.links[links].acceleration(),
            engine.parameter("gravity", "")[:, None, :],
        )
        columns = [
            noise.apply(specific_force[..., i : i + 1], interval)
            for i, noise in enumerate(self._noises)
        ]
        return np.concatenate((orientation, *columns), axis=-1)


def _specific_force(
    mount: tuple[Floats, Floats], place: Placement, motion: Motion, change: Motion, gravity: Floats
) -> tuple[Floats, Floats]:
    """Return orientation, and turning rate and specific force of an IMU, shape (..., 6)."""
    arm = rotate(place.quaternion, mount[0])
    spin = motion.angular
    acceleration = change.linear + cross(change.angular, arm) + cross(spin, cross(spin, arm))
    orientation = multiply(place.quaternion, mount[1])
    to_sensor = conjugate(orientation)
    force = rotate(to_sensor, acceleration - gravity)
    return orientation, np.concatenate((rotate(to_sensor, spin), force), axis=-1)
