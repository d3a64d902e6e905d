"""The node ``explore`` of explore_lite: to the frontiers of a map (http://wiki.ros.org/explore_lite)."""

from __future__ import annotations

import logging
import threading
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Bytes
from gazelle.bridges.navigation.diagnosis import StartDiagnosis
from gazelle.bridges.navigation.frames import GraphFrames
from gazelle.bridges.navigation.messages import stamped
from gazelle.navigation.costmap.values import LETHAL, NO_INFORMATION
from gazelle.navigation.exploration import Explorer, ExploreSettings, Place
from gazelle.navigation.frontiers import Frontier, find_frontiers
from gazelle_ros.actions import GoalStatus, SimpleActionClient
from gazelle_ros.base.parameter_values import value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.clock import SECOND, Rate
from gazelle_ros.msgs import geometry_msgs, map_msgs, move_base_msgs, nav_msgs, visualization_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_LOG = logging.getLogger(__name__)
_OTHERS = (
    "costmap_topic", "costmap_updates_topic", "robot_base_frame", "transform_tolerance", "visualize",
)  # fmt: skip
_POINTS, _ADD, _DELETE_ALL = 8, 0, 3


def main(arguments: Sequence[str]) -> int:
    """Explore until nothing is left, and run until shutdown; returns the exit code."""
    return run_node(arguments, "explore", ExploreNode)


class ExploreNode:
    """An `Explorer` on a graph: maps in, goals of ``move_base`` out.

    Args:
        node: On the graph; parameters are those of ``explore_lite``.

    Attributes:
        finished: Whether nothing is left to explore.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        self.settings = ExploreSettings.read(values)
        own = [each.name for each in fields(ExploreSettings)]
        warn_of_unknown(node.resolve("~"), values, [*own, *_OTHERS])
        self.finished = False
        self._node = node
        self._lock = threading.Lock()
        self._grid: Any = None
        self._costs: Bytes = np.zeros((0, 0), np.uint8)
        self._explorer: Explorer | None = None
        self._ended: list[tuple[Place, int]] = []
        self._base = value_of(values, "robot_base_frame", "base_link").strip("/")
        self.frames = GraphFrames(node)
        topic = value_of(values, "costmap_topic", "costmap")
        self._topic = node.resolve(topic)
        node.subscribe(topic, nav_msgs.msg.OccupancyGrid, self._take_map)
        updates = value_of(values, "costmap_updates_topic", "costmap_updates")
        node.subscribe(updates, map_msgs.msg.OccupancyGridUpdate, self._take_update)
        self._shown = None
        if value_of(values, "visualize", False):
            kind = visualization_msgs.msg.MarkerArray
            self._shown = node.advertise("~frontiers", kind, queue_size=10)
        action = move_base_msgs.msg.MoveBaseAction
        self._client = SimpleActionClient(node, "move_base", action)
        self._diagnosis = StartDiagnosis(node, self._missing)

    def run(self, stop: threading.Event) -> None:
        """Run until shutdown."""
        rate = Rate(self._node.clock, self.settings.planner_frequency, reset=True)
        while not stop.is_set() and not self._node.closed:
            self._diagnosis.check(waiting=bool(self._missing()))
            self.cycle()
            rate.sleep(stop.is_set)
        if not self._node.closed and not self.finished:
            self._client.cancel_all_goals()

    def cycle(self) -> None:
        """Choose a frontier, and send the robot there."""
        with self._lock:
            grid, costs = self._grid, self._costs.copy()
            ended, self._ended = self._ended, []
        if self.finished or grid is None or self._missing():
            return
        frame = grid.header.frame_id.strip("/")
        pose = self.frames.pose(frame, self._base)
        if pose is None:
            return
        resolution, corner = float(grid.info.resolution), grid.info.origin.position
        if self._explorer is None:
            self._explorer = Explorer(self.settings, resolution)
        for place, status in ended:
            if status == GoalStatus.ABORTED:
                self._explorer.give_up(place)
        frontiers = find_frontiers(
            costs, (corner.x, corner.y), resolution, pose[:2], self.settings.min_frontier_size
        )
        now = self._node.clock.now()
        goal = self._explorer.decide(now / SECOND, frontiers)
        if self._shown is not None:
            self._show(frontiers, frame, now)
        if goal.place is None:
            self.finished = True
            self._client.cancel_all_goals()
            _LOG.info("Exploration stopped.")
        elif goal.fresh:
            self._send(goal.place, frame, now)

    def _send(self, place: Place, frame: str, now: int) -> None:
        goal = move_base_msgs.msg.MoveBaseGoal()
        goal.target_pose = stamped((*place, 0.0), frame, now)

        def end(status: int, result: object) -> None:
            del result
            with self._lock:
                self._ended.append((place, status))

        self._client.send_goal(goal, done_cb=end)

    # What comes ---------------------------------------------------------------------------

    def _take_map(self, message: nav_msgs.msg.OccupancyGrid) -> None:
        cells = np.array(message.data, np.int8)
        shape = message.info.height, message.info.width
        if cells.size != shape[0] * shape[1]:
            _LOG.error("a map of %d x %d cells has %d values", shape[1], shape[0], cells.size)
            return
        with self._lock:
            self._grid, self._costs = message, _costs_of(cells).reshape(shape)

    def _take_update(self, message: map_msgs.msg.OccupancyGridUpdate) -> None:
        cells = np.array(message.data, np.int8)
        x, y, wide, high = message.x, message.y, message.width, message.height
        with self._lock:
            rows, columns = self._costs.shape
            if min(x, y) < 0 or x + wide > columns or y + high > rows or cells.size != wide * high:
                _LOG.error("a map update reaches beyond the map")
                return
            self._costs[y : y + high, x : x + wide] = _costs_of(cells).reshape(high, wide)

    def _missing(self) -> list[str]:
        """Return the missing inputs."""
        found = []
        grid = self._grid
        if grid is None:
            found.append(f"a map on {self._topic} (a SLAM node or move_base sends it)")
        elif self.frames.pose(grid.header.frame_id.strip("/"), self._base) is None:
            found.append(f"the transform of '{self._base}' to '{grid.header.frame_id}'")
        if not self._client.wait_for_server(1e-3):
            found.append(f"the action {self._node.resolve('move_base')} (move_base offers it)")
        return found

    def _show(self, frontiers: Sequence[Frontier], frame: str, now: int) -> None:
        """Publish markers: blue where it may go, red where it gave up."""
        kind = visualization_msgs.msg.Marker
        point = geometry_msgs.msg.Point
        markers = [kind(action=_DELETE_ALL)]
        for number, frontier in enumerate(frontiers):
            marker = kind(ns="frontiers", id=number, type=_POINTS, action=_ADD)
            lost = self._explorer is not None and self._explorer.is_given_up(frontier.centroid)
            marker.color.r, marker.color.b, marker.color.a = float(lost), float(not lost), 1.0
            marker.scale.x = marker.scale.y = marker.scale.z = 0.1
            marker.pose.orientation.w = 1.0
            marker.points = [point(x=x, y=y) for x, y in frontier.points.tolist()]
            markers.append(marker)
        for marker in markers:
            marker.header.frame_id, marker.header.stamp = frame, Time(nsecs=now)
        if self._shown is not None:
            self._shown.publish(visualization_msgs.msg.MarkerArray(markers=markers))


def _costs_of(cells: NDArray[np.int8]) -> Bytes:
    """Return costs of a published map: unknown, free, or neither, shape of ``cells``."""
    return np.where(cells < 0, NO_INFORMATION, np.where(cells == 0, 0, LETHAL)).astype(np.uint8)
