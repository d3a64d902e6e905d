"""The nodes ``ekf_localization_node`` and ``ukf_localization_node`` (http://wiki.ros.org/robot_localization)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.bridges.conversions import point, pose_of_message
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.filter_messages import (
    acceleration_message,
    base_pose,
    diagnostics_message,
    odometry_message,
)
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.bridges.navigation.fused_sources import FusedSource
from gazelle.bridges.navigation.transforms import TransformFinder
from gazelle.navigation.estimation.control import StampedCommand
from gazelle.navigation.estimation.kalman import (
    PROCESS_NOISE,
    Estimate,
    KalmanFilter,
    Prediction,
)
from gazelle.navigation.estimation.motion import ANGULAR, POSE, SIZE, rotated_covariance
from gazelle.navigation.estimation.prediction import ExtendedPrediction, UnscentedPrediction
from gazelle.navigation.estimation.sensors import FusionFrames
from gazelle.navigation.estimation.settings import FilterSettings
from gazelle.navigation.estimation.timeline import FusionTimeline
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND, Rate
from gazelle_ros.msgs import (
    diagnostic_msgs,
    geometry_msgs,
    nav_msgs,
    robot_localization,
    std_srvs,
)
from gazelle_ros.node import Node
from gazelle_ros.tf.naming import FramePrefixes, resolve_frame

_LOG = logging.getLogger(__name__)
_DIAGNOSTICS_S = 1.0
_SET_VARIANCE = 1e-6
"""Of what a message on ``set_pose`` does not have."""


def extended(arguments: Sequence[str]) -> int:
    """Run ``ekf_localization_node`` until shutdown; returns the exit code."""
    return run_node(
        arguments, "ekf_localization_node", lambda node: LocalizationFilterNode(node, _extended)
    )


def unscented(arguments: Sequence[str]) -> int:
    """Run ``ukf_localization_node`` until shutdown; returns the exit code."""
    return run_node(
        arguments, "ukf_localization_node", lambda node: LocalizationFilterNode(node, _unscented)
    )


def _extended(_values: Mapping[str, Any]) -> Prediction:
    return ExtendedPrediction()


def _unscented(values: Mapping[str, Any]) -> Prediction:
    return UnscentedPrediction(
        value_of(values, "alpha", 0.001),
        value_of(values, "kappa", 0.0),
        value_of(values, "beta", 2.0),
    )


class LocalizationFilterNode:
    """A `KalmanFilter` on a graph.

    Args:
        node: On the graph; parameters are those of ``robot_localization``.
        prediction: Makes the law of prediction from the parameters.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(
        self, node: Node, prediction: Callable[[Mapping[str, Any]], Prediction] = _extended
    ) -> None:
        values = private_values(node)
        self.settings = settings = FilterSettings.read(values)
        noise = PROCESS_NOISE if settings.process_noise is None else settings.process_noise
        self.kalman = KalmanFilter(
            prediction(values),
            process_noise=noise,
            initial_state=settings.initial_state,
            initial_covariance=settings.initial_covariance,
            control=settings.control,
            dynamic_noise=settings.dynamic_process_noise_covariance,
        )
        self._timeline = FusionTimeline(
            self.kalman,
            sensor_timeout=round(settings.sensor_timeout * SECOND),
            predict_to_now=settings.predict_to_current_time,
            smooth=settings.smooth_lagged_data,
            history=round(settings.history_length * SECOND),
        )
        self._node, self._lock = node, threading.RLock()
        self._enabled, self._on = not settings.disabled_at_startup, True
        self._published = self._turned_at = 0
        self._turning, self._interval = np.zeros(3), 1.0
        self._warnings: dict[str, str] = {}
        self._count = 0
        self.frames = GraphFrames(node)
        self._transforms = TransformFinder(self.frames, settings.transform_timeout)
        prefix = FramePrefixes(node).of(node.name)
        names = (
            "map_frame",
            "odom_frame",
            "base_link_frame",
            "base_link_frame_output",
            "world_frame",
        )
        self._frame = {each: resolve_frame(prefix, getattr(settings, each)) for each in names}
        self._fusion = FusionFrames(
            self._frame["world_frame"],
            self._frame["base_link_frame"],
            self._transforms.find,
            flat=settings.two_d_mode,
            gravity=settings.gravitational_acceleration,
        )
        self._advertise()
        self._sources = [
            FusedSource(
                node, each, self._fusion, self.kalman,
                lock=self._lock, add=self._timeline.add, jumped=self._jump, report=self._warn,
            )
            for each in settings.sources
        ]  # fmt: skip
        self._serve()
        self._diagnosis = StartDiagnosis(node, self._missing)

    def _advertise(self) -> None:
        node, settings = self._node, self.settings
        self._odometry = node.advertise("odometry/filtered", nav_msgs.msg.Odometry, queue_size=20)
        self._accelerations = self._diagnostics = None
        if settings.publish_acceleration:
            kind = geometry_msgs.msg.AccelWithCovarianceStamped
            self._accelerations = node.advertise("accel/filtered", kind, queue_size=20)
        if settings.print_diagnostics:
            array = diagnostic_msgs.msg.DiagnosticArray
            self._diagnostics = node.advertise("/diagnostics", array, queue_size=10)

    def _serve(self) -> None:
        node, srv = self._node, robot_localization.srv
        stamped = geometry_msgs.msg.PoseWithCovarianceStamped
        node.subscribe("set_pose", stamped, self._set_pose, queue_size=1)
        node.serve("set_pose", srv.SetPose, self._set_pose_by_service)
        node.serve("~enable", std_srvs.srv.Empty, self._enable)
        node.serve("~toggle", srv.ToggleFilterProcessing, self._toggle)
        if self.settings.use_control and self.settings.stamped_control:
            node.subscribe("cmd_vel", geometry_msgs.msg.TwistStamped, self._command_stamped, 1)
        elif self.settings.use_control:
            node.subscribe("cmd_vel", geometry_msgs.msg.Twist, self._command, queue_size=1)

    # The cycle ------------------------------------------------------------------------------

    def run(self, stop: threading.Event) -> None:
        """Publish estimates at the rate of ``frequency`` until shutdown."""
        rate = Rate(self._node.clock, self.settings.frequency, reset=True)
        begin = self._node.clock.now()
        while not stop.is_set() and not self._node.closed:
            self._diagnosis.check(waiting=bool(self._missing()))
            self.cycle()
            now = self._node.clock.now()
            if not 0 <= now - begin < _DIAGNOSTICS_S * SECOND:
                self._report(now, max(now - begin, 0) / SECOND)
                begin = now
            rate.sleep(stop.is_set)

    def cycle(self) -> None:
        """Process the measurements up to now, and publish the estimate."""
        with self._lock:
            if not self._enabled:
                return
            now, kalman = self._node.clock.now(), self.kalman
            if self._on:
                self._timeline.integrate(now)
                self._differentiate(now)
            else:
                self._timeline.discard_queue()
                if kalman.initialised:
                    before = kalman.estimate
                    kalman.estimate = Estimate(before.state, before.covariance, now, before.command)
            estimate = kalman.estimate
            if kalman.initialised:
                self._publish(estimate)

    def _differentiate(self, now: int) -> None:
        """Note the angular acceleration since the last cycle."""
        if not self.kalman.initialised or now <= self._turned_at:
            return
        turning = self.kalman.estimate.state[ANGULAR]
        seconds = (now - self._turned_at) / SECOND
        self._fusion.angular_acceleration = (turning - self._turning) / seconds
        self._turning, self._turned_at = turning, now
        self._interval = seconds

    def _publish(self, estimate: Estimate) -> None:
        """Publish an estimate, unless it is a correction of one that was published."""
        before, self._published = self._published, estimate.stamp
        if estimate.stamp <= before and not self.settings.permit_corrected_publication:
            return
        if not np.isfinite(estimate.state).all():
            self._warn("estimate", "it is not finite: a covariance is ill conditioned")
            return
        world, base = self._frame["world_frame"], self._frame["base_link_frame_output"]
        if self.settings.publish_tf:
            self._send_transform(estimate, world, base)
        self._odometry.publish(odometry_message(estimate, world, base))
        self._count += 1
        turning = self._fusion.angular_acceleration
        if self._accelerations is not None and turning is not None:
            self._accelerations.publish(
                acceleration_message(estimate, base, turning, self._interval)
            )

    def _send_transform(self, estimate: Estimate, world: str, base: str) -> None:
        stamp = estimate.stamp + round(self.settings.transform_time_offset * SECOND)
        pose = base_pose(estimate.state)
        if self.settings.invert_tf:
            self.frames.send_in_space(base, world, stamp, pose.inverse())
        elif world == self._frame["odom_frame"]:
            self.frames.send_in_space(world, base, stamp, pose)
        else:
            odom = self._frame["odom_frame"]
            found = self._transforms.find(self._frame["base_link_frame"], odom, estimate.stamp)
            if found is not None:
                self.frames.send_in_space(world, odom, stamp, pose * found)

    # What others want -----------------------------------------------------------------------

    def _command(self, message: geometry_msgs.msg.Twist) -> None:
        self._take_command(message, self._node.clock.now())

    def _command_stamped(self, message: geometry_msgs.msg.TwistStamped) -> None:
        frame = message.header.frame_id.strip("/")
        if frame in ("", self._frame["base_link_frame"]):
            self._take_command(message.twist, message.header.stamp.to_nsec())
        else:
            self._warn("cmd_vel", f"it is in '{frame}' and ignored, as it is not in the robot's")

    def _take_command(self, twist: geometry_msgs.msg.Twist, stamp: int) -> None:
        velocities = np.array((*point(twist.linear), *point(twist.angular)))
        with self._lock:
            self.kalman.command(StampedCommand(velocities, stamp))

    def _set_pose(self, message: geometry_msgs.msg.PoseWithCovarianceStamped) -> None:
        """Restart at a pose, at rest."""
        with self._lock:
            self._forget()
            stamp, world = message.header.stamp.to_nsec(), self._frame["world_frame"]
            frame = message.header.frame_id.strip("/") or world
            found = self._transforms.find(world, frame, stamp)
            if found is None:
                _LOG.warning(
                    "set_pose is ignored: there is no transform from %s to %s", frame, world
                )
                return
            pose = found * pose_of_message(message.pose.pose)
            state, covariance = np.zeros(SIZE), _SET_VARIANCE * np.eye(SIZE)
            state[POSE] = (*pose.position, *pose.rpy)
            given = np.array(message.pose.covariance, float).reshape(6, 6)
            covariance[POSE, POSE] = rotated_covariance(found.matrix()[:3, :3], given)
            now = self._node.clock.now()
            command = self.kalman.estimate.command
            self.kalman.estimate = Estimate(state, covariance, now, command)
            for each in self._sources:
                each.ignore_until = stamp

    def _set_pose_by_service(
        self, request: robot_localization.srv.SetPoseRequest
    ) -> dict[str, Any]:
        self._set_pose(request.pose)
        return {}

    def _enable(self, _request: std_srvs.srv.EmptyRequest) -> dict[str, Any]:
        self._enabled = True
        return {}

    def _toggle(
        self, request: robot_localization.srv.ToggleFilterProcessingRequest
    ) -> dict[str, Any]:
        changed, self._on = self._on != bool(request.on), bool(request.on)
        return {"status": changed}

    def _forget(self) -> None:
        self._timeline.clear()
        self._published = 0
        for each in self._sources:
            each.forget()

    def _jump(self) -> bool:
        """Restart if time went back and that is wanted; returns whether it was."""
        if not (self.settings.reset_on_time_jump and self._node.clock.simulated):
            return False
        self._forget()
        for each in self._sources:
            each.ignore_until = 0
        self.kalman.reset()
        self.frames.tree.clear()
        self._fusion.angular_acceleration = None
        self._turned_at = 0
        return True

    # Warnings -------------------------------------------------------------------------------

    def _warn(self, name: str, text: str) -> None:
        if name not in self._warnings:
            _LOG.debug("%s: %s", name, text)
        self._warnings[name] = text

    def _report(self, now: int, seconds: float) -> None:
        with self._lock:
            warnings, self._warnings = self._warnings, {}
            count, self._count = self._count, 0
        if self._diagnostics is not None and seconds > 0.0:
            name, rate = self._node.name.lstrip("/"), count / seconds
            self._diagnostics.publish(
                diagnostics_message(name, now, warnings, rate, self.settings.frequency)
            )

    def _missing(self) -> list[str]:
        if self.kalman.initialised and not self._transforms.missing:
            return []
        silent = [f"messages on {each.topic}" for each in self._sources if not each.seen]
        return [*silent, *self._transforms.described()]
