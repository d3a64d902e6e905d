"""The map that a node works on: of a service, or of a topic."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable

from gazelle.bridges.navigation.map_messages import grid_of_message
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import RosError
from gazelle_ros.msgs import nav_msgs
from gazelle_ros.node import Node

_AGAIN_S = 0.5


def map_of_service(node: Node, stopped: Callable[[], bool]) -> OccupancyMap | None:
    """Call ``static_map`` until there is a map; None if the node ends before."""
    service = nav_msgs.srv.GetMap
    while not stopped():
        with contextlib.suppress(RosError):
            node.wait_for_service("static_map", _AGAIN_S)
            answer = node.client("static_map", service).call(service._request_class(), 10.0)
            if answer.map.data:
                return grid_of_message(answer.map)
    return None


class MapListener:
    """Keeps the last map of a topic.

    Args:
        node: On the graph.
        topic: Of the map.
        once: Keep the first one only.
    """

    def __init__(self, node: Node, topic: str, *, once: bool = False) -> None:
        self._lock = threading.Lock()
        self._once = once
        self._fresh: OccupancyMap | None = None
        self._had = False
        node.subscribe(topic, nav_msgs.msg.OccupancyGrid, self._take)

    def _take(self, message: nav_msgs.msg.OccupancyGrid) -> None:
        with self._lock:
            if not (self._once and self._had):
                self._fresh, self._had = grid_of_message(message), True

    def take(self) -> OccupancyMap | None:
        """Return the newest map, once."""
        with self._lock:
            fresh, self._fresh = self._fresh, None
            return fresh
