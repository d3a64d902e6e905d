"""``map_server``: a map from a YAML file and a picture (http://wiki.ros.org/map_server)."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gazelle.bridges.navigation.map_messages import grid_message
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import Error, FormatError, ResolveError, RosError
from gazelle.formats.occupancy import MapSettings, cells, load_map
from gazelle.formats.picture import read_picture
from gazelle_ros.base.parameter_values import warn_of_unknown
from gazelle_ros.builtin.arguments import parse_arguments, spin
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.msgs import nav_msgs
from gazelle_ros.node import Node

_USAGE = "map_server MAP.yaml"
_LIMITS = 0.65, 0.196
"""Of what is occupied and free, in the deprecated form of the command line."""


def main(arguments: Sequence[str]) -> int:
    """Serve the map of a YAML file; returns the exit code."""
    found = parse_arguments(arguments, "map_server", anonymous=True)
    if len(found.plain) not in {1, 2}:
        raise RosError("give one map", hint=_USAGE)
    grid = read_map(found.plain[0]) if len(found.plain) == 1 else _picture_alone(*found.plain)
    with found.start() as node:
        MapService(node, grid)
        return spin(node)


def read_map(path: str) -> OccupancyMap:
    """Read the map of a YAML file.

    Raises:
        RosError: The file or its picture cannot be read, or it lacks a key.
    """
    try:
        return load_map(path)
    except Error as error:
        raise RosError(error.message, file=error.file, line=error.line, hint=error.hint) from error


def _picture_alone(image: str, resolution: str) -> OccupancyMap:
    """Return the map of the deprecated command line: a picture and the side of a pixel [m]."""
    try:
        side = float(resolution)
        settings = MapSettings(image, side, (0.0, 0.0, 0.0), False, *_LIMITS)
        return OccupancyMap(cells(read_picture(Path(image)), settings), side)
    except (ValueError, OSError, FormatError) as error:
        raise RosError(f"the map cannot be read: {error}", file=image, hint=_USAGE) from None


class MapService:
    """A map, latched on ``map`` and ``map_metadata``, and its services.

    Args:
        node: On the graph; ``~frame_id`` is the map's frame (``map``).
        grid: The first map.
    """

    def __init__(self, node: Node, grid: OccupancyMap) -> None:
        self._node = node
        self._lock = threading.Lock()
        values = private_values(node)
        warn_of_unknown(node.resolve("~"), values, ["frame_id"])
        self._frame = str(values.get("frame_id", "map"))
        kind, info = nav_msgs.msg.OccupancyGrid, nav_msgs.msg.MapMetaData
        self._maps = node.advertise("map", kind, queue_size=1, latch=True)
        self._infos = node.advertise("map_metadata", info, queue_size=1, latch=True)
        self._message = self._show(grid)
        load = nav_msgs.srv.LoadMap
        self._results = load._response_class
        node.serve("static_map", nav_msgs.srv.GetMap, lambda _: [self._message])
        node.serve("change_map", load, self._change)

    def _show(self, grid: OccupancyMap) -> nav_msgs.msg.OccupancyGrid:
        message = grid_message(grid, self._frame, self._node.clock.now())
        self._maps.publish(message)
        self._infos.publish(message.info)
        return message

    def _change(self, request: nav_msgs.srv.LoadMapRequest) -> Any:
        """Load another map; an unreadable one changes nothing."""
        answer = self._results()
        try:
            grid = load_map(request.map_url)
        except ResolveError as error:
            known = error.element is None
            answer.result = (
                answer.RESULT_MAP_DOES_NOT_EXIST if known else answer.RESULT_INVALID_MAP_DATA
            )
        except FormatError as error:
            bad = error.element == "image"
            answer.result = (
                answer.RESULT_INVALID_MAP_DATA if bad else answer.RESULT_INVALID_MAP_METADATA
            )
        else:
            with self._lock:
                self._message = self._show(grid)
                answer.map, answer.result = self._message, answer.RESULT_SUCCESS
        return answer
