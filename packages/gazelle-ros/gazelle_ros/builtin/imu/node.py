"""The nodes of imu_tools: orientation of an IMU's measurements (http://wiki.ros.org/imu_tools)."""

from __future__ import annotations

import logging
import math
import threading
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.rotations import Quaternion, Vector, conjugate, multiply
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.imu.complementary import ComplementaryFilter
from gazelle_ros.builtin.imu.madgwick import (
    WORLD_FRAMES,
    MadgwickFilter,
    measured_orientation,
)
from gazelle_ros.builtin.imu.quaternions import about_z
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.clock import SECOND
from gazelle_ros.compat.message_filters import ApproximateTimeSynchronizer, SimpleFilter
from gazelle_ros.msgs import geometry_msgs, sensor_msgs, tf2_msgs
from gazelle_ros.node import Node

_LOG = logging.getLogger("gazelle.ros.imu")
_QUEUE = 5
_SLOP_S = 0.1
"""Greatest difference of times of an IMU's and a magnetometer's messages [s]."""


@dataclass(frozen=True, slots=True)
class OrientationSettings:
    """Parameters that both filters have.

    Attributes:
        fixed_frame: Parent of the transform.
        publish_tf: Publish the orientation as a transform.
        reverse_tf: With the IMU as the parent.
        constant_dt: Time between messages [s]; 0 takes their stamps.
        publish_debug_topics: Not supported.
        time_jump_threshold: Shorter jumps back in time do not reset the filter [s].
    """

    fixed_frame: str = "odom"
    publish_tf: bool = False
    reverse_tf: bool = False
    constant_dt: float = 0.0
    publish_debug_topics: bool = False
    time_jump_threshold: float = 0.0


@dataclass(frozen=True, slots=True)
class MadgwickSettings(OrientationSettings):
    """Parameters of ``imu_filter_madgwick``, with its defaults.

    Attributes:
        stateless: Take each measurement for itself.
        use_mag: Use the magnetometer.
        remove_gravity_vector: Publish accelerations without gravity.
        yaw_offset: Added to the yaw [rad].
        declination: Of the magnetic field, subtracted from the yaw [rad].
        world_frame: ``enu``, ``nwu`` or ``ned``.
    """

    publish_tf: bool = True
    stateless: bool = False
    use_mag: bool = True
    remove_gravity_vector: bool = False
    yaw_offset: float = 0.0
    declination: float = 0.0
    world_frame: str = "enu"
    gain: float = tunable(0.1, 0.0, 1.0, "Gain of the filter")
    zeta: float = tunable(0.0, -1.0, 1.0, "Gyro drift gain (approx. rad/s)")
    mag_bias_x: float = tunable(0.0, -10.0, 10.0, "Magnetometer bias, x component")
    mag_bias_y: float = tunable(0.0, -10.0, 10.0, "Magnetometer bias, y component")
    mag_bias_z: float = tunable(0.0, -10.0, 10.0, "Magnetometer bias, z component")
    orientation_stddev: float = tunable(0.0, 0.0, 100.0, "Of the orientation estimate")


@dataclass(frozen=True, slots=True)
class ComplementarySettings(OrientationSettings):
    """Parameters of ``imu_complementary_filter``, with its defaults; see `ComplementaryFilter`."""

    use_mag: bool = False
    gain_acc: float = 0.01
    gain_mag: float = 0.01
    bias_alpha: float = 0.01
    do_bias_estimation: bool = True
    do_adaptive_gain: bool = True
    orientation_stddev: float = 0.0


