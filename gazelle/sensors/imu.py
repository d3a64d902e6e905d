"""Inertial measurement units: turning rate, specific force and orientation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.description import Imu, Pose
from gazelle.engines import Engine
from gazelle.rotations import conjugate, cross, multiply, rotate
from gazelle.sensors.model import NoisySensor


@dataclass(frozen=True, slots=True)
class ImuReading:
    """One measurement of an IMU, in its own frame.

    Attributes:
        stamp: Simulated time [ns].
        orientation: Of the sensor in the world, quaternion (x, y, z, w), shape (..., 4).
        angular_velocity: [rad/s], shape (..., 3).
        linear_acceleration: What an accelerometer feels, +g upwards at rest [m/s²],
            shape (..., 3).
        variance: Of every value, as who publishes it claims.
    """

    stamp: int
    orientation: Floats
    angular_velocity: Floats
    linear_acceleration: Floats
    variance: float = 0.0


class ImuModel(NoisySensor):
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
        rates = {f"rate/{n}": noise for n, noise in zip("xyz", imu.angular_velocity, strict=True)}
        forces = {
            f"force/{n}": noise for n, noise in zip("xyz", imu.linear_acceleration, strict=True)
        }
        super().__init__({**rates, **forces}, seed, name, engine.nworld)
        self.imu = imu
        self._engine = engine
        self._link = link
        self._offset = np.asarray(pose.position)
        self._turn = np.asarray(pose.quaternion)

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
        felt = self.noisy(np.concatenate((rate, force), axis=1), interval, worlds)
        return np.concatenate((orientation, felt), axis=1)

    def reading(self, values: Floats, stamp: int) -> ImuReading:
        """A measurement by name."""
        return ImuReading(stamp, values[..., :4], values[..., 4:7], values[..., 7:])
