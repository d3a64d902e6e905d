"""ROS topics of a costmap: its inputs and outputs."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, cast

import numpy as np

from gazelle.bridges.navigation.frames import GraphFrames, applied
from gazelle.bridges.navigation.maps import MapListener
from gazelle.bridges.navigation.messages import cloud_points, scan_points
from gazelle.errors import Error
from gazelle.navigation.costmap import CostmapSetup, ObstacleLayer, StaticLayer
from gazelle.navigation.costmap.footprint import footprint_of, placed
from gazelle.navigation.costmap.parameters import SensorTopic
from gazelle.navigation.costmap.values import Window, shown
from gazelle.navigation.following import Pose2
from gazelle_ros.clock import SECOND
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import geometry_msgs, map_msgs, nav_msgs, sensor_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

if TYPE_CHECKING:
    Cloud = sensor_msgs.msg.PointCloud | sensor_msgs.msg.PointCloud2
    Measurement = sensor_msgs.msg.LaserScan | Cloud

_PATIENCE_NS = SECOND
"""Longest time that a sensor reading waits for its transform [ns]."""
_MOST_WAITING = 50


class CostmapTopics:
    """Feeds a costmap and publishes it.

    Args:
        node: On the graph.
        name: Of the costmap: ``global_costmap`` or ``local_costmap``.
        setup: The costmap and its parameters.
        frames: Of the graph.

    Attributes:
        pose: Of the robot in the costmap's frame; None if it is not known.
        sensor_frame: Of what was seen last.
    """

    def __init__(self, node: Node, name: str, setup: CostmapSetup, frames: GraphFrames) -> None:
        self._node, self._setup, self._frames = node, setup, frames
        self.costmap = setup.costmap
        self.pose: Pose2 | None = None
        self.sensor_frame = ""
        self._inbox: list[tuple[SensorTopic, Measurement]] = []
        self._lock = threading.Lock()
        self._updated_ns = self._published_ns = -(1 << 62)
        self._drawn = False
        self._maps = {layer: MapListener(node, topic) for layer, topic in setup.map_topics.items()}
        for sensor in setup.sensors:
            kind = load_message(f"sensor_msgs/{sensor.kind}")
            node.subscribe(sensor.topic, kind, self._listener(sensor), queue_size=50)
        grid = nav_msgs.msg.OccupancyGrid
        self._full_requested = True
        self._grids = node.advertise(
            f"~{name}/costmap", grid, queue_size=1, on_connect=self._want_full
        )
        self._updates = node.advertise(
            f"~{name}/costmap_updates", map_msgs.msg.OccupancyGridUpdate, queue_size=1
        )
        polygon = geometry_msgs.msg.PolygonStamped
        self._outlines = node.advertise(f"~{name}/footprint", polygon, queue_size=1)
        topic = str(node.get_param(f"~{name}/footprint_topic", ""))
        if topic:
            node.subscribe(topic, geometry_msgs.msg.Polygon, self._take_footprint)

    def _want_full(self, peer: str) -> None:
        del peer
        self._full_requested = True

    def _listener(self, sensor: SensorTopic) -> Callable[[Measurement], None]:
        def take(message: Measurement) -> None:
            with self._lock:
                self._inbox.append((sensor, message))
                del self._inbox[:-_MOST_WAITING]

        return take

    def reset(self) -> None:
        """Clear the costmap; it is drawn again before the next plan."""
        self.costmap.reset()
        self._updated_ns = -(1 << 62)

    def missing(self) -> list[str]:
        """Return the missing inputs, besides frames."""
        return [
            f"a map on {self._node.resolve(topic)} (map_server or a SLAM node sends it)"
            for name, topic in self._setup.map_topics.items()
            for layer in self.costmap.layers
            if layer.name == name and isinstance(layer, StaticLayer) and not layer.current
        ]

    # Cycles -------------------------------------------------------------------------------

    def cycle(self, now: int) -> bool:
        """Process input, update and publish if due.

        Returns whether the costmap is ready for plans.
        """
        self._take_maps()
        self._take_seen(now)
        self.pose = self._frames.pose(self.costmap.frame, self._setup.base_frame)
        if self.pose is None or self.missing():
            return False
        if now < self._updated_ns:
            self._updated_ns = self._published_ns = -(1 << 62)
        rate = self._setup.update_frequency
        if rate > 0.0 and (now - self._updated_ns) * rate >= 0.99 * SECOND:
            self._updated_ns = now
            self._see_map()
            self.costmap.update(self.pose)
            self._drawn = True
        rate = self._setup.publish_frequency
        if rate > 0.0 and (now - self._published_ns) * rate >= 0.99 * SECOND:
            self._published_ns = now
            self._publish(now)
        return self._drawn

    def _take_maps(self) -> None:
        for layer in self.costmap.layers:
            listener = self._maps.get(layer.name)
            grid = listener.take() if listener is not None else None
            if grid is not None and isinstance(layer, StaticLayer):
                layer.set_map(grid, self.costmap)
                self._full_requested = True

    def _see_map(self) -> None:
        """Set the pose of a rolling costmap's frame on the map in static layers."""
        if not self.costmap.rolling:
            return
        for layer in self.costmap.layers:
            if isinstance(layer, StaticLayer):
                found = self._frames.pose("map", self.costmap.frame)
                if found is not None:
                    layer.to_map = found

    def _take_seen(self, now: int) -> None:
        with self._lock:
            waiting, self._inbox = self._inbox, []
        later = [each for each in waiting if not self._observe(*each)]
        fresh = [each for each in later if abs(now - each[1].header.stamp.to_nsec()) < _PATIENCE_NS]
        with self._lock:
            self._inbox = fresh + self._inbox

    def _observe(self, sensor: SensorTopic, message: Measurement) -> bool:
        """Process a measurement of a sensor; False if its transform is missing yet."""
        frame = message.header.frame_id.strip("/")
        self.sensor_frame = sensor.sensor_frame or frame
        stamp = message.header.stamp.to_nsec()
        found = self._frames.find(self.costmap.frame, frame, stamp)
        eye = self._frames.find(self.costmap.frame, self.sensor_frame, stamp)
        if found is None or eye is None:
            return False
        if sensor.kind == "LaserScan":
            scan = cast("sensor_msgs.msg.LaserScan", message)
            points = scan_points(scan, inf_is_valid=sensor.inf_is_valid)
        else:
            points = cloud_points(cast("Cloud", message))
        layer = next(each for each in self.costmap.layers if each.name == sensor.layer)
        if isinstance(layer, ObstacleLayer):
            origin = np.array(eye.translation)
            layer.observe(sensor.source, stamp / SECOND, origin, applied(found, points))
        return True

    def _take_footprint(self, message: geometry_msgs.msg.Polygon) -> None:
        corners = [[each.x, each.y] for each in message.points]
        try:
            self.costmap.set_footprint(footprint_of(corners, padding=self._setup.padding))
        except Error:
            return

    # Publishing ---------------------------------------------------------------------------

    def _publish(self, now: int) -> None:
        if self.pose is not None and self._outlines.num_connections:
            self._outlines.publish(self._outline(self.pose, now))
        if not self._grids.num_connections and not self._updates.num_connections:
            return
        if self._full_requested or self._setup.always_full or self.costmap.rolling:
            self._full_requested = False
            self._grids.publish(self._grid(now))
        else:
            self._updates.publish(self._update(self.costmap.updated, now))

    def _grid(self, now: int) -> nav_msgs.msg.OccupancyGrid:
        message = nav_msgs.msg.OccupancyGrid()
        message.header.frame_id, message.header.stamp = self.costmap.frame, Time(nsecs=now)
        info, cells = message.info, self.costmap.cells
        info.resolution = self.costmap.resolution
        info.height, info.width = cells.shape
        info.origin.position.x, info.origin.position.y = self.costmap.origin
        info.origin.orientation.w = 1.0
        message.data = shown(cells).ravel().tolist()
        return message

    def _update(self, window: Window, now: int) -> map_msgs.msg.OccupancyGridUpdate:
        message = map_msgs.msg.OccupancyGridUpdate()
        message.header.frame_id, message.header.stamp = self.costmap.frame, Time(nsecs=now)
        message.x, message.y = window.x0, window.y0
        message.width, message.height = window.x1 - window.x0, window.y1 - window.y0
        message.data = shown(self.costmap.cells[window.slices]).ravel().tolist()
        return message

    def _outline(self, pose: Pose2, now: int) -> geometry_msgs.msg.PolygonStamped:
        point = geometry_msgs.msg.Point32
        message = geometry_msgs.msg.PolygonStamped()
        message.header.frame_id, message.header.stamp = self.costmap.frame, Time(nsecs=now)
        message.polygon.points = [
            point(x=x, y=y, z=0.0) for x, y in placed(self.costmap.footprint, *pose).tolist()
        ]
        return message