class OrientationNode(CallbackWork, ABC):
    """Measurements of ``imu/data_raw``, with an orientation, on ``imu/data``.

    Args:
        node: On the graph.
        settings: Parameters of both filters.
        use_mag: Use ``imu/mag``, too.
    """

    def __init__(self, node: Node, settings: OrientationSettings, *, use_mag: bool) -> None:
        super().__init__(node)
        if settings.constant_dt < 0.0:
            raise RosError(f"constant_dt must be at least 0 s, not {settings.constant_dt!r}")
        if settings.publish_debug_topics:
            _LOG.warning("publish_debug_topics is not supported: there are no topics for debugging")
        self._common = settings
        self._lock = threading.Lock()
        self._stamp: int | None = None
        self._now = node.clock.now()
        imu = node.resolve("imu")
        kinds = sensor_msgs.msg
        self._output = node.advertise(f"{imu}/data", kinds.Imu, _QUEUE)
        self._transforms = node.advertise("/tf", tf2_msgs.msg.TFMessage, 100)
        measured, fields = SimpleFilter(), SimpleFilter()
        if use_mag:
            both = ApproximateTimeSynchronizer([measured, fields], _QUEUE, _SLOP_S)
            both.registerCallback(self._take)
            node.subscribe(f"{imu}/mag", kinds.MagneticField, fields.signalMessage, _QUEUE)
        else:
            measured.registerCallback(self._take)
        node.subscribe(f"{imu}/data_raw", kinds.Imu, measured.signalMessage, _QUEUE)

    @abstractmethod
    def forget(self) -> None:
        """Start again with the next measurement."""

    @abstractmethod
    def orient(
        self, turn: Vector, acceleration: Vector, field_: Vector | None, seconds: float | None
    ) -> Quaternion | None:
        """Take a measurement, and return the orientation; None if there is none.

        Args:
            turn: Angular velocity [rad/s].
            acceleration: With gravity [m/s2].
            field_: Magnetic field [T]; None without one.
            seconds: Since the last measurement; None for the first.
        """

    @abstractmethod
    def finish(self, message: sensor_msgs.msg.Imu) -> None:
        """Write the rest of a message that has its orientation."""

    def _take(
        self, imu: sensor_msgs.msg.Imu, magnet: sensor_msgs.msg.MagneticField | None = None
    ) -> None:
        with self._lock:
            self._watch_time()
            stamp = imu.header.stamp.to_nsec()
            seconds = None if self._stamp is None else (stamp - self._stamp) / SECOND
            if seconds is not None and self._common.constant_dt > 0.0:
                seconds = self._common.constant_dt
            seen = None if magnet is None else _vector(magnet.magnetic_field)
            found = self.orient(
                _vector(imu.angular_velocity), _vector(imu.linear_acceleration), seen, seconds
            )
            if found is None:
                return
            self._stamp = stamp
            self._publish(imu, found)

    def _watch_time(self) -> None:
        now = self.node.clock.now()
        if self._now > now + self._common.time_jump_threshold * SECOND:
            _LOG.warning(
                "time jumped back by %.1f s: the filter is reset", (self._now - now) / SECOND
            )
            self._stamp = None
            self.forget()
        self._now = now

    def _publish(self, imu: sensor_msgs.msg.Imu, found: Quaternion) -> None:
        message = sensor_msgs.msg.Imu(
            header=imu.header,
            orientation=_quaternion(self.heading(found)),
            angular_velocity=geometry_msgs.msg.Vector3(*_vector(imu.angular_velocity)),
            angular_velocity_covariance=imu.angular_velocity_covariance,
            linear_acceleration=geometry_msgs.msg.Vector3(*_vector(imu.linear_acceleration)),
            linear_acceleration_covariance=imu.linear_acceleration_covariance,
        )
        self.finish(message)
        self._output.publish(message)
        if not self._common.publish_tf:
            return
        made = geometry_msgs.msg.TransformStamped()
        frames = [self._common.fixed_frame, imu.header.frame_id]
        if self._common.reverse_tf:
            frames.reverse()
            found = conjugate(found)
        made.header.stamp = imu.header.stamp
        made.header.frame_id, made.child_frame_id = frames
        made.transform.rotation = _quaternion(found)
        self._transforms.publish(tf2_msgs.msg.TFMessage(transforms=[made]))

    def heading(self, q: Quaternion) -> Quaternion:
        """Return the orientation of the message from that of the filter."""
        return q


