"""Measurements in the filter's frames from poses, velocities and accelerations in those of sensors.

A source is configured in its own frame: where a transform turns an axis that is used onto others, these
are used too. Transforms take points from a source's frame to the target's.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.description import Pose
from gazelle.engines.limits import NANOSECONDS
from gazelle.navigation.estimation.kalman import KalmanFilter, Measurement
from gazelle.navigation.estimation.motion import (
    ACCELERATION,
    ANGLES,
    ANGULAR,
    LINEAR,
    POSE,
    POSITION,
    SIZE,
    TWIST,
    rotated_covariance,
    rotation,
)
from gazelle.navigation.estimation.settings import SourceSettings

_OUT_OF_PLANE = np.array([2, 3, 4, 8, 9, 10, 14])
_PLANE_VARIANCE = 1e-6
_LEAST_SHARE = 1e-6
"""Of a used axis in another one, from which that is used too."""


@dataclass(slots=True)
class FusionFrames:
    """Frames of a filter.

    Attributes:
        world: Frame of poses.
        base: Frame of velocities and accelerations.
        find: Returns the transform from a source frame (the second argument) to a target frame (the
            first) at a time [ns]; None if it is not known.
        flat: Pin the elements that leave the plane to zero.
        gravity: [m/s^2].
        angular_acceleration: Of the robot, in its frame, for accelerometers beside its origin.
    """

    world: str
    base: str
    find: Callable[[str, str, int], Pose | None]
    flat: bool = False
    gravity: float = 9.80665
    angular_acceleration: Floats | None = None


class FusedSensor:
    """Part of a source: its poses, velocities or accelerations.

    Args:
        source: Its parameters.
        frames: Of the filter.
        kalman: Filter that the measurements are for.
        name: For messages.
        elements: Part of the state that is measured.
        threshold: Greatest Mahalanobis distance.
    """

    def __init__(
        self,
        source: SourceSettings,
        frames: FusionFrames,
        kalman: KalmanFilter,
        name: str,
        elements: slice,
        threshold: float,
    ) -> None:
        self.name = f"{source.name}_{name}"
        self._source, self._frames, self._kalman = source, frames, kalman
        self._threshold = threshold
        self._used = np.zeros(SIZE, bool)
        self._used[elements] = source.used[elements]
        self.stamp: int | None = None
        """Time of the last message [ns]."""

    def forget(self) -> None:
        """Restart, as if there had been no message."""
        self.stamp = None

    def _measurement(
        self,
        stamp: int,
        elements: slice,
        values: Floats,
        covariance: Floats,
        used: Bools,
    ) -> Measurement:
        whole, spread = np.zeros(SIZE), np.zeros((SIZE, SIZE))
        whole[elements], spread[elements, elements] = values, covariance
        if self._frames.flat:
            whole[_OUT_OF_PLANE] = 0.0
            spread[_OUT_OF_PLANE, _OUT_OF_PLANE] = _PLANE_VARIANCE
            used = used.copy()
            used[_OUT_OF_PLANE] = True
        command = self._kalman.estimate.command
        return Measurement(self.name, stamp, whole, spread, used, self._threshold, command)


class VelocitySensor(FusedSensor):
    """Linear and angular velocities of a source."""

    def measure(
        self,
        frame: str,
        stamp: int,
        velocities: Floats,
        covariance: Floats,
        used: Bools | None = None,
    ) -> Measurement | None:
        """Return a measurement; None while the transform is not known.

        Args:
            frame: In which the velocities are given.
            stamp: [ns].
            velocities: Three linear, three angular, shape (6,) [m/s and rad/s].
            covariance: Shape (6, 6).
            used: Elements in the sensor's frame, shape (15,); those of the source by default.
        """
        found = self._frames.find(self._frames.base, frame or self._frames.base, stamp)
        if found is None:
            return None
        turn = found.matrix()[:3, :3]
        used = _turned_use(turn, self._used if used is None else used, (LINEAR, ANGULAR))
        angular = self._kalman.estimate.state[ANGULAR]
        linear = turn @ velocities[:3] + np.cross(found.position, angular)
        values = np.concatenate((linear, turn @ velocities[3:]))
        spread = rotated_covariance(turn, covariance)
        return self._measurement(stamp, TWIST, values, spread, used)


class AccelerationSensor(FusedSensor):
    """Linear accelerations of an IMU."""

    def measure(
        self,
        frame: str,
        stamp: int,
        acceleration: Floats,
        covariance: Floats,
        orientation: Pose | None,
    ) -> Measurement | None:
        """Return a measurement; None while the transform is not known.

        Args:
            frame: Of the IMU.
            stamp: [ns].
            acceleration: With gravity, as accelerometers feel it, or without, shape (3,) [m/s^2].
            covariance: Shape (3, 3).
            orientation: Of the IMU in the world; None if it does not measure it.
        """
        frames, state = self._frames, self._kalman.estimate.state
        found = frames.find(frames.base, frame or frames.base, stamp)
        if found is None:
            return None
        turn = found.matrix()[:3, :3]
        if self._source.remove_gravity:
            upright = self._upright(turn, state, orientation)
            acceleration = acceleration - upright.T @ (0.0, 0.0, frames.gravity)
        arm, angular = np.array(found.position), state[ANGULAR]
        values = turn @ acceleration - np.cross(angular, np.cross(angular, arm))
        if frames.angular_acceleration is not None:
            values += np.cross(arm, frames.angular_acceleration)
        used = _turned_use(turn, self._used, (ACCELERATION,))
        return self._measurement(stamp, ACCELERATION, values, turn @ covariance @ turn.T, used)

    def _upright(self, turn: Floats, state: Floats, orientation: Pose | None) -> Floats:
        """Return the rotation from the IMU to the world."""
        if orientation is None:
            return rotation(*state[ANGLES]) @ turn
        upright = orientation.matrix()[:3, :3]
        # Relative to how it was at first, when the robot stood upright: that is how it is mounted.
        return upright @ turn if self._source.relative else upright


class PoseSensor(FusedSensor):
    """Poses of a source: absolute, relative to the first one, or as velocities.

    Those of an IMU are its orientation; its frame is that of its mounting, not of the orientation.
    """

    def __init__(
        self,
        source: SourceSettings,
        frames: FusionFrames,
        kalman: KalmanFilter,
        name: str,
        elements: slice,
        threshold: float,
    ) -> None:
        super().__init__(source, frames, kalman, name, elements, threshold)
        self._velocity = VelocitySensor(source, frames, kalman, name, elements, threshold)
        self._first: Pose | None = None
        self._previous: tuple[Pose, Floats, int] | None = None

    def forget(self) -> None:
        """Restart, as if there had been no message."""
        super().forget()
        self._first = self._previous = None

    def measure(
        self, frame: str, child: str, stamp: int, pose: Pose, covariance: Floats
    ) -> Measurement | None:
        """Return a measurement; None while a transform is not known, and for the first difference.

        Args:
            frame: In which the pose is given; of an IMU that of its mounting.
            child: Frame of the pose.
            stamp: [ns].
            pose: Measured.
            covariance: Of position and fixed-axis angles, shape (6, 6).
        """
        frames, imu = self._frames, self._source.kind == "imu"
        target = frames.base if imu else frames.world
        # A difference is in the frame of the robot, wherever the poses are.
        source_frame = target if not frame or (self._source.differential and not imu) else frame
        found = frames.find(target, source_frame, stamp)
        below = Pose() if child in ("", frames.base) else frames.find(child, frames.base, stamp)
        if found is None or below is None:
            return None
        used_turn = rotation(0.0, 0.0, found.yaw) if imu else found.matrix()[:3, :3]
        covariance = rotated_covariance(below.matrix()[:3, :3].T, covariance)
        if imu:
            pose, found = Pose(0.0, 0.0, 0.0, *(pose * found.inverse()).rpy), Pose()
        used = _turned_use(used_turn, self._used, (POSITION, ANGLES))
        covariance = rotated_covariance(used_turn, covariance)
        if self._source.differential:
            return self._difference(child, stamp, pose, found, covariance, used)
        pose = pose * below
        if self._source.relative:
            self._first = self._first or pose
            pose = self._first.inverse() * pose
        pose = found * pose
        values = np.array((*pose.position, *pose.rpy))
        return self._measurement(stamp, POSE, values, covariance, used)

    def _difference(
        self,
        child: str,
        stamp: int,
        pose: Pose,
        found: Pose,
        covariance: Floats,
        used: Bools,
    ) -> Measurement | None:
        """Return the velocity since the last pose; None for the first one."""
        previous, self._previous = self._previous, (pose, covariance, stamp)
        if previous is None or stamp <= previous[2]:
            return None
        seconds = (stamp - previous[2]) / NANOSECONDS
        change = Pose.from_quaternion((0.0, 0.0, 0.0), found.quaternion) * (
            previous[0].inverse() * pose
        )
        velocities = np.array((*change.position, *change.rpy)) / seconds
        shifted = np.zeros(SIZE, bool)
        shifted[TWIST] = used[POSE]
        # Not divided by the square of the time, but as robot_localization does it, for which the
        # covariances of published configurations are chosen.
        spread = (covariance + previous[1]) * seconds
        return self._velocity.measure(child, stamp, velocities, spread, shifted)


def _turned_use(turn: Floats, used: Bools, parts: tuple[slice, ...]) -> Bools:
    """Return the elements that are used after a rotation of some vectors."""
    turned = used.copy()
    for part in parts:
        turned[part] = np.linalg.norm(turn * used[part], axis=1) >= _LEAST_SHARE
    return turned
