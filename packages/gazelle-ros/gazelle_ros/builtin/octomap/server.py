"""The node ``octomap_server``: clouds of points as a map of occupied and free space (http://wiki.ros.org/octomap_server)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from gazelle_ros.base.array_types import Bools, Floats
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.arguments import parse_arguments, run_node
from gazelle_ros.builtin.octomap.codec import binary_tree, full_tree
from gazelle_ros.builtin.octomap.messages import cubes, octomap, projected
from gazelle_ros.builtin.octomap.reader import OctomapFile, read_octomap
from gazelle_ros.builtin.octomap.settings import OctomapSettings
from gazelle_ros.builtin.octomap.voxels import VoxelMap
from gazelle_ros.builtin.scans.conversion import StampedWork
from gazelle_ros.builtin.scans.points import cloud_points, moved
from gazelle_ros.compat.sensor_msgs.point_cloud2 import create_cloud_xyz32
from gazelle_ros.msgs import (
    nav_msgs,
    octomap_msgs,
    sensor_msgs,
    std_msgs,
    std_srvs,
    visualization_msgs,
)
from gazelle_ros.node import Node
from gazelle_ros.tf import StampedTransform
from gazelle_ros.time import Time

_QUEUE = 5
_LOG = logging.getLogger("gazelle.ros.octomap")


class OctomapServer(StampedWork[StampedTransform]):
    """A map of the clouds of ``cloud_in``, on topics and by services.

    Each topic is published after a cloud, and for a new subscriber, while it has subscribers.

    Args:
        node: On the graph.
        file: A map to begin with; that of the parameter ``~map_file`` if "".

    Raises:
        Error: A parameter is wrong, or the file cannot be read.

    Attributes:
        map: The map.
    """

    def __init__(self, node: Node, file: str = "") -> None:
        self.settings = OctomapSettings.read(node)
        super().__init__(node, {self.settings.frame_id}, _QUEUE)
        begun = self._begun(Path(file or self.settings.map_file))
        self.map = VoxelMap(self.settings.resolution, self.settings.sensor)
        if begun is not None:
            self.map.load(begun.codes, begun.values)
        self._stamp = Time(0)
        self._lock = threading.RLock()
        kinds = {
            "octomap_binary": (octomap_msgs.msg.Octomap, self._binary),
            "octomap_full": (octomap_msgs.msg.Octomap, self._full),
            "octomap_point_cloud_centers": (sensor_msgs.msg.PointCloud2, self._cloud),
            "projected_map": (nav_msgs.msg.OccupancyGrid, self._projected),
            "occupied_cells_vis_array": (visualization_msgs.msg.MarkerArray, self._occupied_cubes),
            "free_cells_vis_array": (visualization_msgs.msg.MarkerArray, self._free_cubes),
        }
        self._topics: dict[str, Any] = {}
        for topic, (kind, make) in kinds.items():
            show = partial(self._show, topic)
            self._topics[topic] = node.advertise(topic, kind, queue_size=1, on_connect=show), make
        get = octomap_msgs.srv.GetOctomap
        node.serve("octomap_binary", get, lambda _request: [self._binary()])
        node.serve("octomap_full", get, lambda _request: [self._full()])
        node.serve("~clear_bbx", octomap_msgs.srv.BoundingBoxQuery, self._clear)
        node.serve("~reset", std_srvs.srv.Empty, self._reset)
        node.subscribe("cloud_in", sensor_msgs.msg.PointCloud2, self.queue.add, _QUEUE)

    def _begun(self, path: Path) -> OctomapFile | None:
        """Return the map to begin with, if there is any; its resolution is that of the node then."""
        if path == Path():
            return None
        found = read_octomap(path)
        self.settings = replace(self.settings, resolution=found.resolution)
        _LOG.info("the map %s is loaded (%d cells)", path, len(found.codes))
        return found

    def find(self, message: Any) -> StampedTransform:
        """Return the transform of a cloud to the frame of the map.

        Raises:
            TransformException: It is not known, or that to the base where the ground is filtered.
        """
        frame, own = self.settings.frame_id.strip("/"), message.header.frame_id.strip("/")
        stamp = message.header.stamp.to_nsec()
        if self.settings.filter_ground:
            self._to_base(stamp)
        return StampedTransform(stamp) if own == frame else self.tree.lookup(frame, own, stamp)

    def use(self, message: Any, found: StampedTransform) -> None:
        """Add a cloud, and publish the map.

        Raises:
            ValueError: It is malformed.
        """
        points = moved(found, cloud_points(message))
        points = points[self._within(points)]
        ground = self._ground(points, message.header.stamp.to_nsec())
        with self._lock:
            self.map.insert(np.array(found.translation), points[~ground], points[ground])
            self._stamp = message.header.stamp
        self._publish(*self._topics)

    def _ground(self, points: Floats, stamp: int) -> Bools:
        """Return which points of the map's frame are ground."""
        if not self.settings.filter_ground:
            return np.zeros(len(points), np.bool_)
        return self.settings.ground.ground(moved(self._to_base(stamp), points))

    def _to_base(self, stamp: int) -> StampedTransform:
        base, frame = self.settings.base_frame_id.strip("/"), self.settings.frame_id.strip("/")
        return self.tree.lookup(base, frame, stamp)

    def _within(self, points: Floats) -> Bools:
        """Return whether points are within the limits, shape (n,)."""
        kept = np.ones(len(points), np.bool_)
        for place, axis in enumerate("xyz"):
            kept &= points[:, place] >= getattr(self.settings, f"pointcloud_min_{axis}")
            kept &= points[:, place] <= getattr(self.settings, f"pointcloud_max_{axis}")
        return kept

    def _show(self, topic: str, _peer: str) -> None:
        self._publish(topic)

    def _publish(self, *topics: str) -> None:
        for topic in topics:
            publisher, make = self._topics.get(topic, (None, None))
            if publisher is not None and make is not None and publisher.has_subscribers:
                publisher.publish(make())

    # Services -----------------------------------------------------------------------------

    def _clear(self, request: octomap_msgs.srv.BoundingBoxQueryRequest) -> list[Any]:
        """Clear a box."""
        low, high = (np.array([each.x, each.y, each.z]) for each in (request.min, request.max))
        with self._lock:
            self.map.clear(low, high)
        self._publish(*self._topics)
        return []

    def _reset(self, _request: std_srvs.srv.EmptyRequest) -> list[Any]:
        """Clear the map."""
        with self._lock:
            self.map.forget()
        self._publish(*self._topics)
        return []

    # Messages -----------------------------------------------------------------------------

    @property
    def _header(self) -> std_msgs.msg.Header:
        return std_msgs.msg.Header(stamp=self._stamp, frame_id=self.settings.frame_id)

    def _chosen(self, kind: Bools) -> Bools:
        """Return which cells of a kind are published, shape (n,)."""
        heights = self.map.centers(np.ones(len(kind), np.bool_))[:, 2]
        half = 0.5 * self.settings.resolution
        chosen = kind & (heights + half > self.settings.occupancy_min_z)
        chosen &= heights - half < self.settings.occupancy_max_z
        if self.settings.filter_speckles:
            chosen &= ~self.map.isolated()
        return chosen

    def _binary(self) -> octomap_msgs.msg.Octomap:
        with self._lock:
            data = binary_tree(self.map.codes, self.map.occupied)
        return octomap(self._header, self.settings.resolution, data, binary=True)

    def _full(self) -> octomap_msgs.msg.Octomap:
        with self._lock:
            data = full_tree(self.map.codes, self.map.values)
        return octomap(self._header, self.settings.resolution, data, binary=False)

    def _centers(self, *, occupied: bool) -> Floats:
        with self._lock:
            return self.map.centers(self._chosen(self.map.occupied == occupied))

    def _cloud(self) -> sensor_msgs.msg.PointCloud2:
        return create_cloud_xyz32(self._header, self._centers(occupied=True))

    def _projected(self) -> nav_msgs.msg.OccupancyGrid:
        with self._lock:
            every = self.map.centers(np.ones(len(self.map.codes), np.bool_))
            free, occupied = (self._centers(occupied=kind) for kind in (False, True))
        least = self.settings.min_x_size, self.settings.min_y_size
        return projected(self._header, self.settings.resolution, every, free, occupied, least)

    def _occupied_cubes(self) -> visualization_msgs.msg.MarkerArray:
        return cubes(
            self._header,
            self.settings.resolution,
            self._centers(occupied=True),
            by_height=self.settings.height_map,
        )

    def _free_cubes(self) -> visualization_msgs.msg.MarkerArray:
        return cubes(
            self._header, self.settings.resolution, self._centers(occupied=False), free=True
        )


def main(arguments: Sequence[str]) -> int:
    """Map clouds until shutdown, beginning with the map of a file if one is named; returns 0."""
    plain = parse_arguments(arguments, "octomap_server").plain
    if len(plain) > 1:
        raise RosError("it takes one file at most", hint="octomap_server_node [MAP.bt|MAP.ot]")
    return run_node(arguments, "octomap_server", lambda node: OctomapServer(node, *plain))