class MadgwickNode(OrientationNode):
    """Madgwick's filter.

    Args:
        node: On the graph, with the parameters of ``imu_filter_madgwick``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self.settings = settings = settings_of(node, MadgwickSettings)
        if settings.world_frame not in WORLD_FRAMES:
            hint = did_you_mean(settings.world_frame, WORLD_FRAMES)
            raise RosError(f"the world_frame is '{settings.world_frame}'", hint=hint)
        self.filter = MadgwickFilter(settings.world_frame)
        super().__init__(node, settings, use_mag=settings.use_mag)
        self._change(settings)
        self._tuned = TunedSettings(node, settings, self._change)

    def forget(self) -> None:
        """Start again with the next measurement."""
        self.filter.drift = (0.0, 0.0, 0.0)

    def orient(
        self, turn: Vector, acceleration: Vector, field_: Vector | None, seconds: float | None
    ) -> Quaternion | None:
        """Take a measurement, and return the orientation; None in free fall."""
        if field_ is not None:
            biased = (self.settings.mag_bias_x, self.settings.mag_bias_y, self.settings.mag_bias_z)
            x, y, z = (each - bias for each, bias in zip(field_, biased, strict=True))
            field_ = (x, y, z)
        if seconds is None or self.settings.stateless:
            if field_ is not None and not all(math.isfinite(each) for each in field_):
                return None
            found = measured_orientation(self.settings.world_frame, acceleration, field_)
            if found is None:
                return None
            self.filter.orientation = found
        if not self.settings.stateless:
            self.filter.update(turn, acceleration, field_, seconds or 0.0)
        return self.filter.orientation

    def heading(self, q: Quaternion) -> Quaternion:
        """Return the orientation with the offset of the yaw."""
        offset = self.settings.yaw_offset - self.settings.declination
        return multiply(about_z(offset), q) if offset else q

    def finish(self, message: sensor_msgs.msg.Imu) -> None:
        """Write the covariance, and remove gravity if wanted."""
        message.orientation_covariance = _diagonal(self.settings.orientation_stddev)
        if self.settings.remove_gravity_vector:
            x, y, z = self.filter.gravity()
            message.linear_acceleration.x -= x
            message.linear_acceleration.y -= y
            message.linear_acceleration.z -= z

    def _change(self, settings: MadgwickSettings) -> None:
        with self._lock:
            self.settings = settings
            self.filter.gain, self.filter.zeta = settings.gain, settings.zeta


class ComplementaryNode(OrientationNode):
    """The complementary filter.

    Args:
        node: On the graph, with the parameters of ``imu_complementary_filter``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self.settings = settings = settings_of(node, ComplementarySettings)
        for name in ("gain_acc", "gain_mag", "bias_alpha"):
            if not 0.0 <= getattr(settings, name) <= 1.0:
                raise RosError(f"{name} must be 0 to 1, not {getattr(settings, name)!r}")
        self.forget()
        super().__init__(node, settings, use_mag=settings.use_mag)

    def forget(self) -> None:
        """Start again with the next measurement."""
        given = self.settings
        self.filter = ComplementaryFilter(
            given.gain_acc,
            given.gain_mag,
            given.bias_alpha,
            given.do_bias_estimation,
            given.do_adaptive_gain,
        )

    def orient(
        self, turn: Vector, acceleration: Vector, field_: Vector | None, seconds: float | None
    ) -> Quaternion | None:
        """Take a measurement, and return the orientation; None without gravity."""
        if field_ is not None and any(math.isnan(each) for each in field_):
            field_ = None
        self.filter.update(turn, acceleration, field_, seconds or 0.0)
        return self.filter.orientation

    def finish(self, message: sensor_msgs.msg.Imu) -> None:
        """Write the covariance, and subtract the bias of the gyroscope."""
        message.orientation_covariance = _diagonal(self.settings.orientation_stddev)
        x, y, z = self.filter.bias
        message.angular_velocity.x -= x
        message.angular_velocity.y -= y
        message.angular_velocity.z -= z


def madgwick_main(arguments: Sequence[str]) -> int:
    """Publish measurements with an orientation until shutdown; returns the exit code."""
    return run_node(arguments, "ImuFilter", MadgwickNode)


def complementary_main(arguments: Sequence[str]) -> int:
    """Publish measurements with an orientation until shutdown; returns the exit code."""
    return run_node(arguments, "ComplementaryFilterROS", ComplementaryNode)


def _vector(value: Any) -> Vector:
    return (value.x, value.y, value.z)


def _quaternion(value: Quaternion) -> geometry_msgs.msg.Quaternion:
    return geometry_msgs.msg.Quaternion(*value)


def _diagonal(deviation: float) -> list[float]:
    variance = deviation * deviation
    return [variance, 0.0, 0.0, 0.0, variance, 0.0, 0.0, 0.0, variance]
