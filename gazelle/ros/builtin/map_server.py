"""``map_server``: a map from a YAML file and a picture (http://wiki.ros.org/map_server)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.errors import MissingExtraError, RosError, did_you_mean
from gazelle.ros.builtin.arguments import parse_arguments, spin
from gazelle.ros.launch.values import load_yaml
from gazelle.ros.messages import load_message, load_service
from gazelle.ros.node import Node
from gazelle.ros.time import Time

_REQUIRED = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")
_MODES = ("trinary", "scale", "raw")
_OCCUPIED, _FREE, _UNKNOWN = 100, 0, -1


@dataclass(frozen=True, slots=True)
class GridMap:
    """A map of occupancy."""

    cells: Any
    """0 free to 100 occupied, -1 unknown; shape (height, width), int8, the lowest row first."""
    resolution: float
    """Side of a cell [m]."""
    origin: tuple[float, float, float]
    """x, y [m] and yaw [rad] of the lower left corner."""


def main(arguments: Sequence[str]) -> int:
    """Serve the map of a YAML file; returns the exit code."""
    found = parse_arguments(arguments, "map_server")
    if len(found.plain) != 1:
        raise RosError("give one map", hint="map_server MAP.yaml")
    grid = read_map(found.plain[0])
    with found.start() as node:
        _serve(node, grid)
        return spin(node)


def read_map(path: str) -> GridMap:
    """The map of a YAML file.

    Raises:
        RosError: The file or its picture cannot be read, or it lacks a key.
    """
    file = Path(path)
    try:
        settings = load_yaml(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise RosError(f"the map cannot be read: {error.strerror}", file=path) from None
    if not isinstance(settings, dict):
        raise RosError("a map's file is a YAML mapping", file=path)
    for key in _REQUIRED:
        if key not in settings:
            close = did_you_mean(key, [str(each) for each in settings])
            hint = close if close.startswith("did you mean") else None
            raise RosError(f"the key '{key}' is missing", file=path, hint=hint)
    try:
        return _grid(file, settings)
    except (TypeError, ValueError) as error:
        raise RosError(f"a value is wrong: {error}", file=path) from None


def _grid(file: Path, settings: dict[str, Any]) -> GridMap:
    mode = str(settings.get("mode", "trinary"))
    if mode not in _MODES:
        raise RosError(f"the mode '{mode}' is unknown", file=str(file), hint=f"modes: {_MODES}")
    x, y, yaw = (float(each) for each in settings["origin"])
    levels, opaque = _picture(file.parent / str(settings["image"]), alpha=mode != "trinary")
    dark = levels / 255.0 if bool(int(settings["negate"])) else (255.0 - levels) / 255.0
    occupied, free = float(settings["occupied_thresh"]), float(settings["free_thresh"])
    if mode == "raw":
        whole = levels.astype(np.int16)
        cells = np.where(whole <= _OCCUPIED, whole, _UNKNOWN)
    else:
        between = np.full(dark.shape, float(_UNKNOWN))
        if mode == "scale":
            between = np.where(opaque, 1.0 + 98.0 * (dark - free) / (occupied - free), _UNKNOWN)
        cells = np.where(dark > occupied, _OCCUPIED, np.where(dark < free, _FREE, between))
    flipped = np.ascontiguousarray(np.trunc(cells[::-1]).astype(np.int8))
    return GridMap(flipped, float(settings["resolution"]), (x, y, yaw))


def _picture(path: Path, *, alpha: bool) -> tuple[Any, Any]:
    """Brightness 0 to 255 as the mean of the channels, and which pixels are opaque."""
    try:
        from PIL import Image
    except ImportError:
        raise MissingExtraError("pillow", "ros") from None
    try:
        with Image.open(path) as image:
            has_alpha = image.mode in {"LA", "RGBA", "PA"} or "transparency" in image.info
            single = image.mode in {"L", "1", "I", "I;16"}
            kind = "L" if single else "RGBA" if has_alpha else "RGB"
            pixels = np.asarray(image.convert(kind), dtype=np.float64)
    except OSError as error:
        raise RosError(f"the picture cannot be read: {error}", file=str(path)) from None
    if pixels.ndim == 2:
        return pixels, np.ones(pixels.shape, bool)
    opaque = pixels[..., 3] > 0 if pixels.shape[2] == 4 else np.ones(pixels.shape[:2], bool)
    # In trinary mode map_server takes transparency for one more channel.
    channels = pixels[..., :3] if alpha else pixels
    return channels.mean(axis=2), opaque


def _serve(node: Node, grid: GridMap) -> None:
    """Publish the map, latched, and answer ``static_map``."""
    frame = str(node.get_param("~frame_id", "map"))
    message = grid_message(grid, frame, node.clock.now())
    node.advertise("map", type(message), queue_size=1, latch=True).publish(message)
    info = message.info
    node.advertise("map_metadata", type(info), queue_size=1, latch=True).publish(info)
    node.serve("static_map", load_service("nav_msgs/GetMap"), lambda _request: [message])


def grid_message(grid: GridMap, frame: str, now: int) -> Any:
    """A ``nav_msgs/OccupancyGrid`` of a map at a time [ns]."""
    message: Any = load_message("nav_msgs/OccupancyGrid")()
    stamp = Time(nsecs=now)
    message.header.stamp, message.header.frame_id = stamp, frame
    info = message.info
    info.map_load_time, info.resolution = stamp, grid.resolution
    info.height, info.width = grid.cells.shape
    x, y, yaw = grid.origin
    info.origin.position.x, info.origin.position.y = x, y
    info.origin.orientation.z = math.sin(yaw / 2)
    info.origin.orientation.w = math.cos(yaw / 2)
    message.data = grid.cells.ravel().tolist()
    return message
