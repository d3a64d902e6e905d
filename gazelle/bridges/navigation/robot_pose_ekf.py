"""The node ``robot_pose_ekf``: pose from odometry, IMU and visual odometry (http://wiki.ros.org/robot_pose_ekf)."""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.conversions import pose_message, pose_of_message, quaternion
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.bridges.navigation.transforms import TransformFinder
from gazelle.description import Pose
from gazelle.navigation.estimation.pose_fusion import PoseFusion, PoseFusionSettings
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND, Rate
from gazelle_ros.msgs import geometry_msgs, nav_msgs, robot_pose_ekf, sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf.naming import FramePrefixes, resolve_frame
from gazelle_ros.time import Time

_LOG = logging.getLogger(__name__)
_TOPICS = {"odom": "odom", "imu": "imu_data", "vo": "vo", "gps": "gps"}
_TITLES = {"odom": "Odometry", "imu": "IMU", "vo": "Visual Odometry", "gps": "GPS"}
_IMU_VARIANCE = 0.00017**2
"""Of an IMU that sends none [rad^2]."""
_IGNORED_VARIANCE = 1e12
_TRANSFORM_S = 0.5


def main(arguments: Sequence[str]) -> int:
    """Publish poses until shutdown; returns the exit code."""
    return run_node(arguments, "robot_pose_ekf", RobotPoseEkfNode)


@dataclass(slots=True)
class PoseInput:
    """State of a sensor.

    Attributes:
        topic: Of its messages.
        active: Whether it is used in the next update.
        first: Time of the first message since it was not active [ns]; None if there is none.
        stamp: Of the last message [ns].
        arrival: Of the last message [ns].
        count: Of messages.
        pose: Last one.
    """

    topic: str
    active: bool = False
    first: int | None = None
    stamp: int = 0
    arrival: int = 0
    count: int = 0
    pose: Pose | None = None


