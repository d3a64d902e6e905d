"""Common base of nodes that make maps: topics of the map, frames, and scans."""

from __future__ import annotations

import threading
from abc import ABC, abstractmethod
from collections.abc import Collection
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames, flat, missing_links
from gazelle.bridges.navigation.map_messages import grid_message
from gazelle.bridges.navigation.messages import is_upside_down
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.following import Pose2
from gazelle_ros.base.parameter_values import value_of, warn_of_unknown
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.builtin.scans.points import beam_angles
from gazelle_ros.clock import SECOND
from gazelle_ros.msgs import nav_msgs, sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform
from gazelle_ros.tf.scan_queue import ScanQueue

_PARAMETERS = ("odom_frame", "base_frame", "map_frame", "throttle_scans", "tf_prefix")


class MappingNode(ABC):
    """Publishes ``map`` and ``map_metadata``, serves ``dynamic_map``, and sends map to odometry.

    Args:
        node: On the graph.
        base: Default of ``base_frame``.
        scans: Topic of the scans.
        interval: Between two maps [s].
        period: Between two transforms [s]; none if it is 0.
        ahead: Time by which transforms are dated ahead [s].
        known: Parameters that are read elsewhere; others are warned of.
    """

    def __init__(
        self,
        node: Node,
        base: str,
        scans: str,
        interval: float,
        period: float,
        ahead: float,
        known: Collection[str],
    ) -> None:
        self._node = node
        self._values = private_values(node)
        warn_of_unknown(node.resolve("~"), self._values, {*_PARAMETERS, *known})
        self._odom = value_of(self._values, "odom_frame", "odom").strip("/")
        self._base = value_of(self._values, "base_frame", base).strip("/")
        self._whole = value_of(self._values, "map_frame", "map").strip("/")
        self._every = max(value_of(self._values, "throttle_scans", 1), 1)
        self._interval_ns = round(interval * SECOND)
        self._period_ns, self._ahead_ns = round(period * SECOND), round(ahead * SECOND)
        self._sent_ns = self._mapped_ns = -(1 << 62)
        self._count = 0
        self._lock = threading.Lock()
        self._message: Any = None
        self.frames = GraphFrames(node)
        self._scans = ScanQueue(node, scans, sensor_msgs.msg.LaserScan)
        self.frames.tree.on_change(self._scans.wake)
        grid, info = nav_msgs.msg.OccupancyGrid, nav_msgs.msg.MapMetaData
        self._maps = node.advertise("map", grid, queue_size=1, latch=True)
        self._infos = node.advertise("map_metadata", info, queue_size=1, latch=True)
        node.serve("dynamic_map", nav_msgs.srv.GetMap, self._dynamic_map)
        self._topic = scans
        self._diagnosis = StartDiagnosis(node, self._missing)

    needs_odometry = True
    """True if a scan waits for the odometry of its time."""

    @abstractmethod
    def place(self) -> Pose2 | None:
        """Return the pose of the odometry frame on the map; None if it is not known."""

    @abstractmethod
    def process_scan(
        self,
        message: sensor_msgs.msg.LaserScan,
        ranges: Floats,
        angles: Floats,
        laser: Pose2,
        odom: Pose2 | None,
    ) -> bool:
        """Process a scan; returns whether the map has changed.

        Args:
            message: The scan.
            ranges: [m], shape (n,).
            angles: Of the beams in the laser's frame [rad], shape (n,).
            laser: Pose of the laser on the robot.
            odom: Odometry of the robot; None where that is not `needs_odometry`.
        """

    @abstractmethod
    def drawn(self) -> OccupancyMap:
        """Return the map."""

    def run(self, stop: threading.Event) -> None:
        """Process scans until shutdown."""
        while not stop.is_set() and not self._node.closed:
            self._scans.work(self._find, self._use)
            self._send()
            self._diagnosis.check(waiting=self.place() is None)

    def _missing(self) -> list[str]:
        found = missing_links(self.frames.tree, "", self._odom, self._base, self._scans.frame)
        if not self._scans.seen:
            found.append(f"scans on {self._node.resolve(self._topic)} (a laser sends them)")
        return found

    def _find(
        self, message: sensor_msgs.msg.LaserScan
    ) -> tuple[StampedTransform, Pose2 | None] | None:
        """Return the poses of laser and robot; None if transforms are not available yet."""
        mounted = self.frames.find(self._base, message.header.frame_id.strip("/"))
        odom = None
        if self.needs_odometry:
            odom = self.frames.pose(self._odom, self._base, message.header.stamp.to_nsec())
        if mounted is None or (odom is None and self.needs_odometry):
            return None
        return mounted, odom

    def _use(
        self, message: sensor_msgs.msg.LaserScan, found: tuple[StampedTransform, Pose2 | None]
    ) -> None:
        """Process a scan."""
        mounted, odom = found
        self._count += 1
        if self._count % self._every:
            return
        sign = -1.0 if is_upside_down(mounted.rotation) else 1.0
        ranges = np.array(message.ranges, np.float64)
        changed = self.process_scan(
            message, ranges, sign * beam_angles(message), flat(mounted), odom
        )
        stamp = message.header.stamp.to_nsec()
        late = self._message is None or abs(stamp - self._mapped_ns) >= self._interval_ns
        if changed and late:
            self._mapped_ns = stamp
            self._publish(stamp)
        self._send()

    def _publish(self, stamp: int) -> None:
        message = grid_message(self.drawn(), self._whole, stamp)
        with self._lock:
            self._message = message
        self._maps.publish(message)
        self._infos.publish(message.info)

    def _send(self) -> None:
        """Publish the pose of the odometry on the map, dated ahead."""
        now, place = self._node.clock.now(), self.place()
        if place is None or self._period_ns <= 0:
            return
        if now < self._sent_ns or now - self._sent_ns >= self._period_ns:
            self._sent_ns = now
            self.frames.send(self._whole, self._odom, now + self._ahead_ns, place)

    def _dynamic_map(self, request: nav_msgs.srv.GetMapRequest) -> list[nav_msgs.msg.OccupancyGrid]:
        del request
        with self._lock:
            found = self._message
        return [nav_msgs.msg.OccupancyGrid() if found is None else found]
