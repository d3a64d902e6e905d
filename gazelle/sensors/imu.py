"""Inertial measurement units: turning rate, specific force and orientation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Imu, Noise, Pose
from gazelle.engines import Engine
from gazelle.rotations import conjugate, cross, multiply, rotate
from gazelle.sensors.noise import NoiseModel

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class ImuReading:
    """One measurement of an IMU, in its own frame.

    Attributes:
        stamp: Simulated time [ns].
        orientation: Of the sensor in the world, quaternion (x, y, z, w), shape (..., 4).
        angular_velocity: [rad/s], shape (..., 3).
        linear_acceleration: What an accelerometer feels, +g upwards at rest [m/s²],
            shape (..., 3).
    """

    stamp: int
    orientation: Floats
    angular_velocity: Floats
    linear_acceleration: Floats


class ImuModel:
    """Measures one IMU in every world.

    Args:
        imu: What the file says.
        engine: Knows the motion.
        link: Scoped name of the link it is on.
        pose: The sensor frame in the link frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.
    """

    def __init__(
        self, imu: Imu, engine: Engine, link: str, pose: Pose, seed: int, name: str
    ) -> None:
        self.imu = imu
        self._engine = engine
        self._link = link
        self._offset = np.asarray(pose.position)
        self._turn = np.asarray(pose.quaternion)

        def axis(noise: Noise, part: str) -> NoiseModel:
            return NoiseModel(noise, seed, f"{name}/{part}", engine.nworld, 1)

        self._rate_noise = [
            axis(noise, f"rate/{n}") for n, noise in zip("xyz", imu.angular_velocity, strict=True)
        ]
        self._force_noise = [
            axis(noise, f"force/{n}")
            for n, noise in zip("xyz", imu.linear_acceleration, strict=True)
        ]

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Orientation, turning rate and specific force now, shape (n, 10).

        The acceleration is that of the coming physics step.

        Args:
            worlds: Which worlds; all if None.
            interval: Time since the last measurement [s].
        """
        place = self._engine.link_placement(self._link, worlds)
        motion = self._engine.link_motion(self._link, worlds)
        change = self._engine.link_acceleration(self._link, worlds)
        arm = rotate(place.quaternion, self._offset)
        spin = motion.angular
        acceleration = change.linear + cross(change.angular, arm) + cross(spin, cross(spin, arm))
        orientation = multiply(place.quaternion, self._turn)
        to_sensor = conjugate(orientation)
        force = rotate(to_sensor, acceleration - self._engine.parameter("gravity", "", worlds))
        rate = rotate(to_sensor, spin)
        return np.concatenate(
            (
                orientation,
                _noisy(self._rate_noise, rate, interval, worlds),
                _noisy(self._force_noise, force, interval, worlds),
            ),
            axis=1,
        )

    def reading(self, values: Floats, stamp: int) -> ImuReading:
        """A measurement by name."""
        return ImuReading(stamp, values[..., :4], values[..., 4:7], values[..., 7:])

    def reseed(self, seed: int, worlds: Worlds | None = None) -> None:
        """Use the random numbers of another seed, from their start."""
        for noise in (*self._rate_noise, *self._force_noise):
            noise.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None = None) -> None:
        """Forget drifts of noise."""
        for noise in (*self._rate_noise, *self._force_noise):
            noise.reset(worlds)

    def state(self) -> dict[str, NDArray[np.generic]]:
        """Everything that changes, for a snapshot."""
        models = enumerate((*self._rate_noise, *self._force_noise))
        return {f"{i}/{k}": v for i, noise in models for k, v in noise.state().items()}

    def restore(self, state: dict[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
        for i, noise in enumerate((*self._rate_noise, *self._force_noise)):
            own = {k.partition("/")[2]: v for k, v in state.items() if k.startswith(f"{i}/")}
            noise.restore(own)


def _noisy(
    models: list[NoiseModel], values: Floats, interval: float, worlds: Worlds | None
) -> Floats:
    columns = [
        model.apply(values[:, i : i + 1], interval, worlds) for i, model in enumerate(models)
    ]
    return np.concatenate(columns, axis=1)