class RobotPoseEkfNode:
    """A `PoseFusion` on a graph.

    Args:
        node: On the graph; parameters are those of ``robot_pose_ekf``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self.settings = settings = PoseFusionSettings.read(values)
        if settings.debug:
            _LOG.warning("the parameter 'debug' is not supported: no files are written")
        self._node, self._lock = node, threading.RLock()
        self.fusion = PoseFusion()
        self._stamp = node.clock.now()
        self._sent = 0
        prefix = FramePrefixes(node).of(node.name)
        self._output = resolve_frame(prefix, settings.output_frame)
        self._base = resolve_frame(prefix, settings.base_footprint_frame)
        self.frames = GraphFrames(node)
        self._transforms = TransformFinder(self.frames, _TRANSFORM_S)
        kind = geometry_msgs.msg.PoseWithCovarianceStamped
        self._poses = node.advertise("~odom_combined", kind, queue_size=10)
        self.inputs = {
            name: PoseInput(node.resolve(topic))
            for name, topic in _TOPICS.items()
            if getattr(settings, f"{name}_used")
        }
        for name in self.inputs:
            self._subscribe(name)
        node.serve("~get_status", robot_pose_ekf.srv.GetStatus, self._status)
        self._diagnosis = StartDiagnosis(node, self._missing)

    def _subscribe(self, name: str) -> None:
        odometry = nav_msgs.msg.Odometry
        if name == "imu":
            self._node.subscribe(_TOPICS[name], sensor_msgs.msg.Imu, self._imu, queue_size=10)
        else:
            self._node.subscribe(
                _TOPICS[name], odometry, lambda each: self._odometry(name, each), queue_size=10
            )

    def run(self, stop: threading.Event) -> None:
        """Publish poses at the rate of ``freq`` until shutdown."""
        rate = Rate(self._node.clock, max(self.settings.freq, 1.0), reset=True)
        while not stop.is_set() and not self._node.closed:
            self._diagnosis.check(waiting=self.fusion.pose is None)
            self.cycle()
            rate.sleep(stop.is_set)

    def cycle(self) -> None:
        """Find the pose at the last time of which all sensors know, and publish it."""
        with self._lock:
            now, fusion = self._node.clock.now(), self.fusion
            for each in self.inputs.values():
                if now - each.arrival > self.settings.sensor_timeout * SECOND:
                    each.active, each.first = False, None
            active = {name: each for name, each in self.inputs.items() if each.active}
            self._stamp = min([now, *(each.stamp for each in active.values())])
            if fusion.pose is None:
                self._begin(active)
            elif active and fusion.update(active, self._stamp):
                self._publish(flat=not {"vo", "gps"} & set(active))

    def _begin(self, active: Mapping[str, PoseInput]) -> None:
        """Set the first estimate: from odometry, or from GPS with the heading of another."""
        poses = {name: each.pose for name, each in active.items() if each.pose is not None}
        if "gps" not in self.inputs:
            for name in ("odom", "vo"):
                if name in poses:
                    self.fusion.begin(poses[name], active[name].stamp)
                    return
            return
        turned = next((poses[name] for name in ("imu", "odom", "vo") if name in poses), None)
        if "gps" in poses and turned is not None:
            place = poses["gps"].position
            whole = Pose.from_quaternion(place, turned.quaternion)
            self.fusion.begin(whole, active["gps"].stamp)

    def _publish(self, *, flat: bool) -> None:
        pose = self.fusion.pose
        if pose is None:
            return
        message = geometry_msgs.msg.PoseWithCovarianceStamped()
        stamp = self.fusion.stamp
        message.header.stamp, message.header.frame_id = Time(nsecs=stamp), self._output
        message.pose.pose = pose_message(pose)
        message.pose.covariance = self.fusion.covariance.ravel().tolist()
        self._poses.publish(message)
        self._sent += 1
        if flat:
            pose = Pose.from_quaternion((pose.x, pose.y, 0.0), pose.quaternion)
        self.frames.send_in_space(self._output, self._base, stamp, pose)

    # What comes -----------------------------------------------------------------------------

    def _odometry(self, name: str, message: nav_msgs.msg.Odometry) -> None:
        pose = message.pose.pose
        covariance = np.array(message.pose.covariance, float).reshape(6, 6)
        if name == "odom":
            pose.position.z = 0.0
        if name == "gps":
            covariance = covariance[:3, :3]
            if math.isnan(pose.position.z):
                pose.position.z = 0.0
                covariance[2] = covariance[:, 2] = 0.0
                covariance[2, 2] = _IGNORED_VARIANCE
        self._add(name, message.header.stamp.to_nsec(), pose_of_message(pose), covariance)

    def _imu(self, message: sensor_msgs.msg.Imu) -> None:
        stamp = message.header.stamp.to_nsec()
        mounted = self._transforms.find(self._base, message.header.frame_id.strip("/"), stamp)
        if mounted is None:
            return
        turned = Pose.from_quaternion((0.0, 0.0, 0.0), quaternion(message.orientation))
        turned = Pose.from_quaternion((0.0, 0.0, 0.0), (turned * mounted.inverse()).quaternion)
        covariance = np.array(message.orientation_covariance, float).reshape(3, 3)
        if covariance[0, 0] == 0.0:
            covariance = _IMU_VARIANCE * np.eye(3)
        self._add("imu", stamp, turned, covariance)

    def _add(self, name: str, stamp: int, pose: Pose, covariance: Floats) -> None:
        with self._lock:
            each = self.inputs[name]
            each.count += 1
            if not self.fusion.add(name, stamp, pose, covariance):
                if each.count == 1:
                    _LOG.error("%s is ignored: a variance of its pose is zero", each.topic)
                return
            each.stamp, each.arrival, each.pose = stamp, self._node.clock.now(), pose
            if not each.active:
                each.first = stamp if each.first is None else each.first
                each.active = self._stamp >= each.first

    def _missing(self) -> list[str]:
        silent = [f"messages on {each.topic}" for each in self.inputs.values() if not each.count]
        return [*silent, *self._transforms.described()]

    def _status(self, _request: robot_pose_ekf.srv.GetStatusRequest) -> dict[str, Any]:
        def line(what: str, *, true: bool) -> str:
            return f"   - is {'' if true else 'NOT '}{what}"

        lines = ["Input:"]
        for name, title in _TITLES.items():
            each = self.inputs.get(name, PoseInput(self._node.resolve(_TOPICS[name])))
            lines += [
                f" * {title} sensor",
                line("used", true=name in self.inputs),
                line("active", true=each.active),
                f"   - received {each.count} messages",
                f"   - listens to topic {each.topic}",
            ]
        lines += [
            "Output:",
            " * Robot pose ekf filter",
            line("active", true=self.fusion.pose is not None),
            f"   - sent {self._sent} messages",
            f"   - publishes on topics {self._node.resolve('~odom_combined')} and /tf",
        ]
        return {"status": "\n".join(lines) + "\n"}
