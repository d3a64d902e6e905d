"""Sources of a filter on a graph: odometry, poses, velocities and IMUs become measurements."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.conversions import point, pose_of_message, quaternion
from gazelle.description import Pose
from gazelle.navigation.estimation.kalman import KalmanFilter, Measurement
from gazelle.navigation.estimation.motion import ACCELERATION, ANGLES, POSE, TWIST
from gazelle.navigation.estimation.sensors import (
    AccelerationSensor,
    FusedSensor,
    FusionFrames,
    PoseSensor,
    VelocitySensor,
)
from gazelle.navigation.estimation.settings import SourceSettings
from gazelle_ros.msgs import geometry_msgs, nav_msgs, sensor_msgs
from gazelle_ros.node import Node

_KINDS: dict[str, Any] = {
    "odom": nav_msgs.msg.Odometry,
    "pose": geometry_msgs.msg.PoseWithCovarianceStamped,
    "twist": geometry_msgs.msg.TwistWithCovarianceStamped,
    "imu": sensor_msgs.msg.Imu,
}


class FusedSource:
    """Topic whose messages are fused.

    Args:
        node: On the graph.
        settings: Parameters of the source.
        frames: Of the filter.
        kalman: Filter that the measurements are for.
        lock: Held while a message is processed.
        add: Takes measurements.
        jumped: Called when time went back; returns whether to go on with the message.
        report: Takes warnings, by the name of what is warned of.
    """

    def __init__(
        self,
        node: Node,
        settings: SourceSettings,
        frames: FusionFrames,
        kalman: KalmanFilter,
        *,
        lock: threading.RLock,
        add: Callable[[Measurement], None],
        jumped: Callable[[], bool],
        report: Callable[[str, str], None],
    ) -> None:
        self.topic = node.resolve(settings.topic)
        self.seen = 0
        """Number of messages."""
        self.ignore_until = 0
        """Stamp up to which messages do not count [ns]."""
        self._settings, self._lock, self._add = settings, lock, add
        self._jumped, self._report, self._base = jumped, report, frames.base
        part = settings, frames, kalman
        self._pose = PoseSensor(*part, "pose", POSE, settings.pose_threshold)
        self._twist = VelocitySensor(*part, "twist", TWIST, settings.twist_threshold)
        limit = settings.acceleration_threshold
        self._acceleration = AccelerationSensor(*part, "acceleration", ACCELERATION, limit)
        takers: dict[str, Callable[[Any], None]] = {
            "odom": self._odometry,
            "pose": self._posed,
            "twist": self._twisted,
            "imu": self._imu,
        }
        take = takers[settings.kind]

        def receive(message: Any) -> None:
            with lock:
                self.seen += 1
                take(message)

        if settings.used.any():
            node.subscribe(
                settings.topic,
                _KINDS[settings.kind],
                receive,
                settings.queue_size,
                tcp_nodelay=settings.nodelay,
            )

    def forget(self) -> None:
        """Restart, as if there had been no message."""
        for sensor in (self._pose, self._twist, self._acceleration):
            sensor.forget()

    def _odometry(self, message: nav_msgs.msg.Odometry) -> None:
        stamp = message.header.stamp.to_nsec()
        frame, child = message.header.frame_id.strip("/"), message.child_frame_id.strip("/")
        if self._settings.uses(POSE) and self._is_new(self._pose, stamp):
            of = child if self._settings.pose_use_child_frame else self._base
            self._keep(self._pose.measure(frame, of, stamp, *_pose_of(message.pose)))
        if self._settings.uses(TWIST) and self._is_new(self._twist, stamp):
            self._keep(self._twist.measure(child, stamp, *_twist_of(message.twist)))

    def _posed(self, message: geometry_msgs.msg.PoseWithCovarianceStamped) -> None:
        stamp, frame = message.header.stamp.to_nsec(), message.header.frame_id.strip("/")
        if self._is_new(self._pose, stamp):
            self._keep(self._pose.measure(frame, self._base, stamp, *_pose_of(message.pose)))

    def _twisted(self, message: geometry_msgs.msg.TwistWithCovarianceStamped) -> None:
        stamp, frame = message.header.stamp.to_nsec(), message.header.frame_id.strip("/")
        if self._is_new(self._twist, stamp):
            self._keep(self._twist.measure(frame, stamp, *_twist_of(message.twist)))

    def _imu(self, message: sensor_msgs.msg.Imu) -> None:
        stamp, frame = message.header.stamp.to_nsec(), message.header.frame_id.strip("/")
        uses, found = self._settings.uses, message.orientation_covariance
        attitude = None
        if found[0] != -1.0:  # else there is no orientation (sensor_msgs/Imu)
            attitude = Pose.from_quaternion((0.0, 0.0, 0.0), quaternion(message.orientation))
            if uses(POSE) and self._is_new(self._pose, stamp):
                spread = _lower(found)
                self._keep(self._pose.measure(frame, self._base, stamp, attitude, spread))
        found = message.angular_velocity_covariance
        if uses(TWIST) and found[0] != -1.0 and self._is_new(self._twist, stamp):
            velocities = np.array((0.0, 0.0, 0.0, *point(message.angular_velocity)))
            self._keep(self._twist.measure(frame, stamp, velocities, _lower(found)))
        found = message.linear_acceleration_covariance
        sensor = self._acceleration
        if uses(ACCELERATION) and found[0] != -1.0 and self._is_new(sensor, stamp):
            measured = np.array(point(message.linear_acceleration))
            spread = np.array(found, float).reshape(3, 3)
            self._keep(sensor.measure(frame, stamp, measured, spread, attitude))

    def _is_new(self, sensor: FusedSensor, stamp: int) -> bool:
        """Return whether a message counts, and note its time."""
        if stamp <= self.ignore_until:
            self._report(sensor.name, "a message is not newer than the last reset")
            return False
        if sensor.stamp is not None and stamp < sensor.stamp and not self._jumped():
            self._report(sensor.name, "a message is older than the one before it")
            return False
        sensor.stamp = stamp
        return True

    def _keep(self, measurement: Measurement | None) -> None:
        if measurement is None:
            return
        huge = measurement.covariance.diagonal()[measurement.used] > 1e3
        if huge.any():
            self._report(measurement.source, "a variance is above 1000")
        self._add(measurement)


def _pose_of(message: geometry_msgs.msg.PoseWithCovariance) -> tuple[Pose, Floats]:
    return pose_of_message(message.pose), np.array(message.covariance, float).reshape(6, 6)


def _twist_of(message: geometry_msgs.msg.TwistWithCovariance) -> tuple[Floats, Floats]:
    velocities = np.array((*point(message.twist.linear), *point(message.twist.angular)))
    return velocities, np.array(message.covariance, float).reshape(6, 6)


def _lower(covariance: Any) -> Floats:
    """Return a covariance of three angles as that of a pose or twist, shape (6, 6)."""
    whole = np.zeros((6, 6))
    whole[ANGLES, ANGLES] = np.array(covariance, float).reshape(3, 3)
    return whole
