"""The node ``hector_mapping``: a map from scans alone (http://wiki.ros.org/hector_mapping)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.frames import flat
from gazelle.bridges.navigation.mapping_node import MappingNode
from gazelle.bridges.navigation.messages import pose_of
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle.navigation.mapping.hector import HectorSettings, HectorSlam
from gazelle.navigation.planners.planar import composed, inverse
from gazelle.rotations import from_yaw
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.msgs import (
    geometry_msgs,
    hector_mapping,
    nav_msgs,
    sensor_msgs,
    std_msgs,
    std_srvs,
)
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_OTHERS = (
    "map_pub_period", "scan_topic", "pub_map_odom_transform", "pub_map_scanmatch_transform",
    "tf_map_scanmatch_transform_frame_name", "use_tf_pose_start_estimate", "pose_update_topic",
    "sys_msg_topic", "pub_odometry",
)  # fmt: skip
"""Parameters that are not part of `HectorSettings`."""
_UNUSED = (
    "pub_drawings", "pub_debug_output", "advertise_map_service", "scan_subscriber_queue_size",
    "use_tf_scan_transformation", "output_timing", "laser_z_min_value", "laser_z_max_value",
)  # fmt: skip
"""Parameters of the original that change nothing here."""


def main(arguments: Sequence[str]) -> int:
    """Run the mapping until shutdown; returns the exit code."""
    return run_node(arguments, "hector_mapping", HectorNode)


class HectorNode(MappingNode):
    """A `HectorSlam` on a graph.

    Args:
        node: On the graph; parameters are those of ``hector_mapping``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self.slam = HectorSlam(HectorSettings.read(values))
        self._start: Pose2 | None = None
        self._place: Pose2 | None = None
        self._paused = False
        interval = value_of(values, "map_pub_period", 2.0)
        scans = value_of(values, "scan_topic", "scan")
        known = [*(each.name for each in fields(HectorSettings)), *_OTHERS, *_UNUSED]
        super().__init__(node, "base_link", scans, interval, 0.0, 0.0, known)
        self.needs_odometry = value_of(values, "pub_map_odom_transform", True)
        self._sends_match = value_of(values, "pub_map_scanmatch_transform", True)
        name = "tf_map_scanmatch_transform_frame_name"
        self._match_frame = value_of(values, name, "scanmatcher_frame").strip("/")
        self._from_tf = value_of(values, "use_tf_pose_start_estimate", False)
        covariant = geometry_msgs.msg.PoseWithCovarianceStamped
        topic = value_of(values, "pose_update_topic", "poseupdate")
        self._updates = node.advertise(topic, covariant, queue_size=1)
        self._odometry = None
        if value_of(values, "pub_odometry", False):
            self._odometry = node.advertise("scanmatch_odom", nav_msgs.msg.Odometry, queue_size=50)
        self._stamped = geometry_msgs.msg.PoseStamped
        self._poses = node.advertise("slam_out_pose", self._stamped, queue_size=1)
        commands = value_of(values, "sys_msg_topic", "syscommand")
        node.subscribe(commands, std_msgs.msg.String, self._command)
        node.subscribe("initialpose", covariant, self._begin)
        node.serve("reset_map", std_srvs.srv.Trigger, self._reset)
        node.serve("pause_mapping", std_srvs.srv.SetBool, self._pause)
        node.serve("restart_mapping_with_new_pose", hector_mapping.srv.ResetMapping, self._restart)

    def place(self) -> Pose2 | None:
        """Return the pose of the odometry frame on the map."""
        return self._place

    def drawn(self) -> OccupancyMap:
        """Return the map."""
        return self.slam.map()

    def process_scan(
        self,
        message: sensor_msgs.msg.LaserScan,
        ranges: Floats,
        angles: Floats,
        laser: Pose2,
        odom: Pose2 | None,
    ) -> bool:
        """Process a scan; returns whether the map has changed."""
        stamp = message.header.stamp.to_nsec()
        if self._paused:
            return False
        ranges[ranges >= message.range_max] = np.inf
        start, self._start = self._start, None
        if start is None and self._from_tf:
            start = self.frames.pose(self._whole, self._base, stamp)
        changed = self.slam.update(ranges, angles, laser, start)
        self._place = self.slam.pose if odom is None else composed(self.slam.pose, inverse(odom))
        self._publish_pose(message.header.stamp, stamp, odom)
        return changed

    def _publish_pose(self, stamp: Time, at: int, odom: Pose2 | None) -> None:
        """Publish the pose, and the requested transforms."""
        pose = self._stamped()
        pose.header.frame_id, pose.header.stamp = self._whole, stamp
        x, y, heading = self.slam.pose
        pose.pose.position.x, pose.pose.position.y = x, y
        turn = pose.pose.orientation
        turn.x, turn.y, turn.z, turn.w = from_yaw(np.array(heading)).tolist()
        self._poses.publish(pose)
        update = geometry_msgs.msg.PoseWithCovarianceStamped()
        update.header, update.pose.pose = pose.header, pose.pose
        self._updates.publish(update)
        if self._odometry is not None:
            odometry = nav_msgs.msg.Odometry(header=pose.header, child_frame_id=self._base)
            odometry.pose = update.pose
            self._odometry.publish(odometry)
        if odom is not None and self._place is not None:
            self.frames.send(self._whole, self._odom, at, self._place)
        if self._sends_match:
            self.frames.send(self._whole, self._match_frame, at, self.slam.pose)

    def _missing(self) -> list[str]:
        found = super()._missing()
        return found if self.needs_odometry else [each for each in found if "drive" not in each]

    def _command(self, message: std_msgs.msg.String) -> None:
        if message.data == "reset":
            self.slam.reset()

    def _begin(self, message: geometry_msgs.msg.PoseWithCovarianceStamped) -> None:
        """Continue from another pose on the map."""
        found = self.frames.find(self._whole, message.header.frame_id.strip("/") or self._whole)
        frame = (0.0, 0.0, 0.0) if found is None else flat(found)
        self._start = composed(frame, pose_of(message.pose.pose))

    def _reset(self, request: std_srvs.srv.TriggerRequest) -> list[Any]:
        del request
        self.slam.reset()
        return [True, ""]

    def _restart(self, request: hector_mapping.srv.ResetMappingRequest) -> list[Any]:
        """Start a new map from a pose, also where it paused."""
        self.slam.reset()
        self._start, self._paused = pose_of(request.initial_pose), False
        return []

    def _pause(self, request: std_srvs.srv.SetBoolRequest) -> list[Any]:
        self._paused = bool(request.data)
        return [True, ""]
