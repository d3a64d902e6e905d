"""The node ``fake_localization``: a simulator's true pose in the form of amcl (http://wiki.ros.org/fake_localization)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Sequence

from gazelle.bridges.conversions import pose_message, pose_of_message, pose_of_transform
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames, missing_links
from gazelle.description import Pose
from gazelle_ros.base.parameter_values import value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import geometry_msgs, nav_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform
from gazelle_ros.tf.scan_queue import ScanQueue

_LOG = logging.getLogger(__name__)

_PARAMETERS = (
    "odom_frame_id", "base_frame_id", "global_frame_id", "transform_tolerance", "delta_x", "delta_y",
    "delta_yaw", "tf_prefix",
)  # fmt: skip


def main(arguments: Sequence[str]) -> int:
    """Localise until shutdown; returns the exit code."""
    return run_node(arguments, "fake_localization", FakeLocalizationNode)


class FakeLocalizationNode:
    """True poses of ``base_pose_ground_truth`` as ``amcl_pose``, ``particlecloud`` and a transform.

    Args:
        node: On the graph; parameters are those of ``fake_localization``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        warn_of_unknown(node.resolve("~"), values, _PARAMETERS)
        self._node = node
        self._odom = value_of(values, "odom_frame_id", "odom").strip("/")
        self._base = value_of(values, "base_frame_id", "base_link").strip("/")
        self._whole = value_of(values, "global_frame_id", "map").strip("/")
        self._ahead_ns = round(value_of(values, "transform_tolerance", 0.1) * SECOND)
        # The simulator's frame in the map. The original turns by -delta_yaw first, then moves.
        self._offset = Pose(
            x=-value_of(values, "delta_x", 0.0),
            y=-value_of(values, "delta_y", 0.0),
            yaw=-value_of(values, "delta_yaw", 0.0),
        )
        self._lock = threading.Lock()
        self.frames = GraphFrames(node)
        covariant = geometry_msgs.msg.PoseWithCovarianceStamped
        self._poses = node.advertise("amcl_pose", covariant, queue_size=1, latch=True)
        self._clouds = node.advertise(
            "particlecloud", geometry_msgs.msg.PoseArray, queue_size=1, latch=True
        )
        self._truths = ScanQueue(node, "base_pose_ground_truth", nav_msgs.msg.Odometry)
        self.frames.tree.on_change(self._truths.wake)
        node.subscribe("initialpose", covariant, self._move)
        self._diagnosis = StartDiagnosis(node, self._missing)

    def run(self, stop: threading.Event) -> None:
        """Publish poses as they come, until shutdown."""
        while not stop.is_set() and not self._node.closed:
            self._truths.work(self._odometry, self._localise)
            self._diagnosis.check(waiting=bool(self._missing()))

    def _missing(self) -> list[str]:
        found = missing_links(self.frames.tree, "", self._odom, self._base)
        if not self._truths.seen:
            topic = self._node.resolve("base_pose_ground_truth")
            found.append(f"true poses on {topic} (a simulator sends them)")
        return found

    def _odometry(self, truth: nav_msgs.msg.Odometry) -> StampedTransform | None:
        return self.frames.find(self._odom, self._base, truth.header.stamp.to_nsec())

    def _localise(self, truth: nav_msgs.msg.Odometry, odometry: StampedTransform) -> None:
        """Publish a true pose, and where odometry's frame is on the map by it."""
        with self._lock:
            base = self._offset * pose_of_message(truth.pose.pose)
        stamp = truth.header.stamp
        whole_to_odom = base * pose_of_transform(odometry).inverse()
        self.frames.send_in_space(
            self._whole, self._odom, stamp.to_nsec() + self._ahead_ns, whole_to_odom
        )
        message = geometry_msgs.msg.PoseWithCovarianceStamped()
        message.header.stamp, message.header.frame_id = stamp, self._whole
        message.pose.pose = pose_message(base)
        self._poses.publish(message)
        self._clouds.publish(
            geometry_msgs.msg.PoseArray(header=message.header, poses=[message.pose.pose])
        )

    def _move(self, message: geometry_msgs.msg.PoseWithCovarianceStamped) -> None:
        """Shift the map, so that the robot is where ``initialpose`` says."""
        frame = message.header.frame_id.strip("/")
        if frame != self._whole:
            _LOG.warning("initialpose is in frame '%s', treated as '%s'", frame, self._whole)
        stamp = message.header.stamp.to_nsec()
        now = self.frames.find(self._whole, self._base, stamp) or self.frames.find(
            self._whole, self._base
        )
        if now is None:
            _LOG.warning("initialpose is ignored: the robot is not on the map yet")
            return
        with self._lock:
            change = pose_of_message(message.pose.pose) * pose_of_transform(now).inverse()
            self._offset = change * self._offset
