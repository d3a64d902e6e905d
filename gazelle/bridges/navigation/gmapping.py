"""The node ``slam_gmapping``: a map while driving (http://wiki.ros.org/gmapping)."""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames, flat, missing_links
from gazelle.bridges.navigation.messages import beam_angles, is_upside_down
from gazelle.bridges.navigation.scan_queue import ScanQueue
from gazelle.navigation.costmap.parameters import value_of
from gazelle.navigation.mapping import GmappingSettings, GridSlam
from gazelle.ros.builtin.arguments import parse_arguments
from gazelle.ros.builtin.map_server import grid_message
from gazelle.ros.messages import load_message, load_service
from gazelle.ros.node import Node
from gazelle.ros.signals import stopping

SECOND = 1_000_000_000


def main(arguments: Sequence[str]) -> int:
    """Map until it is told to end; returns the exit code."""
    found = parse_arguments(arguments, "slam_gmapping")
    with found.start() as node, stopping() as stop:
        node.on_shutdown.append(lambda _reason: stop.set())
        GmappingNode(node).run(stop)
    return 0


class GmappingNode:
    """A `GridSlam` on a graph.

    Args:
        node: On the graph; parameters are those of ``slam_gmapping``.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        values: Mapping[str, Any] = node.get_param(node.name, {}) or {}
        self.slam = GridSlam(GmappingSettings.read(values), int(value_of(values, "seed", 0)))
        self._odom = value_of(values, "odom_frame", "odom").strip("/")
        self._base = value_of(values, "base_frame", "base_link").strip("/")
        self._whole = value_of(values, "map_frame", "map").strip("/")
        self._every = max(value_of(values, "throttle_scans", 1), 1)
        self._interval_ns = round(value_of(values, "map_update_interval", 5.0) * SECOND)
        period = value_of(values, "transform_publish_period", 0.05)
        self._period_ns = round(period * SECOND)
        self._ahead_ns = round(value_of(values, "tf_delay", period) * SECOND)
        self._sent_ns = self._mapped_ns = -(1 << 62)
        self._count = 0
        self._lock = threading.Lock()
        self._message: Any = None
        self.frames = GraphFrames(node)
        self._scans = ScanQueue(node, "scan", load_message("sensor_msgs/LaserScan"))
        self.frames.tree.on_change(self._scans.wake)
        grid, info = load_message("nav_msgs/OccupancyGrid"), load_message("nav_msgs/MapMetaData")
        self._maps = node.advertise("map", grid, queue_size=1, latch=True)
        self._infos = node.advertise("map_metadata", info, queue_size=1, latch=True)
        self._entropies = node.advertise("~entropy", load_message("std_msgs/Float64"), latch=True)
        node.serve("dynamic_map", load_service("nav_msgs/GetMap"), self._dynamic_map)
        self._diagnosis = StartDiagnosis(node, self._missing)

    def run(self, stop: threading.Event) -> None:
        """Take scans until told to end."""
        while not stop.is_set() and not self._node.closed:
            self._scans.work(self._use)
            self._send()
            self._diagnosis.look(waiting=self.slam.map_to_odom is None)

    def _missing(self) -> list[str]:
        found = missing_links(self.frames.tree, "", self._odom, self._base, self._scans.frame)
        if not self._scans.seen:
            found.append(f"scans on {self._node.resolve('scan')} (a laser sends them)")
        return found

    def _use(self, message: Any) -> bool:
        """Take a scan; False if its transforms are not there yet."""
        stamp = message.header.stamp.to_nsec()
        mounted = self.frames.find(self._base, message.header.frame_id.strip("/"))
        odom = self.frames.pose(self._odom, self._base, stamp)
        if mounted is None or odom is None:
            return False
        self._count += 1
        if self._count % self._every:
            return True
        sign = -1.0 if is_upside_down(mounted.rotation) else 1.0
        ranges = np.array(message.ranges, np.float64)
        # What is too near is as good as nothing.
        ranges[ranges < message.range_min] = message.range_max
        angles = sign * beam_angles(message)
        changed = self.slam.update(
            stamp / SECOND, odom, ranges, angles, float(message.range_max), flat(mounted)
        )
        if changed:
            entropy: Any = load_message("std_msgs/Float64")()
            entropy.data = self.slam.entropy()
            self._entropies.publish(entropy)
            if self._message is None or abs(stamp - self._mapped_ns) >= self._interval_ns:
                self._mapped_ns = stamp
                self._publish(stamp)
        self._send()
        return True

    def _publish(self, stamp: int) -> None:
        message = grid_message(self.slam.map(), self._whole, stamp)
        with self._lock:
            self._message = message
        self._maps.publish(message)
        self._infos.publish(message.info)

    def _send(self) -> None:
        """Say where the odometry is on the map, dated ahead."""
        now, place = self._node.clock.now(), self.slam.map_to_odom
        if place is None or self._period_ns <= 0:
            return
        if now < self._sent_ns or now - self._sent_ns >= self._period_ns:
            self._sent_ns = now
            self.frames.send(self._whole, self._odom, now + self._ahead_ns, place)

    def _dynamic_map(self, request: Any) -> list[Any]:
        del request
        with self._lock:
            found = self._message
        return [load_message("nav_msgs/OccupancyGrid")() if found is None else found]
